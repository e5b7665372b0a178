// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Numbers over time as comma-separated values (RFC 4180). */
import type { Series } from './series';

export interface NamedSeries {
  name: string;
  series: Series;
}

/**
 * One line of names, then one for each time at which there is a value, from the first to the second
 * (s); what is not known then, or did not come just then, is empty.
 */
export function toCsv(columns: readonly NamedSeries[], from: number, to: number): string {
  const rows = new Map<number, (number | undefined)[]>();
  for (const [index, { series }] of columns.entries()) {
    series.visit(from, to, 0, (time, value) => {
      if (time >= from && time <= to) {
        const row = rows.get(time) ?? new Array<number | undefined>(columns.length);
        row[index] = value;
        rows.set(time, row);
      }
    });
  }
  const lines = [...rows]
    .sort(([one], [other]) => one - other)
    .map(([time, values]) => [String(Number(time.toFixed(6))), ...Array.from(values, number)].join(','));
  const head = ['time_s', ...columns.map(({ name }) => name)].map(quoted).join(',');
  return [head, ...lines, ''].join('\r\n');
}

function quoted(name: string): string {
  return /[",\r\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name;
}

/** As exact as it is: a value of the states is a float32, and has seven digits. */
function number(value: number | undefined): string {
  if (value === undefined || Number.isNaN(value)) {
    return '';
  }
  return String(Number(value.toPrecision(Math.fround(value) === value ? 7 : 15)));
}
