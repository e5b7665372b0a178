// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What stands at the axes of a chart. */
import { clock } from '../format';

const CLOCK = 1e8; // s: later times are of a clock, not of a simulation

/** Values as they stand beside a chart, which are multiples of a step: "0.25", "2e-5", "3e+7". */
export function valueLabels(values: readonly number[], step: number): string[] {
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  const isPlain = decimals <= 5 && values.every((value) => Math.abs(value) < 1e7);
  return values.map((value) => {
    const multiple = Math.round(value / step) * step; // else 0 is sometimes 1e-18
    const exact = Number(multiple.toPrecision(10));
    return (isPlain || exact === 0 ? String(exact) : exact.toExponential()).replace(/^-/, '−');
  });
}

/** Labels that are centred on these places (CSS px from the left end), without those that reach beyond it. */
export function withinAxis(labels: readonly string[], places: readonly number[], digit: number): string[] {
  return labels.map((label, index) => ((places[index] ?? 0) < (label.length * digit) / 2 ? '' : label));
}

/** Times as they stand below a chart: "12 s", or of a clock, "14:03:20". */
export function timeLabels(times: readonly number[]): string[] {
  const isFine = times.some((time) => !Number.isInteger(Number(time.toFixed(3))));
  return times.map((time) => {
    if (time <= CLOCK) {
      return `${Number(time.toFixed(3))} s`;
    }
    return isFine ? `${clock(time)}${(time % 1).toFixed(2).slice(1)}` : clock(time);
  });
}
