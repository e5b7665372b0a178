// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The sensors of the robot: each with a switch, what it says, and the pictures of cameras. */
import type { App, Panel } from '../app';
import { h, setText } from '../dom';
import type { Picture, SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import { PictureCanvas } from '../sensors/canvas';
import type { Sensing } from '../sensors/sensing';
import { measured, timing } from '../sensors/words';
import type { State } from '../state';

interface Row {
  info: SensorInfo;
  element: HTMLElement;
  knob: HTMLButtonElement;
  timing: HTMLElement;
  words: HTMLElement;
  canvas: PictureCanvas | null;
}

export class SensorsPanel implements Panel {
  readonly id = 'sensors';
  readonly title = 'Sensors';
  readonly element = h('div', {});
  private readonly list = h('ul', { class: 'rows sensors' });
  private rows: Row[] = [];
  private signature = '';

  constructor(
    { store }: App,
    private readonly sensing: Sensing,
  ) {
    this.element.append(
      this.list,
      h('p', { class: 'fine' }, 'What is off is not subscribed: nobody has to measure it.'),
    );
    store.watch(['graph', 'robot'], () => this.build());
  }

  /** The topics that can be seen here now. */
  get topics(): readonly string[] {
    return this.sensing.shown.map(({ topic }) => topic);
  }

  /** How many pictures were drawn, by topic. */
  get drawn(): Record<string, number> {
    const pairs = this.rows.flatMap(({ info, canvas }) =>
      canvas === null ? [] : [[info.topic, canvas.counts.drawn] as const],
    );
    return Object.fromEntries(pairs);
  }

  pulse(state: State): void {
    for (const row of this.rows) {
      const sample = this.sensing.latest.get(row.info.topic);
      if (sample !== undefined) {
        setText(row.timing, timing(sample, state.time));
        this.showMeasured(row, sample, state);
      }
    }
  }

  private showMeasured(row: Row, sample: Sample, state: State): void {
    const { head } = sample;
    row.words.dataset.tone = head.type === 'unreadable' ? 'warning' : '';
    setText(row.words, this.homeless(row.info, sample, state) ?? measured(sample, state.time));
    if (head.type === 'picture') {
      row.canvas?.show(sample as Sample<Picture>);
    }
  }

  /** Why a sample is not in the scene; null: it is, or it need not be. */
  private homeless({ kind, robot }: SensorInfo, { head }: Sample, { layout }: State): string | null {
    if (kind === 'picture' || head.type === 'unreadable' || head.origin.frame === 'world') {
      return null;
    }
    const { frame } = head.origin;
    const names = [frame, `${robot.slice(1)}/${frame}`];
    const there = layout.frames.some(
      ({ name, parent }) => names.includes(name) || names.includes(parent),
    );
    return there ? null : `its frame "${frame}" is not in TF, so that it has no place in the view`;
  }

  private build(): void {
    const sensors = this.sensing.here;
    const signature = JSON.stringify(sensors);
    if (signature === this.signature) {
      return; // the same again must not take the focus from a switch
    }
    this.signature = signature;
    const kept = new Map(this.rows.map((row) => [JSON.stringify(row.info), row]));
    this.rows = sensors.map((info) => kept.get(JSON.stringify(info)) ?? this.row(info));
    this.list.replaceChildren(...this.rows.map(({ element }) => element));
    if (this.rows.length === 0) {
      const text = 'No sensor of this robot publishes: no scan, cloud, picture, range or contact.';
      this.list.replaceChildren(h('li', { class: 'empty' }, text));
    }
  }

  private row(info: SensorInfo): Row {
    const { topic, kind, message } = info;
    const name = topic.replace(/\/compressed$/, ''); // the type says so
    const knob = h('button', {
      type: 'button',
      role: 'switch',
      class: 'switch',
      'aria-label': `Show ${topic}`,
    });
    const row: Row = {
      info,
      knob,
      element: h('li', { class: 'unit sensor' }),
      timing: h('span', { class: 'fine' }),
      words: h('span', { class: 'fine measured' }),
      canvas: kind === 'picture' ? new PictureCanvas(topic) : null,
    };
    knob.addEventListener('click', () => {
      this.sensing.set(topic, !this.sensing.isOn(info));
      this.showSwitch(row);
    });
    row.element.append(
      h('span', { class: 'unit-name', title: `${topic} (${message})` }, name),
      h('span', { class: 'chip', title: message }, message.split('/').at(-1) ?? message),
      knob,
      row.timing,
      row.words,
    );
    if (row.canvas !== null) {
      row.element.append(row.canvas.element);
    }
    this.showSwitch(row);
    return row;
  }

  private showSwitch({ info, knob, timing: often, words, canvas }: Row): void {
    const on = this.sensing.isOn(info);
    knob.setAttribute('aria-checked', String(on));
    knob.title = on ? 'Hide it' : 'Show it';
    setText(often, on ? 'nothing has come yet' : '');
    setText(words, '');
    if (canvas !== null) {
      canvas.element.hidden = true;
    }
  }
}
