// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { align } from '../src/plots/align';
import { valueLabels, withinAxis } from '../src/plots/axis_labels';
import { SPAN, Track } from '../src/plots/series';
import { values } from './values';

test('a field comes out as it came, what is unknown too', () => {
  const track = new Track();
  track.push(1, 10);
  track.push(2, Number.NaN);
  track.push(3, 30);
  assert.deepEqual(values(track), [[1, 10], [2, Number.NaN], [3, 30]]);
  assert.deepEqual([track.at(0.5), track.at(1.5), track.at(2.5), track.at(9)], [Number.NaN, 10, Number.NaN, 30]);
  assert.deepEqual([track.first, track.latest], [1, 3]);
});

test('publishers in disorder are kept in order; time that goes back begins anew', () => {
  const track = new Track();
  track.push(5, 1);
  track.push(4.9, 2);
  assert.deepEqual(values(track), [[5, 1], [5, 2]]);
  track.push(0, 3);
  assert.deepEqual(values(track), [[0, 3]]);
});

test('ten minutes at 1 kHz: bounded, five minutes back, with every peak, cheap to read', () => {
  const track = new Track();
  const end = 600;
  for (let step = 0; step <= end * 1000; step += 1) {
    const time = step / 1000;
    track.push(time, step === 350_123 ? 99 : step === 480_777 ? -99 : Math.sin(time));
  }
  assert.ok(track.length <= 1 << 16);
  assert.ok(track.first <= end - SPAN + 0.1, `reaches back to ${track.first}`);
  const all = values(track, end - SPAN, end, SPAN / 1000);
  assert.ok(all.length < 12_000, `${all.length} values for 1000 pixels`);
  assert.ok(all.some(([time, value]) => value === 99 && Math.abs(time - 350.123) < 1e-9));
  assert.ok(all.some(([, value]) => value === -99));
  const times = all.map(([time]) => time);
  assert.ok(times.every((time, index) => index === 0 || time >= times[index - 1]!), 'in order');
  assert.ok(values(track, end - 2, end, 0.002).length >= 2000, 'the latest one by one');
  const old = values(track, 400, 401, 0.001); // no more kept one by one
  assert.ok(old.length >= 20, `${old.length} values of a second long ago`);
});

test('memory is that of five minutes after the first seconds, and follows a rate that rises', () => {
  const track = new Track();
  const go = (from: number, to: number, rate: number) => {
    for (let step = from * rate; step < to * rate; step += 1) {
      track.push(step / rate, step);
    }
    return track.room;
  };
  const first = go(0, 12, 100);
  assert.ok(first < 1.5 * (SPAN * 100 + (2 * SPAN) / (SPAN / 4096)), `room for ${first}`);
  assert.equal(go(12, 900, 100), first);
  assert.ok(track.first <= 900 - SPAN, `reaches back to ${track.first}`);
  assert.ok(go(900, 1300, 200) > first);
  const one = values(track, 1300 - SPAN + 1, 1300, 0);
  assert.ok(one.length > 199 * (SPAN - 1), `${one.length} values, each one`);
});

test('values beside a chart are multiples of the step, as short as can be', () => {
  assert.deepEqual(valueLabels([-0.25, 1e-18, 0.1 + 0.2], 0.05), ['−0.25', '0', '0.3']);
  assert.deepEqual(valueLabels([-2e-7, 0, 4e-7], 2e-7), ['−2e-7', '0', '4e-7']);
  assert.deepEqual(valueLabels([0, 2.5e8, 5e8], 2.5e8), ['0', '2.5e+8', '5e+8']);
  assert.deepEqual(valueLabels([1000, 1500], 500), ['1000', '1500']);
});

test('unknown values at any rate stay few', () => {
  const track = new Track();
  for (let step = 0; step < 400_000; step += 1) {
    track.push(step / 1000, Number.NaN);
  }
  assert.ok(values(track, 100, 300, 1).length < 9000);
  assert.ok(Number.isNaN(track.at(200)));
});

function trackOf(...samples: [number, number][]): Track {
  const made = new Track();
  for (const [time, value] of samples) {
    made.push(time, value);
  }
  return made;
}

test('series of different rates share the times of a chart', () => {
  const slow = trackOf([0, 1], [1, 2]);
  const fast = trackOf([0.1, 5], [0.11, 9], [0.12, 7], [0.6, 3]);
  const { data, spreads } = align([slow, fast, null], 0, 1, 2);
  assert.deepEqual(data[0], [0.125, 0.375, 0.625, 0.875, 1.125, 1.375]);
  assert.deepEqual(data[1], [1, undefined, undefined, undefined, 2, undefined]);
  assert.deepEqual(data[2], [5, 9, 3, undefined, undefined, undefined]);
  assert.deepEqual(data[3], new Array(6).fill(undefined));
  assert.deepEqual(spreads, [1, 6, -Infinity]);
});

test('lines go to the edges: what was before and what comes behind is there', () => {
  const { data } = align([trackOf([0, 1], [9, 2]), trackOf([1, 7], [1.5, 8])], 4, 6, 2);
  assert.deepEqual(data[0], [0, 1.5, 4.25, 4.75, 5.25, 5.75, 6.25, 6.75, 9]);
  assert.deepEqual(data[1]!.slice(0, 2), [1, undefined]);
  assert.equal(data[1]!.at(-1), 2);
  assert.deepEqual(data[2]!.slice(0, 2), [undefined, 8]);
});

test('what is not known draws a gap, which a command has that has expired', () => {
  const one = trackOf([0, 1], [1, Number.NaN], [2, Number.NaN], [3, 4]);
  const [, y] = align([one], 0, 4, 4).data;
  assert.deepEqual(y, [1, undefined, null, null, null, null, 4, undefined, undefined, undefined]);
  const quick = trackOf([0, 1], [0.1, Number.NaN], [0.2, 3]);
  assert.deepEqual(align([quick], 0, 1, 1).data[1]!.slice(0, 2), [1, 3], 'none within one pixel');
});

test('what moves on by a step is otherwise the same picture', () => {
  const wave = new Track();
  for (let step = 0; step < 1000; step += 1) {
    wave.push(step / 100 + 0.003, Math.sin(step));
  }
  const inside = (from: number) => {
    const { data } = align([wave], from, from + 4, 40);
    const times = [...data[0]].map((time) => time.toFixed(3));
    return ['3.025', '3.075', '4.025'].map((time) => data[1]![times.indexOf(time)]);
  };
  assert.deepEqual(inside(2), inside(2.1));
  assert.deepEqual(inside(2), inside(2.137));
});

test('a time that would run into the values beside it is left out', () => {
  assert.deepEqual(withinAxis(['13:59:10', '13:59:20', '270 s'], [10, 27, 10], 6), ['', '13:59:20', '']);
});
