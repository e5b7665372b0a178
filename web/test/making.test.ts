// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { nameOf, parseField, type Field } from '../src/plots/field';
import { make } from '../src/plots/making';

type Sample = [time: number, value: number];

/** What comes out, by the name of a field; `others`: of the other number, which comes afterwards. */
function made(name: string, samples: Sample[], others: Sample[] = []): Sample[] {
  const out: Sample[] = [];
  let takeOther = (_time: number, _value: number): void => {};
  const take = make(parseField(name) as Field, (...sample) => out.push(sample), (_, call) => {
    takeOther = call;
  });
  samples.forEach((sample) => take(...sample));
  others.forEach((sample) => takeOther(...sample));
  return out;
}

test('what is made of a field is written behind it', () => {
  const names = ['/a:x~d', '/a:x~lowpass=0.5~d', '/a:x.y[3]~minus=/b:z'];
  assert.deepEqual(names.map((name) => nameOf(parseField(name) as Field)), names);
  assert.equal(nameOf(parseField(' /a x ~ lowpass 0.5 ~ d ') as Field), '/a:x~lowpass=0.5~d');
  assert.equal(nameOf(parseField('/a x ~ minus /b z') as Field), '/a:x~minus=/b:z');
  for (const text of ['/a:x~', '/a:x~e', '/a:x~d2', '/a:x~lowpass', '/a:x~lowpass=-1', '/a:x~minus', '~d']) {
    assert.equal(parseField(text), null, text);
  }
});

test('a derivative is per second, and none over what is not known or a time that has gone back', () => {
  assert.deepEqual(made('/a:x~d', [[1, 5], [1.5, 6], [1.5, 9], [3.5, 2]]), [[1.5, 2], [3.5, -2]]);
  assert.deepEqual(made('/a:x~d', [[1, 5], [2, NaN], [3, 6], [4, 8]]), [[2, NaN], [3, NaN], [4, 2]]);
  assert.deepEqual(made('/a:x~d', [[10, 5], [1, 1], [2, 3]]), [[2, 2]]);
  assert.deepEqual(made('/a:x~d', [[1, 5], [2, NaN], [2, 6], [3, 8]]), [[2, NaN], [3, 2]], 'messages were lost before 2 s');
});

test('a low pass takes its time for a step, whatever the rate', () => {
  const coarse = made('/a:x~lowpass=0.5', [[0, 0], [0.01, 1], [0.51, 1]]).at(-1)!;
  const fine: Sample[] = Array.from({ length: 51 }, (_, index): Sample => [0.01 + index / 100, 1]);
  const [time, value] = made('/a:x~lowpass=0.5', [[0, 0], ...fine]).at(-1)!;
  assert.ok(Math.abs(time - 0.51) < 1e-9);
  assert.ok(Math.abs(value - coarse[1]) < 1e-9, `${value} is ${coarse[1]}`);
  assert.ok(Math.abs(value - (1 - Math.exp(-0.51 / 0.5))) < 1e-9);
  assert.deepEqual(made('/a:x~lowpass=1', [[0, 4], [1, NaN], [2, 7]]), [[0, 4], [1, NaN], [2, 7]]);
});

test('a difference is to the other number at the same time, between two of its own', () => {
  const others: Sample[] = [[1, 10], [3, 30]];
  assert.deepEqual(made('/a:x~minus=/b:y', [[0, 1], [1, 1], [2, 1], [3, 1], [4, 1]], others), [
    [1, -9], [2, -19], [3, -29],
  ]);
  assert.deepEqual(made('/a:x~minus=/b:y~d', [[1, 1], [2, 3]], others), [[2, -8]]);
  const long = Array.from({ length: 70_000 }, (_, index): Sample => [index, index]);
  const last = made('/a:x~minus=/b:y', long, long);
  assert.ok(last.length === 1 << 16 && last.every(([, value]) => value === 0), 'the newest wait');
  assert.deepEqual(made('/a:x~minus=/b:y', [[9, 1], [1, 1]], [[0, 1], [2, 3]]), [[1, -1]], 'time began anew');
});
