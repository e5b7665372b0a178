// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { toCsv } from '../src/plots/csv';
import { History } from '../src/plots/history';

test('what goes in comes out, in order', () => {
  const history = new History(2, 10, 100);
  history.push(1, [10, 0.5]);
  history.push(2, [20, Number.NaN]);
  assert.deepEqual(history.since(0), [[1, 2], [10, 20], [0.5, null]]);
  assert.equal(history.latest, 2);
});

test('only what is asked for comes out', () => {
  const history = new History(1, 10, 100);
  for (let time = 0; time < 9; time += 1) {
    history.push(time, [time]);
  }
  assert.deepEqual(history.since(6.5)[0], [7, 8]);
  assert.deepEqual(history.since(6)[0], [6, 7, 8]);
  assert.deepEqual(history.since(100)[0], []);
});

test('eight hours of samples take the memory of five minutes, the latest five', () => {
  const history = new History(1, 300, 1800);
  for (let time = 0; time < 8 * 3600; time += 0.25) {
    history.push(time, [time]);
  }
  assert.ok(history.length <= 1800);
  const [times] = history.since(-Infinity);
  assert.equal(times.at(-1), 8 * 3600 - 0.25);
  assert.ok(times[0] <= 8 * 3600 - 300, `reaches back to ${times[0]}`);
});

test('samples that come faster than there is room are thinned out, evenly', () => {
  const history = new History(1, 10, 100);
  for (let step = 0; step < 5000; step += 1) {
    history.push(step / 200, [0]);
  }
  const [times] = history.since(-Infinity);
  assert.ok(times.at(-1)! - times[0] >= 9.8, `${times[0]} to ${times.at(-1)}`);
});

test('time that stands still adds nothing, time that goes back begins anew', () => {
  const history = new History(1, 10, 100);
  history.push(5, [1]);
  history.push(5, [2]);
  assert.deepEqual(history.since(0), [[5], [1]]);
  history.push(0, [3]);
  assert.deepEqual(history.since(0), [[0], [3]]);
});

test('a cleared history is empty', () => {
  const history = new History(1, 10, 100);
  history.push(5, [1]);
  history.clear();
  assert.deepEqual(history.since(0), [[], []]);
  assert.ok(Number.isNaN(history.latest));
});

test('a table is written as comma-separated values', () => {
  const csv = toCsv(['time s', 'wheel "a", left'], [[0.1 + 0.2, 1], [null, -2.5]]);
  assert.equal(csv, 'time s,"wheel ""a"", left"\r\n0.3,\r\n1,-2.5\r\n');
});
