// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What runs in the controller manager: controllers, each with a switch, and the hardware. */
import { ask, type App, type Panel } from '../app';
import { h, section } from '../dom';
import type { Controllers } from '../protocol';

type Controller = Controllers['controllers'][number];
type Hardware = Controllers['hardware'][number];

export class ControlPanel implements Panel {
  readonly id = 'control';
  readonly title = 'Control';
  readonly element = h('div', {});
  private signature = '';

  constructor(private readonly app: App) {
    app.store.watch(['controllers', 'graph', 'robot'], () => this.show());
  }

  private show(): void {
    const { robot, controllers } = this.app.store;
    const here = robot === null ? undefined : controllers.get(robot.id);
    const signature = JSON.stringify([robot?.id, here ?? null]);
    if (signature === this.signature) {
      return; // the same again must not take the focus from a switch
    }
    this.signature = signature;
    if (here === undefined) {
      const text = 'No controller manager runs for this robot.';
      this.element.replaceChildren(h('p', { class: 'empty' }, text));
      return;
    }
    const focused = document.activeElement?.id;
    this.element.replaceChildren(
      section('Controllers', rows(here.controllers.map((one) => this.controller(one)))),
      section('Hardware', rows(here.hardware.map(hardware))),
    );
    if (focused !== undefined && focused.startsWith('switch-')) {
      document.getElementById(focused)?.focus();
    }
  }

  private controller({ name, kind, state, claims }: Controller): HTMLElement {
    const active = state === 'active';
    const knob = h('button', {
      type: 'button',
      role: 'switch',
      class: 'switch',
      id: `switch-${name}`,
      'aria-checked': String(active),
      'aria-label': `${name} is active`,
      title: active ? `Deactivate ${name}` : `Activate ${name}`,
      disabled: !active && state !== 'inactive',
    });
    knob.addEventListener('click', () => void this.flip(name, !active, knob));
    const text = claims.length === 0 ? 'claims nothing' : `claims ${claims.join(', ')}`;
    return h(
      'li',
      { class: 'unit' },
      h('span', { class: 'unit-name' }, name),
      stateChip(state),
      knob,
      h('span', { class: 'fine' }, kind),
      h('span', { class: 'fine' }, text),
    );
  }

  private async flip(name: string, activate: boolean, knob: HTMLButtonElement): Promise<void> {
    const robot = this.app.store.robot;
    if (robot === null) {
      return;
    }
    knob.disabled = true;
    knob.setAttribute('aria-busy', 'true');
    await ask(this.app, {
      type: 'switch',
      robot: robot.id,
      activate: activate ? [name] : [],
      deactivate: activate ? [] : [name],
    });
    knob.disabled = false; // its new state comes by itself, in a message to every page
    knob.removeAttribute('aria-busy');
  }
}

function hardware({ name, kind, state }: Hardware): HTMLElement {
  return h(
    'li',
    { class: 'unit' },
    h('span', { class: 'unit-name' }, name),
    stateChip(state),
    h('span', { class: 'fine' }, kind),
  );
}

function stateChip(state: string): HTMLElement {
  const tone = state === 'active' ? 'good' : state === 'inactive' ? 'calm' : 'warning';
  return h('span', { class: 'chip', 'data-tone': tone }, state);
}

function rows(items: HTMLElement[]): HTMLElement {
  return items.length === 0
    ? h('p', { class: 'empty' }, 'None.')
    : h('ul', { class: 'rows' }, ...items);
}
