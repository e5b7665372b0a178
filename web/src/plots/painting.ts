// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What is no line over time: states as lanes, and numbers over another one. */
import type uPlot from 'uplot';
import type { Names } from '../channels';
import { colour } from '../theme';
import type { ChartLines } from './lines';
import type { Series } from './series';

const MOST_POINTS = 4000; // of a line
const COLOURS = 6;
const GAP = 3; // px between two lanes, and around words
const DOT = 3; // px, radius of the newest place

type Reader = (line: ChartLines['lines'][number]) => Series | null;

/** What is painted, and where: the least and the greatest x and y. */
export interface Painting {
  x: readonly [number, number];
  y: readonly [number, number];
  paint: (plot: uPlot) => void;
}

interface Span {
  from: number; // s
  to: number;
  value: number;
}

/**
 * A lane for each state, the first on top, whose name stands there once; a state lasts until the next
 * one, and until the latest time (s) of all.
 */
export function lanes({ lines }: ChartLines, read: Reader, range: readonly [number, number], latest: number): Painting {
  const all = lines.map((line) => spansOf(read(line), range[0], Math.min(range[1], latest)));
  return {
    x: range,
    y: [0, lines.length],
    paint: (plot) => {
      const at = (value: number, scale: 'x' | 'y'): number => plot.valToPos(value, scale, true);
      const { ctx } = plot;
      ctx.textAlign = 'left';
      ctx.font = `${11 * devicePixelRatio}px system-ui`;
      ctx.textBaseline = 'middle';
      for (const [index, spans] of all.entries()) {
        const names = lines[index]?.names ?? {};
        const [top, bottom] = [at(lines.length - index, 'y') + GAP, at(lines.length - index - 1, 'y') - GAP];
        for (const [place, { from, to, value }] of spans.entries()) {
          const name = names[value] ?? String(value);
          const [left, right] = [at(Math.max(from, range[0]), 'x'), at(to, 'x')];
          paintSpan(ctx, [left, top, right - left, bottom - top], colourOf(value, names), place === 0 ? `${lines[index]?.name}: ${name}` : name);
        }
      }
    },
  };
}

function paintSpan(ctx: CanvasRenderingContext2D, [x, y, width, height]: number[], fill: string, name: string): void {
  const room = (width ?? 0) - 2 * GAP;
  ctx.globalAlpha = 0.3;
  ctx.fillStyle = fill;
  ctx.fillRect(x ?? 0, y ?? 0, width ?? 0, height ?? 0);
  ctx.globalAlpha = 1;
  ctx.fillRect(x ?? 0, y ?? 0, Math.min(2, width ?? 0), height ?? 0); // where it began
  let shown = name;
  while (shown !== '' && ctx.measureText(shown).width > room) {
    shown = shown.length > 2 ? `${shown.slice(0, -2)}…` : '';
  }
  ctx.fillStyle = colour('text');
  ctx.fillText(shown, (x ?? 0) + 2 * GAP, (y ?? 0) + (height ?? 0) / 2);
}

function spansOf(series: Series | null, from: number, to: number): Span[] {
  const spans: Span[] = [];
  let open: Span | null = null;
  series?.visit(from, to, 0, (time, value) => {
    if (open !== null && (time > to || value !== open.value)) {
      open.to = Math.min(time, to);
      open = null;
    }
    if (open === null && time <= to && !Number.isNaN(value)) {
      open = { from: time, to, value };
      spans.push(open);
    }
  });
  return spans;
}

function colourOf(value: number, names: Names): string {
  return colour(`wheel-${Math.max(0, Object.keys(names).indexOf(String(value))) % COLOURS}`);
}

/** Lines over the first one, each with a dot at its newest place; null: nothing is known of it. */
export function overFirst({ lines }: ChartLines, read: Reader, range: readonly [number, number]): Painting | null {
  const [first, ...rest] = lines;
  const over = first === undefined ? null : read(first);
  const drawn = rest.map((line) => ({ points: pointsOf(over, read(line), ...range), colour: line.colour }));
  const known = drawn.flatMap(({ points }) => points).filter(([x, y]) => !Number.isNaN(x + y));
  if (known.length === 0) {
    return null;
  }
  return {
    x: widened(known.map(([x]) => x)),
    y: extremes(known.map(([, y]) => y)),
    paint: (plot) => {
      for (const line of drawn) {
        paintLine(plot, line.points, colour(line.colour));
      }
    },
  };
}

type Point = readonly [x: number, y: number];

/** At the times of the second one. */
function pointsOf(x: Series | null, y: Series | null, from: number, to: number): Point[] {
  const points: Point[] = [];
  y?.visit(from, to, (to - from) / MOST_POINTS, (time, value) => {
    if (time >= from && time <= to) {
      points.push([x?.at(time) ?? Number.NaN, value]);
    }
  });
  return points;
}

function paintLine(plot: uPlot, points: readonly Point[], stroke: string): void {
  const { ctx } = plot;
  let last: Point | null = null;
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.strokeStyle = ctx.fillStyle = stroke;
  ctx.beginPath();
  for (const [x, y] of points) {
    if (Number.isNaN(x + y)) {
      last = null;
      continue;
    }
    const next: Point = [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
    if (last === null) {
      ctx.moveTo(...next);
    } else {
      ctx.lineTo(...next);
    }
    last = next;
  }
  ctx.stroke();
  if (last !== null) {
    ctx.beginPath();
    ctx.arc(...last, DOT * devicePixelRatio, 0, 2 * Math.PI);
    ctx.fill();
  }
}

function extremes(values: readonly number[]): [number, number] {
  return values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
}

function widened(values: readonly number[]): [number, number] {
  const [low, high] = extremes(values);
  const more = Math.max(0.04 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high))) || 0.5;
  return [low - more, high + more];
}
