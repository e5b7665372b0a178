// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The positions of the joints, and a slider for each that can be moved: by joint_state_publisher,
 * or by an active controller that takes positions or trajectories.
 */
import type { App, Panel } from '../app';
import { button, h, setText } from '../dom';
import { degrees, fixed, UNKNOWN } from '../format';
import type { JointInfo } from '../protocol';
import { jointsOf, robotOf, type JointReading } from '../readings';
import type { State } from '../state';

const HELD = 1500; // ms: how long a slider stays where a hand has left it
const LEAST_GAP = 50; // ms between two positions for a controller

interface Row {
  show(reading: JointReading): void;
  set(position: number): void;
}

export class JointsPanel implements Panel {
  readonly id = 'joints';
  readonly title = 'Joints';
  readonly element = h('div', {});
  private readonly rows = new Map<string, Row>();
  private readonly wanted: Record<string, number> = {};
  private signature = '';
  private isSending = false;
  private sentAt = 0; // ms

  constructor(private readonly app: App) {
    app.store.watch(['model', 'graph', 'robot', 'controllers'], () => this.build());
  }

  pulse(state: State): void {
    const robot = robotOf(state, this.app.store.robot?.id);
    for (const reading of robot === null ? [] : jointsOf(state, robot)) {
      this.rows.get(reading.name)?.show(reading);
    }
  }

  private build(): void {
    const { model, robot, movedJoints } = this.app.store;
    const publisher = robot?.joint_publisher ?? null;
    const moved = model?.joints ?? [];
    const { joint_states: source } = robot ?? {};
    const signature = JSON.stringify([robot?.id, publisher, source, moved, [...movedJoints]]);
    if (signature === this.signature) {
      return; // the same again must not take the slider out of a hand
    }
    this.signature = signature;
    this.rows.clear();
    if (moved.length === 0) {
      this.element.replaceChildren(h('p', { class: 'empty' }, 'No joint moves.'));
      return;
    }
    const free = moved.filter((joint) => joint.follows === null);
    const slides = ({ name, follows }: JointInfo): boolean =>
      publisher === null ? movedJoints.has(name) : follows === null;
    this.element.replaceChildren(
      publisher === null ? this.watching() : this.tools(free),
      ...moved.map((joint) => this.row(joint, slides(joint))),
    );
  }

  private watching(): HTMLElement {
    const { robot, movedJoints } = this.app.store;
    const source = robot?.joint_states ?? null;
    const measured = source === null ? 'Nobody publishes joint states.' : `Measured, from ${source}.`;
    const movers = [...new Set(movedJoints.values())].join(', ');
    const text =
      movers === ''
        ? 'No active controller takes positions, and no joint_state_publisher runs: no sliders.'
        : `Sliders command ${movers}: the robot moves.`;
    return h('p', { class: 'fine' }, `${measured} ${text}`);
  }

  private tools(joints: readonly JointInfo[]): HTMLElement {
    const all = (position: (joint: JointInfo) => number): void => {
      for (const joint of joints) {
        this.rows.get(joint.name)?.set(position(joint));
        this.want(joint.name, position(joint));
      }
    };
    const anywhere = ({ lower, upper }: JointInfo): number =>
      lower + Math.random() * (upper - lower);
    return h(
      'div',
      { class: 'tools' },
      button('Randomize', () => all(anywhere)),
      button('Center', () => all(({ zero }) => zero)),
    );
  }

  private row(joint: JointInfo, slides: boolean): HTMLElement {
    const angle = joint.kind !== 'prismatic';
    const [unit, speed] = angle ? ['rad', 'rad/s'] : ['m', 'm/s'];
    const other = h('span', { class: 'fine' }, UNKNOWN);
    const motion = ({ position, velocity, commanded }: JointReading): string => {
      const turned = angle ? [degrees(position)] : [];
      const moves = Number.isNaN(velocity) ? [] : [`${fixed(velocity, 2)} ${speed}`];
      const wanted = Number.isNaN(commanded) ? [] : [`commanded ${fixed(commanded, 2)}`];
      return [...turned, ...moves, ...wanted].join('  ');
    };
    const head = h('span', { class: 'joint-name', title: about(joint, unit) }, joint.name);
    if (!slides) {
      const value = h('span', { class: 'value' }, UNKNOWN);
      const follows = joint.follows === null ? '' : `follows ${joint.follows}`;
      this.rows.set(joint.name, {
        show: (reading) => {
          setText(value, `${fixed(reading.position, 3)} ${unit}`);
          setText(other, motion(reading));
        },
        set: () => {},
      });
      const limits = h('span', { class: 'fine limits' }, range(joint));
      return h('div', { class: 'joint', title: follows }, head, value, other, limits);
    }
    return this.sliderRow(joint, unit, head, other, motion);
  }

