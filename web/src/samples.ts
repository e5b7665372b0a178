// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The samples of sensors, as protocol.ts defines them, decoded without a copy of what they hold. */
import { HEAD_AT, SAMPLE_KIND, type Head } from './protocol';
import { BadState } from './state';

const FLOAT_BYTES = 4;
const POINT_FLOATS = 3;
/** Bytes of the colour of a point. */
const COLOUR_BYTES = { rgb: 3, intensity: 4, none: 0 } as const;
const TYPES: ReadonlySet<string> = new Set<Head['type']>([
  'scan', 'cloud', 'picture', 'range', 'contacts', 'unreadable',
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

/** Read a sample. Throws {@link BadState} where head or length are not those of one. */
export function decodeSample(buffer: ArrayBuffer): Sample {
  if (buffer.byteLength < HEAD_AT) {
    throw new BadState(`a sample of ${buffer.byteLength} bytes`);
  }
  const size = new DataView(buffer).getUint16(2, true);
  const end = HEAD_AT + size;
  if (size % FLOAT_BYTES !== 0 || end > buffer.byteLength) {
    throw new BadState(`a sample of ${buffer.byteLength} bytes, ${size} of them a head`);
  }
  const head = headOf(new TextDecoder().decode(new Uint8Array(buffer, HEAD_AT, size)));
  const count = Math.floor((buffer.byteLength - end) / FLOAT_BYTES);
  return {
    head,
    floats: new Float32Array(buffer, end, count),
    bytes: new Uint8Array(buffer, end),
  };
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
