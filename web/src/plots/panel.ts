// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The plots: velocities, wheels, real-time factor; a window of time, pause, what one saves. */
import type { App, Panel } from '../app';
import { button, h, toggle } from '../dom';
import { SOURCES } from '../readings';
import { recallNumber, remember } from '../remember';
import { saveFile } from '../save';
import type { State } from '../state';
import { Chart, type Line } from './chart';
import { toCsv } from './csv';
import type { Table } from './history';
import { toPng } from './png';
import {
  FACTOR_COLUMN, SPAN, velocityColumn, wheelColumn, type Record, type Recorder,
} from './recorder';

const WINDOWS = [10, 30, 60, 120, SPAN]; // s
const REDRAW = 100; // ms between two drawings of a short window
const LONG_REDRAW = 500; // ms, of the longest: five minutes are 18 000 samples a line
const WHEEL_COLOURS = 6;

export class PlotsPanel implements Panel {
  readonly id = 'plots';
  readonly title = 'Plots';
  readonly element: HTMLElement;
  private readonly charts: Chart[];
  private window = recallNumber('window', WINDOWS[0], SPAN, 30);
  private paused: { table: Table; end: number } | null = null;
  private drawnAt = 0;

  constructor(
    private readonly app: App,
    private readonly recorder: Recorder,
  ) {
    this.charts = [
      new Chart('Linear velocity', 'm/s', velocities('linear')),
      new Chart('Angular velocity', 'rad/s', velocities('angular')),
      new Chart('Wheel speeds', 'rad/s, commanded dashed', []),
      new Chart('Real-time factor', '×', [
        { name: 'real', colour: 'accent', column: FACTOR_COLUMN },
      ], [0, 1]),
    ];
    this.charts[2].element.classList.add('wide'); // its legend has two numbers a wheel
    this.charts[3].element.classList.add('narrow');
    this.element = h(
      'section',
      { class: 'plots', 'aria-label': 'Plots' },
      this.tools(),
      h('div', { class: 'charts' }, ...this.charts.map((chart) => chart.element)),
    );
    app.store.watch(['graph', 'robot', 'reset'], () => this.draw());
  }

  pulse(_state: State): void {
    const gap = REDRAW + (LONG_REDRAW - REDRAW) * (this.window / SPAN);
    if (this.paused === null && performance.now() - this.drawnAt >= 0.9 * gap) {
      this.draw();
    }
  }

  /** The colours changed. */
  repaint(): void {
    for (const chart of this.charts) {
      chart.rebuild();
    }
  }

  private draw(): void {
    this.drawnAt = performance.now();
    const record = this.recorder.of(this.app.store.robot?.id);
    const { table, end } = this.paused ?? this.current(record);
    this.charts[2].setLines(wheelLines(record?.wheels ?? []));
    this.charts[3].element.hidden = this.app.store.simulator === null;
    for (const chart of this.charts) {
      chart.show(table, [end - this.window, end]);
    }
  }

  private current(record: Record | null): { table: Table; end: number } {
    if (record === null) {
      return { table: [[]], end: this.window };
    }
    const end = record.history.latest;
    return { table: record.history.since(end - this.window), end: Number.isNaN(end) ? 0 : end };
  }

  private tools(): HTMLElement {
    const choice = h(
      'select',
      { 'aria-label': 'Window of time' },
      ...WINDOWS.map((seconds) =>
        h('option', { value: seconds }, seconds < 60 ? `${seconds} s` : `${seconds / 60} min`),
      ),
    );
    choice.value = String(this.window);
    choice.addEventListener('change', () => {
      this.window = Number(choice.value);
      remember('window', choice.value);
      this.draw();
    });
    return h(
      'div',
      { class: 'plot-tools', role: 'toolbar', 'aria-label': 'Plots' },
      h('h2', {}, 'Plots'),
      choice,
      toggle('Pause', false, (on) => this.pause(on), 'Hold the plots; recording goes on'),
      h('span', { class: 'grow' }),
      button('CSV', () => this.saveCsv(), { kind: 'quiet', title: 'Save these samples as CSV' }),
      button('PNG', () => void this.savePng(), { kind: 'quiet', title: 'Save an image' }),
    );
  }

  /** Hold what is seen, and all that is kept, so that one can look at a longer window of it. */
  private pause(on: boolean): void {
    const record = this.recorder.of(this.app.store.robot?.id);
    const end = record?.history.latest ?? 0;
    this.paused =
      on && record !== null ? { table: record.history.since(end - SPAN), end } : null;
    this.draw();
  }

  private saveCsv(): void {
    const record = this.recorder.of(this.app.store.robot?.id);
    const { table, end } = this.paused ?? this.current(record);
    const first = table[0].findIndex((time) => time >= end - this.window);
    const shown = table.map((column) => column.slice(Math.max(0, first))) as Table;
    const names = ['time_s', ...columnNames(record?.wheels ?? [])];
    saveFile('velocities.csv', new Blob([toCsv(names, shown)], { type: 'text/csv' }));
  }

  private async savePng(): Promise<void> {
    const image = await toPng(this.charts.filter((chart) => !chart.element.hidden));
    if (image === null) {
      this.app.store.note('warning', 'This browser could not draw the image.');
    } else {
      saveFile('plots.png', image);
    }
  }
}

function velocities(which: 'linear' | 'angular'): Line[] {
  return SOURCES.map((source, index) => ({
    name: source,
    colour: source,
    column: velocityColumn(index, which),
  }));
}

function wheelLines(wheels: readonly string[]): Line[] {
  return wheels.map((name, index) => ({
    name: name.replace(/^(joint_)?(wheel_)?/, '').replace(/(_wheel)?(_joint)?$/, ''),
    colour: `wheel-${index % WHEEL_COLOURS}`,
    column: wheelColumn(index, 'measured'),
    wanted: wheelColumn(index, 'commanded'),
  }));
}

function columnNames(wheels: readonly string[]): string[] {
  return [
    ...SOURCES.flatMap((source) => [`${source}_linear_m_s`, `${source}_angular_rad_s`]),
    'real_time_factor',
    ...wheels.flatMap((name) => [`${name}_rad_s`, `${name}_commanded_rad_s`]),
  ];
}
