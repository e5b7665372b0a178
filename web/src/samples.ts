// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Samples of topics, as protocol.ts defines them, decoded without a copy of what they hold. */
import { HEAD_AT, SAMPLE_KIND, type Channel, type Head, type MarkBatch, type Marks, type Values } from './protocol';
import { BadState } from './state';

const FLOAT_BYTES = 4;
const DOUBLE_BYTES = 8;
const POINT_FLOATS = 3;
/** Bytes of the colour of a point. */
const COLOUR_BYTES = { rgb: 3, intensity: 4, none: 0 } as const;
const TYPES: ReadonlySet<string> = new Set<Head['type']>([
  'scan', 'cloud', 'picture', 'range', 'contacts', 'map', 'path', 'marks', 'message', 'values', 'unreadable',
]);

/** A sample: its head, and what follows it, whole and as numbers. */
export interface Sample<H extends Head = Head> {
  head: H;
  floats: Float32Array; // as many as are whole
  bytes: Uint8Array<ArrayBuffer>;
}

/** Whether a binary frame is a sample, and no state. */
export function isSample(buffer: ArrayBuffer): boolean {
  return buffer.byteLength > 0 && new Uint8Array(buffer, 0, 1)[0] === SAMPLE_KIND;
}

/** Read the head of a sample, and where it ends, byte. Throws {@link BadState} where it is none. */
export function decodeHead(buffer: ArrayBuffer): { head: Head; end: number } {
  if (buffer.byteLength < HEAD_AT) {
    throw new BadState(`a sample of ${buffer.byteLength} bytes`);
  }
  const size = new DataView(buffer).getUint16(2, true);
  const end = HEAD_AT + size;
  if (size % FLOAT_BYTES !== 0 || end > buffer.byteLength) {
    throw new BadState(`a sample of ${buffer.byteLength} bytes, ${size} of them a head`);
  }
  return { head: headOf(new TextDecoder().decode(new Uint8Array(buffer, HEAD_AT, size))), end };
}

/** Read a sample. Throws {@link BadState} where head or length are not those of one. */
export function decodeSample(buffer: ArrayBuffer): Sample {
  const { head, end } = decodeHead(buffer);
  const count = Math.floor((buffer.byteLength - end) / FLOAT_BYTES);
  return {
    head,
    floats: new Float32Array(buffer, end, count),
    bytes: new Uint8Array(buffer, end),
  };
}

/** How a sample came, see Watch. */
export function channelOf(head: Head): Channel {
  switch (head.type) {
    case 'message':
    case 'values':
      return head.type;
    case 'unreadable':
      return head.channel;
    default:
      return 'sensor';
  }
}

/** Positions (x, y, z of each, m) and colours of a cloud. */
export function pointsOf({ head, floats, bytes }: Sample): {
  count: number;
  positions: Float32Array;
  rgb: Uint8Array | null;
  intensities: Float32Array | null;
} {
  const colouring = head.type === 'cloud' ? head.colouring : 'none';
  const size = FLOAT_BYTES * POINT_FLOATS;
  const count = Math.floor(bytes.length / (size + COLOUR_BYTES[colouring]));
  const positions = floats.subarray(0, POINT_FLOATS * count);
  const rgb = bytes.subarray(size * count, (size + COLOUR_BYTES.rgb) * count);
  const intensities = floats.subarray(POINT_FLOATS * count, (POINT_FLOATS + 1) * count);
  return {
    count,
    positions,
    rgb: colouring === 'rgb' ? rgb : null,
    intensities: colouring === 'intensity' ? intensities : null,
  };
}

/** Numbers of a shape or a mesh, and of each line, point and corner. */
const MARK_FLOATS = 13;
const FLOATS_OF: Partial<Record<MarkBatch['kind'], number>> = { lines: 12, points: 6, triangles: 6 };

/** The batches of marks, and the numbers of each. Throws {@link BadState}: there are not as many. */
export function batchesOf({ head, floats }: Sample<Marks>): [MarkBatch, Float32Array][] {
  let at = 0;
  const batches = head.batches.map((batch): [MarkBatch, Float32Array] => {
    const begin = at;
    at += batch.count * (FLOATS_OF[batch.kind] ?? MARK_FLOATS);
    return [batch, floats.subarray(begin, at)];
  });
  if (at !== floats.length) {
    throw new BadState(`${floats.length} numbers of marks, of which ${at} are told`);
  }
  return batches;
}

/** A message as the node writes it; see AnyMessage for the objects whose keys begin with #. */
export type Tree = number | string | boolean | readonly Tree[] | { readonly [name: string]: Tree };

/** The message of a sample. Throws {@link BadState}: it is none. */
export function messageOf({ bytes }: Sample): Tree {
  try {
    return JSON.parse(new TextDecoder().decode(bytes)) as Tree;
  } catch {
    throw new BadState('a message that is no JSON');
  }
}

/** Stamps (s), and the values of each path. Throws {@link BadState}: there are not as many. */
export function valuesOf({ head, bytes }: Sample<Values>): {
  stamps: Float64Array;
  columns: ReadonlyMap<string, Float64Array>;
} {
  const { count, paths } = head;
  if (bytes.length !== DOUBLE_BYTES * count * (1 + paths.length)) {
    throw new BadState(`${bytes.length} bytes for ${count} times ${paths.length} values`);
  }
  const column = (index: number): Float64Array =>
    new Float64Array(bytes.buffer, bytes.byteOffset + DOUBLE_BYTES * count * index, count);
  const columns = new Map(paths.map((path, index) => [path, column(1 + index)]));
  return { stamps: column(0), columns };
}

function headOf(text: string): Head {
  let head: Partial<Head> | null;
  try {
    head = JSON.parse(text) as Partial<Head> | null;
  } catch {
    throw new BadState('a sample whose head is no JSON');
  }
  if (typeof head?.origin?.topic !== 'string' || !TYPES.has(head.type ?? '')) {
    throw new BadState(`a sample of type ${String(head?.type)}`);
  }
  return head as Head;
}
