// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Where one drives: the stick, the limits, who drives, how fast it goes, and the big stop. */
import type { App, Panel } from '../app';
import { button, h, icon, setText } from '../dom';
import { fixed } from '../format';
import { ageText } from '../freshness';
import { robotOf, SOURCES, velocityOf, type Source } from '../readings';
import { recallNumber, remember } from '../remember';
import type { State } from '../state';
import { Joystick } from './joystick';
import { keycaps } from './keycaps';
import type { Limits, Velocity } from './mixing';
import type { Pilot } from './pilot';
import { stopElement } from './stop';
import { MEANINGS, whoDrives } from './words';

const WORDS: Record<Source, string> = { command: 'Command', odometry: 'Odometry', truth: 'Truth' };
const LIMITS = {
  linear: { label: 'Speed', unit: 'm/s', least: 0.05, most: 2, step: 0.05, usual: 0.5 },
  angular: { label: 'Turn', unit: 'rad/s', least: 0.1, most: 4, step: 0.1, usual: 1 },
} as const;

export class DrivePanel implements Panel {
  readonly id = 'drive';
  readonly title = 'Drive';
  readonly element: HTMLElement;
  readonly joystick: Joystick;
  private readonly who = h('span', { class: 'chip' });
  private readonly topic = h('p', { class: 'fine' });
  private readonly pad = h('span', { class: 'fine' });
  private readonly sideways: HTMLElement;
  private readonly rows = new Map<Source, { row: HTMLElement; age: HTMLElement }>();
  private readonly cells = new Map<Source, Record<keyof Velocity, HTMLElement>>();

  private readonly fold: HTMLButtonElement;

  constructor(
    private readonly app: App,
    onSmall: (small: boolean) => void = () => {},
  ) {
    this.fold = button('', () => onSmall(!this.element.classList.contains('small')), { kind: 'quiet' });
    this.fold.classList.add('fold-drive');
    this.joystick = new Joystick(app.pilot);
    app.pilot.limits = {
      linear: remembered('linear'),
      angular: remembered('angular'),
    };
    this.sideways = h(
      'div',
      { class: 'sideways', hidden: true },
      sidewaysButton(app.pilot, 'Left', 'Q', 1),
      sidewaysButton(app.pilot, 'Right', 'E', -1),
    );
    this.element = h(
      'section',
      { class: 'drive', 'aria-label': 'Drive' },
      h('header', { class: 'drive-head' }, h('h2', {}, 'Drive'), this.who, this.fold),
      this.joystick.element,
      this.readout(),
      this.sideways,
      h('div', { class: 'drive-limits' }, this.limit('linear'), this.limit('angular')),
      stopElement(app),
      h('div', { class: 'drive-notes' }, keysHint(), this.pad, this.topic),
    );
    this.setSmall(false);
    app.store.watch(
      ['graph', 'robot', 'driver', 'commanders', 'stops', 'silence', 'simulation', 'link', 'hello'],
      () => this.showWho(),
    );
    app.store.watch(['graph', 'robot', 'controllers'], () => this.showTopic());
    app.store.watch(['graph', 'robot', 'controllers'], () => {
      app.pilot.goesSideways = app.store.goesSideways;
      this.sideways.hidden = !app.store.goesSideways;
      this.element.classList.toggle('goes-sideways', app.store.goesSideways);
    });
    app.pilot.onChange = (velocity) => this.showAsked(velocity);
  }

  pulse(state: State): void {
    const robot = robotOf(state, this.app.store.robot?.id);
    for (const source of SOURCES) {
      const cells = this.cells.get(source);
      const velocity = robot === null ? null : velocityOf(robot, source);
      if (cells !== undefined) {
        setText(cells.linear, fixed(velocity?.linear, 2));
        setText(cells.angular, fixed(velocity?.angular, 2));
        setText(cells.sideways, fixed(velocity?.sideways, 2));
      }
    }
  }

  /** Say how old the numbers are, once they are too old; called ten times a second. */
  tick(now: number): void {
    const { store } = this.app;
    const robot = store.robot?.id ?? '';
    const isPaused = store.simulation !== null && store.simulation.state !== 'playing';
    for (const [source, { row, age: cell }] of this.rows) {
      const age = isPaused ? null : store.freshness.staleness(robot, source, now);
      const text = age === null ? '' : ageText(age);
      if (cell.textContent !== text) {
        setText(cell, text);
        row.classList.toggle('stale', age !== null);
        row.title = age === null ? '' : `No ${WORDS[source].toLowerCase()} for ${text}`;
      }
    }
  }

  /** Stick and STOP alone, or all. */
  setSmall(small: boolean): void {
    this.element.classList.toggle('small', small);
    this.fold.title = small ? 'All of driving' : 'Stick and STOP alone';
    this.fold.setAttribute('aria-label', this.fold.title);
    this.fold.replaceChildren(icon(small ? 'down' : 'up'));
  }

