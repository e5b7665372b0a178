// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What a series holds, for tests. */
import type { Series } from '../src/plots/series';

export function values(series: Series, from = -Infinity, to = Infinity, step = 0): [number, number][] {
  const found: [number, number][] = [];
  series.visit(from, to, step, (time, value) => found.push([time, value]));
  return found;
}