  private sliderRow(
    joint: JointInfo,
    unit: string,
    head: HTMLElement,
    other: HTMLElement,
    motion: (reading: JointReading) => string,
  ): HTMLElement {
    const { name, lower, upper, zero } = joint;
    const bounds = { min: lower, max: upper, value: zero };
    const slider = h('input', {
      type: 'range', ...bounds, step: 'any', 'aria-label': `${name}, ${unit}`,
    });
    const field = h('input', {
      type: 'number', ...bounds, step: 0.01, 'aria-label': `${name}, value in ${unit}`,
    });
    let movedAt = -Infinity;
    const set = (position: number): void => {
      slider.valueAsNumber = position;
      field.value = plain(position);
    };
    slider.addEventListener('input', () => {
      movedAt = performance.now();
      field.value = plain(slider.valueAsNumber);
      this.want(name, slider.valueAsNumber);
    });
    field.addEventListener('change', () => {
      const value = field.valueAsNumber;
      const position = Number.isNaN(value) ? zero : Math.min(upper, Math.max(lower, value));
      movedAt = performance.now();
      set(position);
      this.want(name, position);
    });
    this.rows.set(name, {
      set,
      show: (reading) => {
        setText(other, motion(reading));
        // A hand on the slider, or a value being typed, is not overruled by what comes back; nor
        // is a key on the slider, while a robot is on its way.
        const held = slider.matches(':active') || document.activeElement === field;
        const busy = held || performance.now() - movedAt < (this.isDirect ? 0 : HELD);
        if (!busy && Number.isFinite(reading.position) && !this.isSending) {
          set(reading.position);
        }
      },
    });
    const limits = h('span', { class: 'fine limits' }, range(joint));
    return h('div', { class: 'joint slides' }, head, field, slider, other, limits);
  }

  /** Whether what is sent is what is published: there is no robot on its way to it. */
  private get isDirect(): boolean {
    return this.app.store.robot?.joint_publisher != null;
  }

  /** Send the position with the next frame of the screen, and others that come until then. */
  private want(name: string, position: number): void {
    this.wanted[name] = position;
    if (this.isSending) {
      return;
    }
    this.isSending = true;
    const wait = this.isDirect ? 0 : this.sentAt + LEAST_GAP - performance.now();
    setTimeout(() => requestAnimationFrame(() => this.send()), Math.max(0, wait));
  }

  private send(): void {
    this.isSending = false;
    this.sentAt = performance.now();
    const robot = this.app.store.robot;
    if (robot !== null) {
      const positions = { ...this.wanted };
      this.app.connection.send({ type: 'set_joints', robot: robot.id, positions });
    }
    for (const sent of Object.keys(this.wanted)) {
      delete this.wanted[sent];
    }
  }
}

/** A position as a field of numbers takes it, without the minus of a zero. */
function plain(position: number): string {
  return position.toFixed(3).replace(/^-(0\.0*)$/, '$1');
}

/** The limits of a joint, as text; a continuous one has none. */
function range({ kind, lower, upper }: JointInfo): string {
  const digits = kind === 'prismatic' ? 3 : 2;
  const limits = `${fixed(lower, digits)} … ${fixed(upper, digits)}`;
  return kind === 'continuous' ? 'no limits' : limits;
}

function about(joint: JointInfo, unit: string): string {
  const limits = joint.kind === 'continuous' ? range(joint) : `${range(joint)} ${unit}`;
  return `${joint.name}: ${joint.kind}, ${limits}`;
}
