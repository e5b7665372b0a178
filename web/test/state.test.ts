// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Layout } from '../src/protocol';
import { BadState, decodeState, isKnownPose, stateBytes } from '../src/state';

const LAYOUT: Layout = {
  type: 'layout',
  id: 513,
  frames: [{ name: 'base', parent: 'odom' }, { name: 'wheel', parent: 'base' }],
  robots: [
    { id: '/', joints: ['a', 'b'], wheels: ['a'] },
    { id: '/two', joints: [], wheels: [] },
  ],
};

/** A frame whose n-th number is n, of the layout above or as said. */
function frame({ kind = 1, layout = 513, bytes = stateBytes(LAYOUT) } = {}): ArrayBuffer {
  const buffer = new ArrayBuffer(bytes);
  const view = new DataView(buffer);
  view.setUint8(0, kind);
  view.setUint16(2, layout, true);
  view.setUint32(4, 4_000_000_000, true);
  view.setFloat64(8, 12.25, true);
  for (let i = 0; 16 + 4 * i + 4 <= bytes; i++) {
    view.setFloat32(16 + 4 * i, i, true);
  }
  return buffer;
}

test('every number stands where the protocol has it', () => {
  const state = decodeState(frame(), LAYOUT);
  assert.ok(state);
  assert.equal(state.sequence, 4_000_000_000);
  assert.equal(state.time, 12.25);
  assert.deepEqual([...state.poses], Array.from({ length: 14 }, (_, i) => i));
  const [one, two] = state.robots;
  assert.deepEqual([...one!.positions], [14, 15]);
  assert.deepEqual([...one!.velocities], [16, 17]);
  assert.deepEqual([...one!.commanded], [18, 19]);
  assert.deepEqual([one!.odometry[0], one!.odometry[9]], [20, 29]);
  assert.deepEqual([one!.truth[0], one!.truth[9]], [30, 39]);
  assert.deepEqual([...one!.command], [40, 41, 42]);
  assert.deepEqual([...one!.wheels], [43, 44, 45, 46]);
  assert.equal(two!.id, '/two');
  assert.deepEqual([two!.odometry[0], two!.truth[0], two!.command[1]], [47, 57, 68]);
});

test('the last number is the end of the frame: nothing is left, nothing shared', () => {
  const state = decodeState(frame(), LAYOUT);
  const views = state?.robots.flatMap((robot) => Object.values(robot).filter(isArray)) ?? [];
  const count = views.reduce((sum, view) => sum + view.length, state?.poses.length ?? 0);
  assert.equal(16 + 4 * count, stateBytes(LAYOUT));
  assert.equal(new Set(views.flatMap((view) => [...view])).size, count - 14);
});

test('a state of another layout is dropped, whatever its length', () => {
  assert.equal(decodeState(frame({ layout: 512 }), LAYOUT), null);
  assert.equal(decodeState(frame({ layout: 512, bytes: 16 }), LAYOUT), null);
});

test('a frame that is no state says what it is', () => {
  assert.throws(() => decodeState(new ArrayBuffer(3), LAYOUT), /3 bytes, less than its header/);
  assert.throws(() => decodeState(frame({ kind: 7 }), LAYOUT), /kind 7, not 1/);
  const short = frame({ bytes: stateBytes(LAYOUT) - 4 });
  assert.throws(() => decodeState(short, LAYOUT), BadState);
});

test('a pose is known when all of it is', () => {
  const values = new Float32Array(14).fill(1);
  assert.ok(isKnownPose(values, 7));
  values[13] = NaN;
  assert.ok(!isKnownPose(values, 7));
  assert.ok(isKnownPose(values, 0));
});

function isArray(value: unknown): value is Float32Array {
  return value instanceof Float32Array;
}
