// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Color } from 'three';
import type { Cloud, Head, Scan } from '../src/protocol';
import { decodeSample, isSample, pointsOf, type Sample } from '../src/samples';
import { DynamicPoints } from '../src/scene/points';
import { fillScan } from '../src/scene/sensors';
import { measured, timing } from '../src/sensors/words';
import { BadState } from '../src/state';

const ORIGIN = { topic: '/scan', frame: 'laser', stamp: 9.5, rate: 10 };
const SCAN: Scan = {
  type: 'scan', origin: ORIGIN, angle_min: 0, angle_increment: Math.PI / 2, range_min: 0.5,
  range_max: 8, count: 6,
};

/** A frame as the node makes it. */
function frame(head: unknown, after: Uint8Array): ArrayBuffer {
  let text = JSON.stringify(head);
  text = text.padEnd(4 * Math.ceil(text.length / 4));
  const bytes = new Uint8Array(4 + text.length + after.length);
  bytes[0] = 2;
  new DataView(bytes.buffer).setUint16(2, text.length, true);
  bytes.set(new TextEncoder().encode(text), 4);
  bytes.set(after, 4 + text.length);
  return bytes.buffer;
}

function sample(head: Head, ...numbers: number[]): Sample {
  return decodeSample(frame(head, new Uint8Array(new Float32Array(numbers).buffer)));
}

test('a sample is told from a state', () => {
  assert.equal(isSample(frame(SCAN, new Uint8Array())), true);
  assert.equal(isSample(new Uint8Array([1, 0, 0, 0]).buffer), false);
  assert.equal(isSample(new ArrayBuffer(0)), false);
});

test('head and numbers are those that were sent', () => {
  const { head, floats } = sample(SCAN, 1, Infinity, 2);
  assert.deepEqual(head, SCAN);
  assert.deepEqual([...floats], [1, Infinity, 2]);
});

test('what is no sample is refused, whatever it is', () => {
  const good = new Uint8Array(frame(SCAN, new Uint8Array(8)));
  for (let length = 0; length < good.length - 8; length += 1) {
    assert.throws(() => decodeSample(good.slice(0, length).buffer), BadState);
  }
  for (const head of [null, 3, {}, { type: 'scan' }, { type: 'sky', origin: ORIGIN }]) {
    assert.throws(() => decodeSample(frame(head, new Uint8Array())), BadState);
  }
});

test('a cloud has as many points as its bytes hold', () => {
  const head: Cloud = {
    type: 'cloud', origin: ORIGIN, count: 99, colouring: 'rgb', low: null, high: null,
  };
  const bytes = new Uint8Array(2 * 15 + 7);
  new Float32Array(bytes.buffer, 0, 6).set([1, 2, 3, 4, 5, 6]);
  bytes.set([10, 20, 30, 40, 50, 60], 24);
  const found = pointsOf(decodeSample(frame(head, bytes)));
  assert.equal(found.count, 2);
  assert.deepEqual([...found.positions], [1, 2, 3, 4, 5, 6]);
  assert.deepEqual([...(found.rgb ?? [])], [10, 20, 30, 40, 50, 60]);
  const lit = pointsOf(sample({ ...head, colouring: 'intensity' }, 1, 2, 3, 4, 5, 6, 7, 8));
  assert.deepEqual([lit.count, ...(lit.intensities ?? [])], [2, 7, 8]);
});

test('rays that hit something within the bounds are points, and no others', () => {
  const points = new DynamicPoints(1);
  const ranges = sample(SCAN, 1, Infinity, 2, NaN, 0.25, 9, -Infinity, 4) as Sample<Scan>;
  assert.equal(fillScan(points, ranges, new Color()), 3);
  const found = [...points.positions.subarray(0, 9)].map((each) => Math.round(each * 1e5) / 1e5);
  assert.deepEqual(found.map((each) => each + 0), [1, 0, 0, -2, 0, 0, 0, -4, 0]);
});

test('a scan without bounds, or of no ray at all, is drawn', () => {
  const points = new DynamicPoints(1);
  const open = { ...SCAN, range_min: null, range_max: null };
  assert.equal(fillScan(points, sample(open, 0, 1e9) as Sample<Scan>, new Color()), 2);
  assert.equal(fillScan(points, sample(open) as Sample<Scan>, new Color()), 0);
});

test('a sample says how often it comes, how old it is, and what was measured', () => {
  const scan = sample(SCAN, 0.25, 3, Infinity, NaN);
  assert.equal(timing(scan, 9.75), '10 Hz · 0.25 s old');
  assert.equal(timing(scan, 1e9), '10 Hz'); // of another clock
  assert.equal(measured(scan, 10), '4 of 6 rays · nearest 3.00 m');
  assert.equal(measured(sample(SCAN, Infinity), 10), '1 of 6 rays · nothing in range');
  const range = {
    type: 'range', origin: ORIGIN, field_of_view: 0.1, min_range: 0, max_range: 4,
  } as const;
  assert.deepEqual(
    [1.5, Infinity, -Infinity, NaN].map((each) => measured(sample(range, each), 10)),
    ['1.500 m', 'nothing in range', 'too near', '– m'],
  );
});

test('a contact is one while it is published', () => {
  const contacts = [{ first: 'bumper', second: 'wall', points: 1, force: 12.34 }];
  const touching = sample({ type: 'contacts', origin: ORIGIN, contacts });
  assert.equal(measured(touching, 9.6), 'bumper touches wall (12.3 N)');
  assert.equal(measured(touching, 10.1), 'touches nothing');
});
