// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The colours of heights and intensities: blue is low, red is high. */
import { Color } from 'three';

const STOPS = ['#3b4cc0', '#2aa7d8', '#3ecf74', '#f2d13d', '#e0452f'];
const STEPS = 256;
let table: Uint8Array | null = null;

/** 256 colours, three bytes each, in linear light. */
export function rainbow(): Uint8Array {
  table ??= Uint8Array.from({ length: 3 * STEPS }, (_, at) => {
    const place = ((STOPS.length - 1) * Math.floor(at / 3)) / (STEPS - 1);
    const stop = Math.min(Math.floor(place), STOPS.length - 2);
    const colour = new Color(STOPS[stop]).lerp(new Color(STOPS[stop + 1]), place - stop);
    return Math.round(255 * colour.toArray()[at % 3]!);
  });
  return table;
}
