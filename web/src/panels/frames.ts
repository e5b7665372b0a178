// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The TF tree, the fixed frame, and where the chosen frame is. */
import type { App, Panel } from '../app';
import { h, section, setText } from '../dom';
import { degrees, fixed, UNKNOWN } from '../format';
import { poseIn, rollPitchYaw, rootsOf } from '../poses';
import type { Layout } from '../protocol';
import type { State } from '../state';

export class FramesPanel implements Panel {
  readonly id = 'frames';
  readonly title = 'Frames';
  readonly element = h('div', {});
  private readonly tree = h('ul', { class: 'tree', 'aria-label': 'TF tree' });
  private readonly fixed = h('select', { id: 'fixed-frame' });
  private readonly where = h('div', {});
  private readonly rows = new Map<string, HTMLElement>();
  private readonly values = new Map<string, HTMLElement>();
  private signature = '';

  /** `choices`: the frames that the scene can hold still. */
  constructor(
    private readonly app: App,
    private readonly choices: () => readonly string[],
  ) {
    const { store } = app;
    this.fixed.addEventListener('change', () => store.setFixedFrame(this.fixed.value || null));
    this.element.append(
      h('label', { class: 'field' }, h('span', {}, 'Fixed frame'), this.fixed),
      section('Tree', this.tree),
      section('Chosen frame', this.where),
    );
    store.watch(['layout'], () => this.build());
    store.watch(['frame'], () => {
      this.fixed.value = store.fixedFrame ?? '';
    });
    store.watch(['selection', 'frame'], () => this.showSelection());
  }

  pulse(state: State): void {
    const frame = this.app.store.selection?.frame ?? null;
    if (frame === null) {
      return;
    }
    const fixedFrame = this.app.store.fixedFrame ?? rootsOf(state.layout)[0];
    const parent = state.layout.frames.find(({ name }) => name === frame)?.parent;
    for (const [key, target] of [['parent', parent], ['fixed', fixedFrame]] as const) {
      const pose = target === undefined ? null : poseIn(state, frame, target);
      const [x, y, z] = pose?.position ?? [];
      const [roll, pitch, yaw] = pose === null ? [] : rollPitchYaw(pose.orientation);
      const numbers = pose === null ? [] : pose.orientation;
      this.put(`${key} in`, target ?? UNKNOWN);
      this.put(`${key} xyz`, [x, y, z].map((value) => fixed(value, 3)).join('  '));
      this.put(`${key} rpy`, [roll, pitch, yaw].map((a) => degrees(a ?? Number.NaN)).join('  '));
      this.put(`${key} q`, numbers.map((value) => fixed(value, 3)).join('  '));
    }
  }

  private put(key: string, text: string): void {
    const element = this.values.get(key);
    if (element !== undefined) {
      setText(element, text);
    }
  }

  private build(): void {
    const layout = this.app.store.layout;
    const signature = JSON.stringify(layout?.frames ?? []);
    if (signature === this.signature) {
      return;
    }
    this.signature = signature;
    this.rows.clear();
    const roots = layout === null ? [] : rootsOf(layout);
    this.fixed.replaceChildren(
      h('option', { value: '' }, 'automatic'),
      ...this.choices().map((name) => h('option', { value: name }, name)),
    );
    this.fixed.value = this.app.store.fixedFrame ?? '';
    this.tree.replaceChildren(
      ...(layout === null ? [] : roots.map((root) => this.branch(root, layout))),
    );
    if (roots.length === 0) {
      this.tree.replaceChildren(h('li', { class: 'empty' }, 'Nobody publishes transforms.'));
    }
    this.showSelection();
  }

  private branch(frame: string, layout: Layout): HTMLElement {
    const children = layout.frames
      .filter(({ parent }) => parent === frame)
      .map(({ name }) => this.branch(name, layout));
    const row = h('button', { type: 'button', class: 'frame' }, frame);
    row.addEventListener('click', () => {
      const robot = this.app.store.robot?.id ?? '/';
      this.app.store.select({ robot, frame });
    });
    this.rows.set(frame, row);
    return h('li', {}, row, children.length === 0 ? null : h('ul', {}, ...children));
  }

  private showSelection(): void {
    const frame = this.app.store.selection?.frame ?? null;
    for (const [name, row] of this.rows) {
      row.setAttribute('aria-pressed', String(name === frame));
    }
    this.values.clear();
    if (frame === null) {
      const text = 'Choose a frame here, or click a part of the robot.';
      this.where.replaceChildren(h('p', { class: 'fine' }, text));
      return;
    }
    this.where.replaceChildren(
      h('p', { class: 'chosen' }, frame),
      this.poseTable('parent', 'Relative to'),
      this.poseTable('fixed', 'Relative to'),
    );
  }

  private poseTable(key: string, title: string): HTMLElement {
    const line = (name: string, what: string): HTMLElement => {
      const value = h('dd', {}, UNKNOWN);
      this.values.set(`${key} ${what}`, value);
      return h('div', {}, h('dt', {}, name), value);
    };
    return h(
      'dl',
      { class: 'facts numbers' },
      line(title, 'in'),
      line('x y z, m', 'xyz'),
      line('roll pitch yaw', 'rpy'),
      line('quaternion x y z w', 'q'),
    );
  }
}
