// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clock, degrees, factor, fixed } from '../src/format';

test('numbers have a true minus, and zero has none', () => {
  assert.equal(fixed(1.005, 1), '1.0');
  assert.equal(fixed(-0.5, 2), '−0.50');
  assert.equal(fixed(-0.001, 2), '0.00');
  assert.equal(fixed(-0, 0), '0');
});

test('what is not known is a dash', () => {
  for (const unknown of [Number.NaN, null, undefined, Number.POSITIVE_INFINITY]) {
    assert.equal(fixed(unknown, 2), '–');
  }
  assert.equal(factor(null), '–');
  assert.equal(clock(Number.NaN), '–');
  assert.equal(degrees(Number.NaN), '–');
});

test('angles are read in degrees', () => {
  assert.equal(degrees(-Math.PI / 2), '−90.0°');
});

test('simulated time is minutes and seconds, then hours', () => {
  assert.equal(clock(0), '0:00.0');
  assert.equal(clock(61.29), '1:01.2');
  assert.equal(clock(59.99), '0:59.9');
  assert.equal(clock(3723.4), '1:02:03.4');
  assert.equal(clock(0.3), '0:00.3');
});
