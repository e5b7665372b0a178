// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How it goes: diagnostics, the wheels on the ground, and what the node had to say. */
import type { App, Panel } from '../app';
import { button, h, section, setText, table } from '../dom';
import { fixed } from '../format';
import type { Diagnostics } from '../protocol';
import { robotOf, wheelsOf, type WheelReading } from '../readings';
import type { State } from '../state';

const ORDER: Diagnostics['items'][number]['level'][] = ['error', 'stale', 'warn', 'ok'];
const TONES = { error: 'error', stale: 'warning', warn: 'warning', ok: 'good' } as const;
const WHEEL_COLUMNS = ['Wheel', 'rad/s', 'Load, N', 'Slip along', 'across'];

export class HealthPanel implements Panel {
  readonly id = 'health';
  readonly title = 'Health';
  readonly element: HTMLElement;
  readonly watches = ['wheels'] as const;
  private readonly diagnostics = h('ul', { class: 'rows' });
  private readonly wheels = h('tbody', {});
  private readonly notices = h('ul', { class: 'rows notices' });
  private readonly wheelSection: HTMLElement;
  private names = '';

  constructor(private readonly app: App) {
    const columns = WHEEL_COLUMNS.map((name, index) => ({ name, number: index > 0 }));
    this.wheelSection = section(
      'Wheels on the ground',
      table('Contact and slip of each wheel', columns, this.wheels),
      h('p', { class: 'fine' }, 'Slip in m/s: along the rolling direction and across it.'),
    );
    this.element = h(
      'div',
      {},
      section('Diagnostics', this.diagnostics),
      this.wheelSection,
      section('Notices', this.notices, button('Clear', () => app.store.clearNotices())),
    );
    app.store.watch(['diagnostics', 'graph', 'robot'], () => this.showDiagnostics());
    app.store.watch(['notice'], () => this.showNotices());
  }

  /** How many diagnostics are not well. */
  get toLookAt(): number {
    return this.items().filter(({ level }) => level !== 'ok').length;
  }

  pulse(state: State): void {
    const robot = robotOf(state, this.app.store.robot?.id);
    const wheels = robot === null ? [] : wheelsOf(state, robot);
    const names = wheels.map(({ name }) => name).join();
    this.wheelSection.hidden = wheels.length === 0;
    if (names !== this.names) {
      this.names = names;
      this.wheels.replaceChildren(...wheels.map(wheelRow));
    }
    wheels.forEach((wheel, index) => showWheel(this.wheels.rows[index], wheel));
  }

  private items(): Diagnostics['items'] {
    const { robot, diagnostics } = this.app.store;
    return robot === null ? [] : (diagnostics.get(robot.id)?.items ?? []);
  }

  private showDiagnostics(): void {
    const items = [...this.items()].sort(
      (one, other) => ORDER.indexOf(one.level) - ORDER.indexOf(other.level),
    );
    this.diagnostics.replaceChildren(
      ...items.map(({ level, name, message }) =>
        h(
          'li',
          { class: 'unit' },
          h('span', { class: 'unit-name' }, name),
          h('span', { class: 'chip', 'data-tone': TONES[level] }, level),
          h('span', { class: 'fine' }, message),
        ),
      ),
    );
    if (items.length === 0) {
      this.diagnostics.append(h('li', { class: 'empty' }, 'Nobody publishes /diagnostics.'));
    }
  }

  private showNotices(): void {
    const { notices } = this.app.store;
    this.notices.replaceChildren(
      ...notices.map(({ level, text, count, at }) =>
        h(
          'li',
          { 'data-tone': level },
          h('time', { class: 'fine' }, at.toLocaleTimeString('en-GB')),
          h('span', { class: 'grow' }, count > 1 ? `${text} (${count} times)` : text),
        ),
      ),
    );
    if (notices.length === 0) {
      this.notices.append(h('li', { class: 'empty' }, 'None.'));
    }
  }
}

function wheelRow({ name }: WheelReading): HTMLElement {
  const cells = WHEEL_COLUMNS.slice(1).map(() => h('td', { class: 'number' }));
  const short = name.replace(/^joint_/, '').replace(/_joint$/, '').replace(/^wheel_/, '');
  return h('tr', {}, h('th', { scope: 'row', title: name }, h('i', {}), short), ...cells);
}

function showWheel(row: HTMLTableRowElement, wheel: WheelReading): void {
  const { speed, contact, force, along, across } = wheel;
  const lamp = row.cells[0].firstElementChild;
  const word = contact === null ? 'unknown' : contact ? 'on the ground' : 'in the air';
  lamp?.setAttribute('class', `lamp ${contact === true ? 'on' : ''}`);
  lamp?.setAttribute('title', word);
  const texts = [fixed(speed, 2), fixed(force, 1), fixed(along, 3), fixed(across, 3)];
  texts.forEach((text, index) => setText(row.cells[index + 1], text));
}
