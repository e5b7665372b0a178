// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A stick on the screen, for mouse, pen and finger: it drives while it is held. */
import { h } from '../dom';
import { fromStick, type Demand } from './mixing';
import type { Pilot } from './pilot';

const DEAD = 0.08; // share of the throw
const HAND = 'joystick';

export class Joystick {
  readonly element: HTMLElement;
  private readonly knob = h('div', { class: 'joystick-knob' });
  private pointer: number | null = null;

  constructor(private readonly pilot: Pilot) {
    this.element = h(
      'div',
      {
        class: 'joystick',
        role: 'img',
        'aria-label': 'Joystick: drag to drive. With the keyboard: W A S D or the arrow keys.',
      },
      h('div', { class: 'joystick-cross' }),
      this.knob,
    );
    this.element.addEventListener('pointerdown', (event) => this.take(event));
    this.element.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      this.element.addEventListener(end, (event) => this.letGo(event));
    }
    this.element.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  /** Show what is asked, whichever hand asks it. */
  show(demand: Demand): void {
    const reach = (this.element.clientWidth - this.knob.offsetWidth) / 2;
    const length = Math.max(1, Math.hypot(demand.forward, demand.turn));
    const right = (-demand.turn / length) * reach;
    const down = (-demand.forward / length) * reach;
    this.knob.style.transform = `translate(${right.toFixed(1)}px, ${down.toFixed(1)}px)`;
    const held = demand.forward !== 0 || demand.turn !== 0;
    this.element.classList.toggle('held', held || this.pointer !== null);
  }

  private take(event: PointerEvent): void {
    if (this.pointer === null && event.button === 0) {
      event.preventDefault();
      this.pointer = event.pointerId;
      this.element.setPointerCapture(event.pointerId);
      this.move(event);
    }
  }

  private move(event: PointerEvent): void {
    if (event.pointerId !== this.pointer) {
      return;
    }
    const box = this.element.getBoundingClientRect();
    const reach = (box.width - this.knob.offsetWidth) / 2;
    const right = (event.clientX - box.left - box.width / 2) / reach;
    const down = (event.clientY - box.top - box.height / 2) / reach;
    this.pilot.set(HAND, fromStick(right, down, DEAD));
  }

  private letGo(event: PointerEvent): void {
    if (event.pointerId === this.pointer) {
      this.pointer = null;
      this.pilot.set(HAND, null);
    }
  }
}
