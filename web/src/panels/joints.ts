// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A slider for each joint if joint_state_publisher runs; else the positions of the joints. */
import type { App, Panel } from '../app';
import { button, h, setText } from '../dom';
import { degrees, fixed, UNKNOWN } from '../format';
import type { JointInfo } from '../protocol';
import { jointsOf, robotOf, type JointReading } from '../readings';
import type { State } from '../state';

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
  private sending: number | null = null;

  constructor(private readonly app: App) {
    app.store.watch(['model', 'graph', 'robot'], () => this.build());
  }

  pulse(state: State): void {
    const robot = robotOf(state, this.app.store.robot?.id);
    for (const reading of robot === null ? [] : jointsOf(state, robot)) {
      this.rows.get(reading.name)?.show(reading);
    }
  }

  private build(): void {
    const { model, robot } = this.app.store;
    const publisher = robot?.joint_publisher ?? null;
    const moved = model?.joints ?? [];
    this.rows.clear();
    if (moved.length === 0) {
      this.element.replaceChildren(h('p', { class: 'empty' }, 'No joint moves.'));
      return;
    }
    const free = moved.filter((joint) => joint.follows === null);
    this.element.replaceChildren(
      publisher === null ? this.watching() : this.tools(free),
      ...moved.map((joint) => this.row(joint, publisher !== null && joint.follows === null)),
    );
  }

  private watching(): HTMLElement {
    const source = this.app.store.robot?.joint_states;
    const text =
      source === null || source === undefined
        ? 'Nobody publishes joint states.'
        : `Measured, from ${source}. Sliders appear with a joint_state_publisher.`;
    return h('p', { class: 'fine' }, text);
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
    const head = h('span', { class: 'joint-name', title: joint.kind }, joint.name);
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
      return h('div', { class: 'joint', title: follows }, head, value, other);
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
    const set = (position: number): void => {
      slider.valueAsNumber = position;
      field.value = position.toFixed(3);
    };
    slider.addEventListener('input', () => {
      field.value = slider.valueAsNumber.toFixed(3);
      this.want(name, slider.valueAsNumber);
    });
    field.addEventListener('change', () => {
      const value = field.valueAsNumber;
      const position = Number.isNaN(value) ? zero : Math.min(upper, Math.max(lower, value));
      set(position);
      this.want(name, position);
    });
    this.rows.set(name, {
      set,
      show: (reading) => {
        setText(other, motion(reading));
        // A hand on the slider, or a value being typed, is not overruled by what comes back.
        const busy = slider.matches(':active') || document.activeElement === field;
        if (!busy && Number.isFinite(reading.position) && this.sending === null) {
          set(reading.position);
        }
      },
    });
    return h('div', { class: 'joint slides' }, head, field, slider, other);
  }

  /** Send the position with the next frame of the screen, and others that come until then. */
  private want(name: string, position: number): void {
    this.wanted[name] = position;
    this.sending ??= requestAnimationFrame(() => {
      this.sending = null;
      const robot = this.app.store.robot;
      if (robot !== null) {
        const positions = { ...this.wanted };
        this.app.connection.send({ type: 'set_joints', robot: robot.id, positions });
      }
      for (const sent of Object.keys(this.wanted)) {
        delete this.wanted[sent];
      }
    });
  }
}
