// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The tools that give poses on the ground: which one is in hand, and what pointers and keys do with it. */
import { signal } from '@preact/signals';
import { takesKey } from '../dom';
import { PoseGesture, type Place, type Point } from './gesture';

export type Tool = 'goal' | 'pose';

/** What the tools need of the scene and of the page. */
export interface Bench {
  canvas: HTMLCanvasElement;
  /** The point of the ground under a point of the page, m in the frame of the map. */
  groundAt(clientX: number, clientY: number): Point | null;
  /** Where to look in a place that was only clicked, rad. */
  yawAt(tool: Tool, at: Point): number;
  /** Draw what would be given; null: nothing. */
  preview(tool: Tool, place: Place | null): void;
  give(tool: Tool, place: Place): void;
  canTake(tool: Tool): boolean;
  /** Whether anything is driven: then Escape is STOP, too. */
  isDriven(): boolean;
}

/** As in RViz. */
const KEYS: Readonly<Record<string, Tool>> = { KeyG: 'goal', KeyP: 'pose' };

export class PoseTools {
  private readonly held = signal<Tool | null>(null);
  private readonly gesture = new PoseGesture((at) => this.bench.yawAt(this.held.peek() ?? 'goal', at));

  constructor(private readonly bench: Bench) {
    const { canvas } = bench;
    // Before the camera's own listeners.
    canvas.addEventListener('pointerdown', (event) => this.onDown(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.onMove(event), { capture: true });
    canvas.addEventListener('pointerup', (event) => this.onUp(event), { capture: true });
    canvas.addEventListener('pointercancel', (event) => this.onCancel(event), { capture: true });
    window.addEventListener('keydown', (event) => this.onKey(event), { capture: true });
  }

  /** The tool in hand; null: none. */
  get tool(): Tool | null {
    return this.held.value;
  }

  /** Take a tool in hand; null, or the one that is: put it down. */
  take(tool: Tool | null): void {
    this.drop();
    this.held.value = tool === this.held.peek() ? null : tool;
    this.bench.canvas.classList.toggle('placing', this.held.peek() !== null);
  }

  private drop(): void {
    const tool = this.held.peek();
    this.gesture.cancel();
    if (tool !== null) {
      this.bench.preview(tool, null);
    }
  }

  private onDown(event: PointerEvent): void {
    const tool = this.held.peek();
    const isModified = event.ctrlKey || event.metaKey || event.shiftKey;
    if (tool === null || event.button !== 0 || isModified) {
      return;
    }
    event.stopImmediatePropagation();
    if (!event.isPrimary) {
      this.drop(); // a second finger
      return;
    }
    const { pointerId: id, clientX: x, clientY: y } = event;
    if (this.gesture.press(id, x, y, this.bench.groundAt(x, y))) {
      this.bench.canvas.focus();
      this.bench.canvas.setPointerCapture(id);
      this.bench.preview(tool, this.gesture.place);
    }
  }

  private onMove(event: PointerEvent): void {
    const tool = this.held.peek();
    const { pointerId: id, clientX: x, clientY: y } = event;
    const isOurs = this.gesture.isHeld && this.gesture.move(id, x, y, this.bench.groundAt(x, y));
    if (tool !== null && isOurs) {
      event.stopImmediatePropagation();
      this.bench.preview(tool, this.gesture.place);
    }
  }

  private onUp(event: PointerEvent): void {
    const tool = this.held.peek();
    const place = this.gesture.release(event.pointerId);
    if (tool === null || place === null) {
      return;
    }
    event.stopImmediatePropagation();
    this.bench.preview(tool, null);
    this.take(null);
    this.bench.give(tool, place);
  }

  private onCancel(event: PointerEvent): void {
    if (this.gesture.release(event.pointerId) !== null) {
      this.drop();
    }
  }

  private onKey(event: KeyboardEvent): void {
    const isModified = event.ctrlKey || event.metaKey || event.altKey || event.shiftKey;
    const tool = KEYS[event.code];
    if (event.code === 'Escape' && this.held.peek() !== null) {
      this.take(null);
      if (!this.bench.isDriven()) {
        event.preventDefault();
        event.stopImmediatePropagation(); // who hits Escape while nothing moves does not want STOP
      }
    } else if (tool !== undefined && !isModified && !event.repeat && !takesKey(event.target, event.code)) {
      if (this.bench.canTake(tool)) {
        event.preventDefault();
        this.take(tool);
      }
    }
  }
}
