// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The lines of a chart on a canvas, and when they have to be drawn anew. */
import uPlot from 'uplot';
import { h } from '../dom';
import { colour } from '../theme';
import { align } from './align';
import { timeLabels, valueLabels, withinAxis } from './axis_labels';
import type { Bounds } from './layout';
import type { ChartLines, Source, Stroke } from './lines';
import { lanes, overFirst, type Painting } from './painting';
import type { Series } from './series';

export type Reader = (source: Source) => Series | null;

const LEAST_HEIGHT = 50; // px
const LEAST_STEPS = 50;
const NONE = { show: false };
const UNDRAWN: uPlot.Series = { points: NONE, paths: () => null }; // what is painted has its values alone
const MOVING = 100; // ms between two drawings, at least
const QUIET = 500; // ms, where nothing but the time goes on
const AXIS = { height: 20, leastWidth: 34, digit: 6.6, space: 24 }; // px
const NOISE = 1e-9; // less is 0, or what rounding left of it
const MOST_VALUES = 10; // on an axis, about
const MARGIN = 0.08; // of the values, above and below

interface Drawn {
  at: number; // ms
  range: readonly [number, number];
  latest: number[]; // time of the latest value of each stroke, s
  values: number[]; // its value
}

export class Drawing {
  private plot: uPlot | null = null;
  private data: uPlot.AlignedData = [[]];
  private range: readonly [number, number] = [0, 1];
  private strokes: (Stroke & { colour: string })[] = [];
  private edges: number[] = []; // values at both ends, which lines come from and go to
  private painting: Painting | null = null; // where no lines over time are drawn
  private isFlat = false;
  private drawn: Drawn | null = null;

  /** `onSize`: called when the plot was made anew or has another size. */
  constructor(
    private readonly place: HTMLElement,
    private about: ChartLines,
    private bounds: Bounds,
    private readonly onSize: (over: HTMLElement) => void,
  ) {
    this.sortStrokes();
    new ResizeObserver(() => this.fit()).observe(place);
  }

  /** Draw other lines, or in other bounds, from now on. */
  setLines(about: ChartLines, bounds: Bounds): void {
    if (JSON.stringify([about, bounds]) !== JSON.stringify([this.about, this.bounds])) {
      [this.about, this.bounds] = [about, bounds];
      this.sortStrokes();
      this.data = [[]];
      this.edges = [];
      this.painting = null;
      this.rebuild();
    }
  }

  /** How much one pixel is, of the values; decides how exactly they are said. */
  get pixel(): number {
    const { min, max } = this.plot?.scales.y ?? {};
    return ((max ?? 1) - (min ?? 0)) / Math.max(1, this.plot?.over.clientHeight ?? 100);
  }

  /**
   * Draw what is read from the first to the second time (s), if that looks different from what is
   * drawn. `known`: s, of the latest value of all charts; `now`: ms; `isUrgent`: somebody waits for it.
   */
  show(read: Reader, range: readonly [number, number], known: number, now: number, isUrgent: boolean): void {
    const series = this.strokes.map(({ source }) => read(source));
    const latest = series.map((one) => one?.latest ?? Number.NaN);
    const values = series.map((one, index) => one?.at(latest[index] ?? 0) ?? Number.NaN);
    const next = { at: now, range, latest, values };
    if (this.plot === null || (!isUrgent && !this.isDue(next))) {
      return;
    }
    this.drawn = next;
    this.range = range;
    if (this.about.form !== 'time') {
      this.paint(read, known);
      return;
    }
    const { data, spreads } = align(series, ...range, this.steps);
    this.data = data;
    this.edges = series
      .flatMap((one) => (one === null ? [] : range.map((time) => one.at(time))))
      .filter((value) => !Number.isNaN(value));
    this.plot.setData(data);
    this.isFlat = Math.max(...spreads) < this.pixel;
  }

  private paint(read: Reader, known: number): void {
    const make = this.about.form === 'xy' ? overFirst : lanes;
    this.painting = make(this.about, ({ stroke }) => read(stroke.source), this.range, known);
    const { x, y } = this.painting ?? { x: this.range, y: [0, 1] };
    this.range = x;
    this.data = [[...x], [...y]];
    this.plot?.setData(this.data);
  }

  private paintOn(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save(); // uPlot sets no colour twice
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    this.painting?.paint(plot);
    ctx.restore();
  }

