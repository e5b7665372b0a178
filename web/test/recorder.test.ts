// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { freeName } from '../src/panels/simulation';
import {
  FACTOR_COLUMN, FIRST_WHEEL_COLUMN, Recorder, velocityColumn,
} from '../src/plots/recorder';
import { HEADER_BYTES, type Layout } from '../src/protocol';
import { wheelsOf } from '../src/readings';
import { decodeState, stateBytes, type State } from '../src/state';

const LAYOUT: Layout = {
  type: 'layout',
  id: 3,
  frames: [],
  robots: [{ id: '/', joints: ['arm', 'left', 'right'], wheels: ['left', 'right'] }],
};

/** A state as the node sends it; its floats are 0, 1, 2 … */
function state(time: number): State {
  const buffer = new ArrayBuffer(stateBytes(LAYOUT));
  const header = new DataView(buffer);
  header.setUint8(0, 1);
  header.setUint16(2, LAYOUT.id, true);
  header.setFloat64(8, time, true);
  const floats = new Float32Array(buffer, HEADER_BYTES);
  floats.forEach((_, index) => {
    floats[index] = index;
  });
  const decoded = decodeState(buffer, LAYOUT);
  assert.ok(decoded !== null);
  return decoded;
}

test('each number of a state stands in its column', () => {
  const recorder = new Recorder();
  recorder.record(state(1.5), 0.9);
  const record = recorder.of('/');
  assert.deepEqual(record?.wheels, ['left', 'right']);
  const [times, ...columns] = record.history.since(0).map(([first]) => first);
  assert.equal(times, 1.5);
  // 3 positions, 3 velocities, odometry from 6 on, truth from 15 on, command at 24, wheels.
  assert.equal(columns[velocityColumn(0, 'linear')], 24);
  assert.equal(columns[velocityColumn(1, 'linear')], 6 + 7);
  assert.equal(columns[velocityColumn(1, 'angular')], 6 + 8);
  assert.equal(columns[velocityColumn(2, 'linear')], 15 + 7);
  assert.ok(Math.abs((columns[FACTOR_COLUMN] ?? 0) - 0.9) < 1e-6);
  assert.deepEqual(columns.slice(FIRST_WHEEL_COLUMN), [4, 5]);
});

test('wheels have their joint’s speed, contact, load and slip', () => {
  const [left, right] = wheelsOf(state(0), state(0).robots[0]);
  assert.deepEqual(left, {
    name: 'left', speed: 4, contact: true, force: 27, along: 28, across: 29,
  });
  assert.equal(right.force, 31);
});

test('a robot that went, and time that began anew, leave nothing', () => {
  const recorder = new Recorder();
  recorder.record(state(1), null);
  recorder.keep(['/other']);
  assert.equal(recorder.length, 0);
  recorder.record(state(1), null);
  assert.equal(recorder.length, 1);
  recorder.clear();
  assert.equal(recorder.length, 0);
});

test('a new robot gets a name that is free', () => {
  assert.equal(freeName([]), 'robot1');
  assert.equal(freeName(['amr', 'robot1', 'robot3']), 'robot2');
});