  /** Name the gamepad that can drive. */
  showPad(name: string | null): void {
    setText(this.pad, name === null ? '' : `Gamepad: ${name}`);
  }

  private showAsked(velocity: Velocity | null): void {
    const { linear, angular } = this.app.pilot.limits;
    this.joystick.show({
      forward: (velocity?.linear ?? 0) / linear,
      turn: (velocity?.angular ?? 0) / angular,
    });
    this.element.classList.toggle('driving', velocity !== null);
    document.documentElement.classList.toggle('driven', velocity !== null || this.drove());
  }

  private drove(): boolean {
    return document.documentElement.classList.contains('driven');
  }

  private showWho(): void {
    const { store } = this.app;
    const command = store.robot?.command ?? null;
    const { tone, text } = whoDrives(store);
    setText(this.who, text);
    this.who.dataset.tone = tone;
    this.element.classList.toggle('cannot', command === null || store.link.state !== 'open');
    this.app.pilot.setRobot(command === null ? null : (store.robot?.id ?? null));
  }

  /** Where commands go, or why they would move nothing. */
  private showTopic(): void {
    const { robot, deafController: deaf } = this.app.store;
    const command = robot?.command ?? null;
    if (robot === null) {
      setText(this.topic, 'There is no robot.');
    } else if (command === null) {
      const moved = this.app.store.movedJoints.size;
      const joints = moved > 0 ? ` Its joints are moved under Joints.` : '';
      setText(this.topic, `Nothing hears velocity commands: this robot cannot be driven.${joints}`);
    } else if (deaf !== null) {
      setText(this.topic, `${deaf.name} is ${deaf.state}: it hears no command.`);
    } else {
      setText(this.topic, command.topic);
    }
    this.topic.classList.toggle('topic', command !== null && deaf === null);
    this.topic.classList.toggle('deaf', deaf !== null);
    this.topic.title = command === null ? '' : `${command.message} on ${command.topic}`;
  }

  private readout(): HTMLElement {
    const rows = SOURCES.map((source) => {
      const cells = {
        linear: h('td', {}, '–'),
        angular: h('td', {}, '–'),
        sideways: h('td', { class: 'of-sideways' }, '–'),
      };
      this.cells.set(source, cells);
      const age = h('small', { class: 'age' });
      const name = h('th', { scope: 'row', title: MEANINGS[source] }, h('i', { class: `swatch ${source}` }), WORDS[source], age);
      const row = h('tr', {}, name, cells.linear, cells.sideways, cells.angular);
      this.rows.set(source, { row, age });
      return row;
    });
    const left = h('th', { scope: 'col', class: 'of-sideways', title: 'm/s to the left' }, 'left');
    return h(
      'table',
      { class: 'readout' },
      h('caption', { class: 'unseen' }, 'Velocity of the robot'),
      h('thead', {}, h('tr', {}, h('td'), unit('m/s'), left, unit('rad/s'))),
      h('tbody', {}, ...rows),
    );
  }

  private limit(which: keyof Limits): HTMLElement {
    const { label, unit: name, least, most, step } = LIMITS[which];
    const value = h('output', {});
    const range = h('input', {
      type: 'range',
      min: least,
      max: most,
      step,
      value: this.app.pilot.limits[which],
    });
    const show = (): void => {
      setText(value, `${fixed(range.valueAsNumber, 2)} ${name}`);
      range.setAttribute('aria-valuetext', `${fixed(range.valueAsNumber, 2)} ${name}`);
    };
    range.addEventListener('input', () => {
      remember(`limit.${which}`, range.value);
      this.app.pilot.setLimits({ ...this.app.pilot.limits, [which]: range.valueAsNumber });
      show();
    });
    show();
    return h('label', { class: 'slider' }, h('span', {}, label), range, value);
  }
}

function remembered(which: keyof Limits): number {
  const { least, most, usual } = LIMITS[which];
  return recallNumber(`limit.${which}`, least, most, usual);
}

function unit(name: string): HTMLElement {
  return h('th', { scope: 'col' }, name);
}

/** A button that takes the robot sideways while it is held. */
function sidewaysButton(pilot: Pilot, text: string, key: string, left: number): HTMLElement {
  const hand = `sideways ${text}`;
  const element = h(
    'button',
    { type: 'button', class: 'button', 'aria-label': `${text}, sideways while held`, 'aria-keyshortcuts': key },
    h('span', {}, text),
    ...keycaps(`Key${key}`),
  );
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    pilot.set(hand, { forward: 0, turn: 0, left });
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
    element.addEventListener(end, () => pilot.set(hand, null));
  }
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  return element;
}

function keysHint(): HTMLElement {
  const keys = keycaps('KeyW', 'KeyA', 'KeyS', 'KeyD');
  return h('p', { class: 'fine keys-hint' }, 'Hold ', ...keys, ' or the arrow keys');
}