  /** Make the plot anew: its colours are those of another theme. */
  rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
    this.drawn = null;
    const { clientWidth, clientHeight } = this.place;
    if (clientWidth > 0 && clientHeight >= LEAST_HEIGHT) {
      const size = { width: clientWidth, height: clientHeight };
      this.plot = new uPlot({ ...this.options(), ...size }, this.data, this.place);
      this.onSize(this.plot.over);
    }
  }

  /** Draw the same in another size (CSS px), apart from the page, and give what was drawn. */
  picture<T>(width: number, height: number, take: (canvas: HTMLCanvasElement) => T): Promise<T> {
    return new Promise((resolve) => {
      const drawn = (plot: uPlot): void => {
        resolve(take(plot.ctx.canvas));
        queueMicrotask(() => plot.destroy());
      };
      const { hooks, ...options } = this.options();
      const draw = [...(hooks?.draw ?? []), drawn] as uPlot.Hooks.Arrays['draw'];
      new uPlot({ ...options, width, height, hooks: { draw } }, this.data, h('div'));
    });
  }

  private get steps(): number {
    return Math.max(LEAST_STEPS, this.plot?.over.clientWidth ?? 0);
  }

  /** The widest lies below. */
  private sortStrokes(): void {
    this.strokes = this.about.lines
      .flatMap(({ stroke, wanted, colour: name }) =>
        [stroke, ...(wanted === null ? [] : [wanted])].map((each) => ({ ...each, colour: name })),
      )
      .sort((one, other) => other.width - one.width);
  }

  private isDue(next: Drawn): boolean {
    const { drawn } = this;
    if (drawn === null) {
      return true;
    }
    const isSame = (one: number, other: number): boolean =>
      one === other || (Number.isNaN(one) && Number.isNaN(other));
    const every = (to: (drawn: Drawn) => readonly number[]): boolean =>
      to(drawn).every((one, index) => isSame(one, to(next)[index] ?? Number.NaN));
    if (every(({ range }) => range) && every(({ latest }) => latest)) {
      return false;
    }
    const { pixel } = this;
    const isQuiet =
      this.isFlat &&
      drawn.values.every((one, index) => {
        const other = next.values[index] ?? Number.NaN;
        return isSame(one, other) || Math.abs(one - other) < pixel;
      });
    const [from, to] = next.range;
    const onePixel = ((to - from) / this.steps) * 1000; // ms: before, it would move by less
    return next.at - drawn.at >= 0.9 * Math.max(isQuiet ? QUIET : MOVING, onePixel);
  }

  private fit(): void {
    const { clientWidth, clientHeight } = this.place;
    if (this.plot === null) {
      this.rebuild();
    } else if (clientHeight < LEAST_HEIGHT) {
      this.plot.destroy();
      this.plot = null;
    } else if (clientWidth !== this.plot.width || clientHeight !== this.plot.height) {
      this.plot.setSize({ width: clientWidth, height: clientHeight });
      this.drawn = null;
      this.onSize(this.plot.over);
    }
  }

  private options(): Omit<uPlot.Options, 'width' | 'height'> {
    const grid = { stroke: colour('grid'), width: 1 };
    const { form } = this.about;
    const isLanes = form === 'lanes';
    const axis = { stroke: colour('muted'), grid, ticks: { show: false }, font: '11px system-ui' };
    return {
      scales: {
        x: { time: false, range: () => [...this.range] as [number, number] },
        y: { range: (_plot, least, most) => this.spanOf(least, most) },
      },
      axes: [
        {
          ...axis,
          size: AXIS.height,
          gap: 3,
          space: 44,
          // One beside the least value would run into it.
          values: (plot, times, _axis, _space, step) =>
            withinAxis(form === 'xy' ? valueLabels(times, step) : timeLabels(times), times.map((time) => plot.valToPos(time, 'x')), AXIS.digit),
        },
        {
          ...axis,
          gap: 4,
          show: !isLanes,
          space: (_plot, _axis, _least, _most, height) => Math.max(AXIS.space, height / MOST_VALUES),
          values: (_plot, values, _axis, _space, step) => valueLabels(values, step),
          size: (_plot, values) =>
            Math.max(AXIS.leastWidth, 12 + AXIS.digit * Math.max(0, ...longest(values))),
        },
      ],
      series: [{}, ...(form === 'time' ? this.strokes.map(seriesOf) : [UNDRAWN])],
      hooks: { draw: [(plot) => this.paintOn(plot)] },
      cursor: NONE,
      legend: NONE,
    };
  }

  /** Somewhat more than the values take, and never less than the chart's least span. */
  private spanOf(least: number | null, most: number | null): [number, number] {
    const { always, leastSpan, form } = this.about;
    if (form === 'lanes') {
      return [0, this.about.lines.length];
    }
    const seen = [...this.edges, ...(always ?? []), ...[least, most].filter((each) => each !== null)];
    const [low, high] = seen.length === 0 ? [0, 0] : [Math.min(...seen), Math.max(...seen)];
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const enough = largest < NOISE ? leastSpan || 1 : Math.max(leastSpan, 1e-3 * largest);
    const more = Math.max((high - low) * MARGIN, (enough - (high - low)) / 2);
    const [own, upper] = this.bounds;
    const begin = own ?? low - more;
    const end = upper ?? high + more;
    return begin < end ? [begin, end] : [begin, begin + enough]; // only one is chosen, and beyond
  }
}

function seriesOf({ colour: name, width, dash, step }: Stroke & { colour: string }): uPlot.Series {
  return {
    stroke: colour(name),
    width,
    points: NONE,
    ...(dash.length > 0 && { dash: [...dash] }),
    ...(step && { paths: uPlot.paths.stepped?.({ align: 1 }) }),
  };
}

function longest(values: readonly string[] | null): number[] {
  return (values ?? []).map((text) => text.length);
}
