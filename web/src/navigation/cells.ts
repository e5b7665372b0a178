// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The cells of maps: inflated, and coloured as RViz colours them. */
import { BadState } from '../state';

export type Scheme = 'map' | 'costmap';

type Rgba = readonly [red: number, green: number, blue: number, alpha: number];

const UNKNOWN: Rgba = [140, 140, 140, 0]; // not to be seen
const SHARE = { map: 190, costmap: 150 } as const; // alpha: one sees the ground below
const OCCUPIED = 100;
const INSCRIBED = 99; // a costmap's: the middle of the robot must not be here

/** Costmaps have their scheme by name, as in Nav2: `/global_costmap/costmap`. */
export function schemeOf(topic: string): Scheme {
  return topic.includes('costmap') ? 'costmap' : 'map';
}

/** Undo deflate. Throws {@link BadState} where it is none, or not of so many cells. */
export async function inflate(bytes: Uint8Array<ArrayBuffer>, count: number): Promise<Int8Array> {
  let cells: Int8Array;
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    cells = new Int8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new BadState('a map whose cells are not deflated');
  }
  if (cells.length !== count) {
    throw new BadState(`a map of ${count} cells that has ${cells.length}`);
  }
  return cells;
}

/** Red, green, blue, alpha of each cell. */
export function coloured(cells: Int8Array, scheme: Scheme): Uint8Array<ArrayBuffer> {
  const palette = paletteOf(scheme);
  const pixels = new Uint32Array(cells.length);
  const octets = new Uint8Array(cells.buffer, cells.byteOffset, cells.length);
  for (let i = 0; i < octets.length; i++) {
    pixels[i] = palette[octets[i]!]!;
  }
  return new Uint8Array(pixels.buffer);
}

/** The colours of the 256 values that a cell can have, -1 at 255. */
function paletteOf(scheme: Scheme): Uint32Array {
  const colours = Array.from({ length: 256 }, (_, octet) => {
    const value = octet < 128 ? octet : octet - 256;
    return scheme === 'map' ? ofMap(value) : ofCostmap(value);
  });
  return new Uint32Array(new Uint8Array(colours.flat()).buffer);
}

function ofMap(value: number): Rgba {
  if (value < 0 || value > OCCUPIED) {
    return ofNoProbability(value, SHARE.map);
  }
  const grey = 255 - Math.round((255 * value) / OCCUPIED);
  return [grey, grey, grey, SHARE.map];
}

function ofCostmap(value: number): Rgba {
  if (value < 0 || value > OCCUPIED) {
    return ofNoProbability(value, SHARE.costmap);
  }
  if (value === 0) {
    return [0, 0, 0, 0];
  }
  if (value >= INSCRIBED) {
    return value === OCCUPIED ? [255, 0, 255, SHARE.costmap] : [0, 255, 255, SHARE.costmap];
  }
  const red = Math.round((255 * value) / OCCUPIED);
  return [red, 0, 255 - red, SHARE.costmap];
}

/** What is none, but for -1: above 100 green, below -1 from red to yellow. */
function ofNoProbability(value: number, alpha: number): Rgba {
  if (value === -1) {
    return UNKNOWN;
  }
  return value > 0 ? [0, 255, 0, alpha] : [255, Math.round((255 * (value + 128)) / 126), 0, alpha];
}
