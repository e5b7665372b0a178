// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** One plot over time. */
import uPlot from 'uplot';
import { h } from '../dom';
import { clock, fixed, UNKNOWN } from '../format';
import { colour } from '../theme';
import type { Table } from './history';

export interface Line {
  name: string;
  colour: string; // the name of a colour of the style sheet
  column: number; // of the table, from 0 behind the time
  wanted?: number; // the column of what it ought to be, drawn dashed
}

const LEAST_HEIGHT = 60; // px
const LEAST_SPAN = 0.2; // of the values, so that noise at rest does not fill the plot
const NONE = { show: false };
const KEY_STEP = 0.02; // share of the width that an arrow key moves the cursor

export class Chart {
  readonly element: HTMLElement;
  private readonly place: HTMLElement;
  private readonly legend: HTMLElement;
  private plot: uPlot | null = null;
  private table: uPlot.AlignedData = [[]];
  private range: [number, number] = [0, 1];

  constructor(
    readonly title: string,
    readonly unit: string,
    private lines: readonly Line[],
    private readonly always: readonly [number, number] | null = null, // values always in view
  ) {
    this.legend = h('div', { class: 'chart-legend' });
    this.place = h('div', {
      class: 'chart-plot',
      tabindex: 0,
      role: 'group',
      'aria-label': `${title} over time; the left and right arrow keys move the cursor`,
    });
    const heading = h('span', { class: 'chart-title' }, title, h('span', { class: 'fine' }, unit));
    this.element = h(
      'figure',
      { class: 'chart' },
      h('figcaption', {}, heading, this.legend),
      this.place,
    );
    this.place.addEventListener('keydown', (event) => this.moveCursor(event));
    new ResizeObserver(() => this.fit()).observe(this.place);
  }

  get series(): readonly Line[] {
    return this.lines;
  }

  /** Draw other lines from now on. */
  setLines(lines: readonly Line[]): void {
    if (JSON.stringify(lines) !== JSON.stringify(this.lines)) {
      this.lines = lines;
      this.rebuild();
    }
  }

  /** Show what is in a table from the first to the second time (s). */
  show(table: Table, range: [number, number]): void {
    this.table = [table[0], ...this.columns().map((column) => table[column + 1] ?? [])];
    this.range = range;
    if (this.plot === null) {
      this.rebuild();
    } else {
      this.plot.setData(this.table);
    }
    if (this.plot !== null && (this.plot.cursor.left ?? -1) < 0 && table[0].length > 0) {
      this.plot.setLegend({ idx: table[0].length - 1 });
    }
  }

  /** Make the plot anew: its colours are those of another theme. */
  rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
    const { clientWidth, clientHeight } = this.place;
    if (clientWidth > 0 && clientHeight >= LEAST_HEIGHT) {
      const size = { width: clientWidth, height: clientHeight };
      this.plot = new uPlot({ ...this.options(), ...size }, this.table, this.place);
      this.fit(); // its legend takes place, too
    }
  }

  /** Draw the same in another size (CSS px), apart from the page, and give what was drawn. */
  picture<T>(width: number, height: number, take: (canvas: HTMLCanvasElement) => T): Promise<T> {
    return new Promise((resolve) => {
      const drawn = (plot: uPlot): void => {
        resolve(take(plot.ctx.canvas));
        queueMicrotask(() => plot.destroy());
      };
      const apart = { legend: { show: false }, cursor: { show: false }, hooks: { draw: [drawn] } };
      new uPlot({ ...this.options(), width, height, ...apart }, this.table, h('div'));
    });
  }

  private fit(): void {
    const { clientWidth, clientHeight } = this.place;
    if (this.plot === null) {
      this.rebuild();
    } else if (clientHeight > 0 && !this.fits()) {
      this.plot.setSize({ width: clientWidth, height: clientHeight });
    }
  }

  private fits(): boolean {
    const { clientWidth, clientHeight } = this.place;
    return clientWidth === this.plot?.width && clientHeight === this.plot.height;
  }

  private moveCursor(event: KeyboardEvent): void {
    const step = { ArrowLeft: -KEY_STEP, ArrowRight: KEY_STEP }[event.key];
    if (this.plot !== null && step !== undefined) {
      const width = this.plot.over.clientWidth;
      const from = this.plot.cursor.left ?? -1;
      const left = (from < 0 ? width : from) + step * width;
      this.plot.setCursor({ left: Math.min(width - 1, Math.max(0, left)), top: 1 });
    }
  }

  private options(): Omit<uPlot.Options, 'width' | 'height'> {
    const grid = { stroke: colour('grid'), width: 1 };
    const axis = { stroke: colour('muted'), grid, ticks: { show: false }, font: '11px system-ui' };
    return {
      scales: {
        x: { time: false, range: () => this.range },
        y: { range: (_plot, least, most) => this.spanOf(least, most) },
      },
      axes: [
        { ...axis, size: 22, gap: 4, values: (_plot, times) => times.map(label) },
        { ...axis, size: 38, gap: 4 },
      ],
      series: [
        { label: 't', value: (_plot, time) => (time === null ? UNKNOWN : clock(time)) },
        ...this.lines.map((line) => this.solid(line)),
        ...this.withWanted().map(dashed),
      ],
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: 'amr' } },
      legend: {
        mount: (_plot, table) => this.legend.replaceChildren(table),
        markers: { width: 2 },
      },
    };
  }

  private withWanted(): Line[] {
    return this.lines.filter(({ wanted }) => wanted !== undefined);
  }

  /** What is drawn, in the order of the series: the lines, then what they ought to be. */
  private columns(): number[] {
    return [...this.lines.map(({ column }) => column), ...this.withWanted().map(wantedOf)];
  }

  private solid(line: Line): uPlot.Series {
    const wanted = this.withWanted().indexOf(line);
    const value = (plot: uPlot, is: number | null, _series: number, at: number | null): string => {
      const ought = plot.data[1 + this.lines.length + wanted]?.[at ?? -1];
      return wanted < 0 ? fixed(is, 2) : `${fixed(is, 2)} / ${fixed(ought, 2)}`;
    };
    return { label: line.name, stroke: colour(line.colour), width: 1.5, points: NONE, value };
  }

  /** Somewhat more than the values take, and never less than LEAST_SPAN. */
  private spanOf(least: number | null, most: number | null): [number, number] {
    const low = Math.min(least ?? 0, this.always?.[0] ?? Infinity);
    const high = Math.max(most ?? 0, this.always?.[1] ?? -Infinity);
    const more = Math.max((high - low) * 0.08, (LEAST_SPAN - (high - low)) / 2);
    return [low - more, high + more];
  }
}

/** Beside its line there is no room for it in the legend, and it needs none. */
function dashed(line: Line): uPlot.Series {
  const stroke = colour(line.colour);
  return { class: 'wanted', stroke, width: 1, dash: [4, 4], points: NONE };
}

function wantedOf({ wanted, column }: Line): number {
  return wanted ?? column;
}

function label(time: number): string {
  return time > 1e8 ? clock(time) : `${Number(time.toFixed(2))}`;
}
