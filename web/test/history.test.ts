// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { toCsv } from '../src/plots/csv';
import { History } from '../src/plots/history';
import { Track } from '../src/plots/series';
import { values } from './values';

test('what goes in comes out, in order', () => {
  const history = new History(2, 10, 100);
  history.push(1, [10, 0.5]);
  history.push(2, [20, Number.NaN]);
  assert.deepEqual(values(history.column(0)), [[1, 10], [2, 20]]);
  assert.deepEqual(values(history.column(1)), [[1, 0.5], [2, Number.NaN]]);
  assert.equal(history.latest, 2);
});

test('what is asked for comes out, with the one before and the one behind', () => {
  const history = new History(1, 10, 100);
  for (let time = 0; time < 9; time += 1) {
    history.push(time, [time]);
  }
  const times = (from: number, to: number) => values(history.column(0), from, to).map(([time]) => time);
  assert.deepEqual(times(6.5, 7.5), [6, 7, 8]);
  assert.deepEqual(times(6, 6), [6, 7]);
  assert.deepEqual(times(100, 200), [8]);
  assert.equal(history.at(6.9, 0), 6);
  assert.ok(Number.isNaN(history.at(-1, 0)));
});

test('eight hours of samples take the memory of five minutes, the latest five', () => {
  const history = new History(1, 300, 1800);
  for (let time = 0; time < 8 * 3600; time += 0.25) {
    history.push(time, [time]);
  }
  assert.ok(history.length <= 1800);
  const times = values(history.column(0)).map(([time]) => time);
  assert.equal(times.at(-1), 8 * 3600 - 0.25);
  assert.ok(times[0]! <= 8 * 3600 - 300, `reaches back to ${times[0]}`);
});

test('samples that come faster than there is room are thinned out, evenly', () => {
  const history = new History(1, 10, 100);
  for (let step = 0; step < 5000; step += 1) {
    history.push(step / 200, [0]);
  }
  const times = values(history.column(0)).map(([time]) => time);
  assert.ok(times.at(-1)! - times[0]! >= 9.8, `${times[0]} to ${times.at(-1)}`);
});

test('time that stands still adds nothing, time that goes back begins anew', () => {
  const history = new History(1, 10, 100);
  history.push(5, [1]);
  history.push(5, [2]);
  assert.deepEqual(values(history.column(0)), [[5, 1]]);
  history.push(0, [3]);
  assert.deepEqual(values(history.column(0)), [[0, 3]]);
});

test('a cleared history is empty', () => {
  const history = new History(1, 10, 100);
  history.push(5, [1]);
  history.clear();
  assert.deepEqual(values(history.column(0)), []);
  assert.ok(Number.isNaN(history.latest));
});

test('a copy stays as it was', () => {
  const history = new History(1, 10, 100);
  history.push(5, [1]);
  const copy = history.copy();
  history.push(6, [2]);
  assert.deepEqual(values(copy.column(0)), [[5, 1]]);
});

test('series are written as comma-separated values, a line a time', () => {
  const [one, other] = [new Track(), new Track()];
  one.push(0.1 + 0.2, 1);
  one.push(2, Number.NaN);
  one.push(3, 7);
  other.push(2, Math.fround(-2.1));
  const columns = [{ name: 'wheel "a", left', series: one }, { name: '/b:x', series: other }];
  assert.equal(
    toCsv(columns, 0, 2.5),
    'time_s,"wheel ""a"", left",/b:x\r\n0.3,1,\r\n2,,-2.1\r\n',
  );
});
