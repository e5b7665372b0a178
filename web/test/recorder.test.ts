// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { freeName } from '../src/format';
import {
  FACTOR_COLUMN, Recorder, velocityColumn, wheelColumn,
} from '../src/plots/recorder';
import type { Record } from '../src/plots/recorder';
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
function state(time: number, layout = LAYOUT): State {
  const buffer = new ArrayBuffer(stateBytes(layout));
  const header = new DataView(buffer);
  header.setUint8(0, 1);
  header.setUint16(2, LAYOUT.id, true);
  header.setFloat64(8, time, true);
  const floats = new Float32Array(buffer, HEADER_BYTES);
  floats.forEach((_, index) => {
    floats[index] = index;
  });
  const decoded = decodeState(buffer, layout);
  assert.ok(decoded !== null);
  return decoded;
}

function firstSample({ history }: Record): number[] {
  return Array.from({ length: history.columns }, (_, column) => history.at(history.latest, column));
}

test('each number of a state stands in its column', () => {
  const recorder = new Recorder(() => []);
  recorder.record(state(1.5), 0.9);
  const record = recorder.of('/');
  assert.deepEqual(record?.wheels, ['left', 'right']);
  assert.equal(record.history.latest, 1.5);
  const columns = firstSample(record);
  // 3 positions, velocities and commanded ones, odometry from 9 on, truth from 19 on, command at 29.
  assert.equal(columns[velocityColumn(0, 'linear')], 29);
  assert.equal(columns[velocityColumn(1, 'linear')], 9 + 7);
  assert.equal(columns[velocityColumn(1, 'angular')], 9 + 8);
  assert.equal(columns[velocityColumn(2, 'linear')], 19 + 7);
  assert.ok(Math.abs((columns[FACTOR_COLUMN] ?? 0) - 0.9) < 1e-6);
  assert.deepEqual(columns.slice(wheelColumn(0, 'measured')), [4, 7, 5, 8]);
  assert.equal(wheelColumn(1, 'commanded'), columns.length - 1);
});

test('wheels have their joint’s speed, contact, load and slip', () => {
  const [left, right] = wheelsOf(state(0), state(0).robots[0]!);
  assert.deepEqual(left, {
    name: 'left', speed: 4, contact: true, force: 33, along: 34, across: 35,
  });
  assert.equal(right!.force, 37);
});

test('where no simulator names wheels, what turns without end is taken for one', () => {
  const layout = { ...LAYOUT, robots: [{ ...LAYOUT.robots[0]!, wheels: [] }] };
  const recorder = new Recorder((robot) => (robot === '/' ? ['right', 'gone'] : []));
  recorder.record(state(0, layout), null);
  const record = recorder.of('/');
  assert.deepEqual(record?.wheels, ['right', 'gone']);
  const columns = firstSample(record);
  assert.deepEqual(columns.slice(wheelColumn(0, 'measured')), [5, 8, Number.NaN, Number.NaN]);
});

test('a robot that went, and time that began anew, leave nothing', () => {
  const recorder = new Recorder(() => []);
  recorder.record(state(1), null);
  recorder.keep(['/other']);
  assert.equal(recorder.length, 0);
  recorder.record(state(1), null);
  assert.equal(recorder.length, 1);
  recorder.clear();
  assert.equal(recorder.length, 0);
});

test('the first second of a simulation has no real-time factor: starting is no fault', () => {
  const recorder = new Recorder(() => []);
  recorder.record(state(0.5), 0.1);
  const factor = () => recorder.series('/', { column: FACTOR_COLUMN });
  assert.ok(Number.isNaN(factor()?.at(0.5)));
  recorder.record(state(1.2), 1);
  assert.equal(factor()?.at(1.2), 1);
});

test('fields are kept while they are plotted, and what is held stays as it was', () => {
  const recorder = new Recorder(() => []);
  const field = { topic: '/odom', path: 'twist.twist.linear.x' };
  recorder.take(field, 1, 0.5);
  const held = recorder.hold('/');
  recorder.take(field, 2, 0.6);
  assert.equal(held.series('/', field)?.latest, 1);
  assert.equal(recorder.series('/', field)?.at(2), 0.6);
  recorder.interrupt();
  assert.ok(Number.isNaN(recorder.series('/', field)?.at(3)), 'what comes next is no continuation');
  recorder.keepFields([]);
  assert.equal(recorder.series('/', field), null);
});

test('a new robot gets a name that is free', () => {
  assert.equal(freeName([]), 'robot1');
  assert.equal(freeName(['amr', 'robot1', 'robot3']), 'robot2');
  assert.equal(freeName(['amr'], 'arm'), 'arm');
  assert.equal(freeName(['arm', 'arm1'], 'arm'), 'arm2');
});
