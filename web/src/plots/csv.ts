// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A table of samples as comma-separated values (RFC 4180). */
import type { Table } from './history';

/** One line of names, then one a sample; what is not known is empty. */
export function toCsv(names: readonly string[], table: Table): string {
  const lines = [names.map(quoted).join(',')];
  for (let row = 0; row < table[0].length; row += 1) {
    lines.push(table.map((column) => number(column[row])).join(','));
  }
  return `${lines.join('\r\n')}\r\n`;
}

function quoted(name: string): string {
  return /[",\r\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name;
}

/** To a millionth: m, m/s and s need no more, and a float32 knows no more of them. */
function number(value: number | null | undefined): string {
  if (value === null || value === undefined) {
    return '';
  }
  return String(Number(value.toFixed(6)));
}
