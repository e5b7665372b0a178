// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The simulator's clock, and the robots in its world: more of them, or fewer. */
import { ask, type App, type Panel } from '../app';
import { button, confirmed, h, section, setText } from '../dom';
import { clock, factor, UNKNOWN } from '../format';
import type { State } from '../state';

const FACTORS = [0.1, 0.25, 0.5, 1, 2, 5, 0]; // 0: as fast as possible
const SLOW = 0.95; // share of the factor asked for, below which the machine is too slow

export class SimulationPanel implements Panel {
  readonly id = 'simulation';
  readonly title = 'Simulation';
  readonly element = h('div', {});
  private readonly body = h('div', {});
  private readonly none = h('p', { class: 'empty' }, 'There is no simulator in the graph.');
  private readonly time = h('dd', {}, UNKNOWN);
  private readonly state = h('dd', {}, UNKNOWN);
  private readonly real = h('dd', {}, UNKNOWN);
  private readonly steps = h('input', {
    type: 'number',
    id: 'steps',
    min: 1,
    max: 10000,
    value: 10,
  });
  private readonly wanted = h('select', { id: 'factor' });
  private readonly entities = h('ul', { class: 'rows' });
  private signature: string | null = null;

  constructor(private readonly app: App) {
    this.wanted.append(
      ...FACTORS.map((value) =>
        h('option', { value }, value === 0 ? 'as fast as possible' : `${value}×`),
      ),
    );
    this.wanted.addEventListener('change', () => {
      this.ask({ type: 'set_factor', factor: Number(this.wanted.value) });
    });
    this.body.append(
      section('Clock', this.clock(), this.tools()),
      section('In the world', this.entities),
      section('Another robot like this one', this.spawnForm()),
    );
    this.element.append(this.none, this.body);
    app.store.watch(['graph', 'simulation'], () => this.show());
    app.store.watch(['graph'], () => this.showEntities());
  }

  pulse(state: State): void {
    setText(this.time, clock(state.time));
  }

  private ask(
    what:
      | { type: 'step'; steps: number }
      | { type: 'set_factor'; factor: number }
      | { type: 'delete'; name: string },
  ): void {
    const simulator = this.app.store.simulator;
    if (simulator !== null) {
      void ask(this.app, { ...what, simulator: simulator.id });
    }
  }

  private show(): void {
    const { simulator, simulation } = this.app.store;
    this.none.hidden = simulator !== null;
    this.body.hidden = simulator === null;
    if (simulation === null) {
      return;
    }
    const { factor: asked, real_factor: real, state } = simulation;
    setText(this.state, state);
    setText(this.real, state === 'playing' ? factor(real) : UNKNOWN);
    const slow = state === 'playing' && asked !== null && asked > 0 && real !== null;
    const tooSlow = slow && real < SLOW * asked;
    this.real.dataset.tone = tooSlow ? 'warning' : 'calm';
    this.real.title = tooSlow ? 'This machine is too slow for it.' : '';
    if (asked !== null && document.activeElement !== this.wanted) {
      this.showFactor(asked);
    }
  }

  /** A factor set elsewhere need not be one of those offered here. */
  private showFactor(asked: number): void {
    const value = String(asked);
    if (![...this.wanted.options].some((option) => option.value === value)) {
      this.wanted.append(h('option', { value }, `${value}×`));
    }
    this.wanted.value = value;
  }

  private clock(): HTMLElement {
    const row = (name: string, value: HTMLElement): HTMLElement =>
      h('div', {}, h('dt', {}, name), value);
    return h(
      'dl',
      { class: 'facts' },
      row('Time', this.time),
      row('State', this.state),
      row('Real-time factor', this.real),
    );
  }

  private tools(): HTMLElement {
    const step = (): void => this.ask({ type: 'step', steps: this.steps.valueAsNumber || 1 });
    return h(
      'div',
      { class: 'form' },
      h('label', { class: 'field' }, h('span', {}, 'Factor wanted'), this.wanted),
      h(
        'div',
        { class: 'field' },
        h('label', { for: 'steps' }, 'Steps'),
        h('span', { class: 'join' }, this.steps, button('Step', step, { icon: 'step' })),
      ),
    );
  }

  private showEntities(): void {
    const entities = this.app.store.simulator?.entities ?? [];
    const signature = entities.join();
    if (signature !== this.signature) {
      this.signature = signature; // the same again must not take the focus from a button
      this.entities.replaceChildren(...entities.map((name) => this.entity(name)));
    }
  }

  private entity(name: string): HTMLElement {
    const remove = confirmed('Delete', 'Really delete?', () => this.ask({ type: 'delete', name }));
    remove.title = `Take ${name} out of the world`;
    return h('li', {}, h('span', { class: 'grow' }, name), remove);
  }

  private spawnForm(): HTMLElement {
    const number = (name: string, label: string, value: number): HTMLElement =>
      h(
        'label',
        { class: 'field' },
        h('span', {}, label),
        h('input', { type: 'number', name, value, step: 'any', required: true }),
      );
    const pattern = '[A-Za-z]\\w*'; // of a ROS name
    const name = h('input', { type: 'text', name: 'name', required: true, pattern });
    const form = h(
      'form',
      { class: 'form spawn' },
      h('label', { class: 'field wide' }, h('span', {}, 'Name'), name),
      number('x', 'x, m', 1),
      number('y', 'y, m', 0),
      number('yaw', 'Yaw, °', 0),
      h('button', { type: 'submit', class: 'button primary' }, 'Spawn'),
    );
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.spawn(new FormData(form));
    });
    this.app.store.watch(['graph'], () => {
      if (document.activeElement !== name) {
        name.value = freeName(this.app.store.simulator?.entities ?? []);
      }
    });
    return form;
  }

  private spawn(form: FormData): void {
    const { simulator, robot } = this.app.store;
    const field = (name: string): string => String(form.get(name) ?? '');
    if (simulator === null || robot === null) {
      this.app.store.note('error', 'There is no robot here to make another one like it.');
      return;
    }
    void ask(this.app, {
      type: 'spawn',
      simulator: simulator.id,
      name: field('name'),
      namespace: `/${field('name')}`,
      position: [Number(field('x')), Number(field('y')), 0],
      yaw: (Number(field('yaw')) * Math.PI) / 180,
      like: robot.id,
    });
  }
}

/** The first of robot1, robot2 … that is not there yet. */
export function freeName(taken: readonly string[]): string {
  let number = 1;
  while (taken.includes(`robot${number}`)) {
    number += 1;
  }
  return `robot${number}`;
}
