// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Numbers that came at times of their own, on one grid of times that a chart can draw. */
import type { AlignedData } from 'uplot';
import type { Series } from './series';

export interface Aligned {
  data: AlignedData; // undefined: nothing came then; null: it was not known
  /** Of each series, how far apart its values in view are; -Infinity: there are none. */
  spreads: number[];
}

type Cell = number | null | undefined;

/**
 * Series between two times (s), each as the least and the greatest value of as many steps of equal
 * length as there are pixels, and the value before and behind, so that lines go to the edges. The
 * steps begin at multiples of their length: a picture that moves on by one is otherwise the same.
 */
export function align(
  series: readonly (Series | null)[],
  from: number,
  to: number,
  steps: number,
): Aligned {
  const step = (to - from) / steps;
  const begin = Math.floor(from / step) * step;
  const count = steps + 1;
  const rows = 2 * count;
  const columns = series.map((one) => (one === null ? null : new Column(one, begin, step, count)));
  const outside = (of: (column: Column) => Point | null): [number, number, number][] =>
    columns
      .flatMap((column, index): [number, number, number][] => {
        const point = column === null ? null : of(column);
        return point === null || Number.isNaN(point[1]) ? [] : [[index, ...point]];
      })
      .sort(([, one], [, other]) => one - other);
  const before = outside((column) => column.before);
  const behind = outside((column) => column.behind);
  const times = new Array<number>(rows);
  for (let row = 0; row < rows; row += 1) {
    times[row] = begin + (row / 2 + 0.25) * step;
  }
  const edge = (points: [number, number, number][], index: number): Cell[] =>
    points.map(([of, , value]) => (of === index ? value : undefined));
  const x = [...before.map(([, time]) => time), ...times, ...behind.map(([, time]) => time)];
  const y = columns.map((column, index) => [
    ...edge(before, index),
    ...(column?.cells ?? new Array<Cell>(rows)),
    ...edge(behind, index),
  ]);
  return {
    data: [x, ...y] as AlignedData,
    spreads: columns.map((column) => (column === null ? -Infinity : column.most - column.least)),
  };
}

type Point = [time: number, value: number];

class Column {
  readonly cells: Cell[];
  before: Point | null = null;
  behind: Point | null = null;
  least = Infinity;
  most = -Infinity;

  constructor(series: Series, from: number, step: number, steps: number) {
    const to = from + steps * step;
    this.cells = new Array<Cell>(2 * steps);
    let at = -1; // the step that is being filled
    let [low, high, isLowFirst, unknownFirst, unknownLast] = [0, 0, true, false, false];
    let count = 0;
    const settle = (): void => {
      if (at >= 0) {
        const [first, second] = isLowFirst ? [low, high] : [high, low];
        this.cells[2 * at] = count === 0 || unknownFirst ? null : first;
        this.cells[2 * at + 1] = unknownLast ? null : count > 1 || unknownFirst ? second : undefined;
      }
    };
    series.visit(from, to, step, (time, value) => {
      if (time < from) {
        this.before = [time, value];
        return;
      }
      if (time > to) {
        this.behind ??= [time, value];
        return;
      }
      const now = Math.min(steps - 1, Math.floor((time - from) / step));
      if (now !== at) {
        settle();
        at = now;
        [low, high, isLowFirst, unknownFirst, unknownLast] = [value, value, true, false, false];
        count = 0;
      }
      if (Number.isNaN(value)) {
        unknownFirst ||= count === 0;
        unknownLast = true;
        return;
      }
      if (count === 0) {
        [low, high] = [value, value];
      } else if (value < low) {
        [low, isLowFirst] = [value, false];
      } else if (value > high) {
        [high, isLowFirst] = [value, true];
      }
      unknownLast = false;
      count += 1;
      this.least = Math.min(this.least, value);
      this.most = Math.max(this.most, value);
    });
    settle();
  }
}
