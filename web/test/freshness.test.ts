// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import test from 'node:test';
import { ageText, Freshness } from '../src/freshness';
import type { Ages } from '../src/protocol';

function ages(clock: number | null, odometry: number | null): Ages {
  return {
    type: 'ages',
    clock,
    tf: null,
    robots: [{ robot: '/', command: null, odometry, truth: null, joint_states: null }],
  };
}

/** What is told four times a second, while time stands at these ages from `begin` on. */
function tell(freshness: Freshness, count: number, of: (index: number) => Ages, begin = 0): void {
  for (let index = 0; index < count; index += 1) {
    freshness.take(of(index), begin + 0.25 * index);
  }
}

test('nothing is stale before anything was told', () => {
  const freshness = new Freshness();
  assert.equal(freshness.stalenessOfAll(100), null);
  assert.equal(freshness.staleness('/', 'odometry', 100), null);
});

test('what is told four times a second is fresh, and says how old it is after half a second', () => {
  const freshness = new Freshness();
  tell(freshness, 4, () => ages(0.01, 0.02));
  assert.equal(freshness.stalenessOfAll(0.75 + 0.4), null);
  assert.ok((freshness.stalenessOfAll(0.75 + 0.55) ?? 0) > 0.5);
  assert.ok(Math.abs((freshness.stalenessOfAll(0.75 + 7) ?? 0) - 7) < 1e-9);
});

test('a clock that stands is stale while the node goes on to tell of it', () => {
  const freshness = new Freshness();
  tell(freshness, 30, (index) => ages(0.25 * index, 0.25 * index));
  assert.ok(Math.abs((freshness.stalenessOfAll(7.3) ?? 0) - 7.25) < 0.3);
  assert.ok(Math.abs((freshness.staleness('/', 'odometry', 7.3) ?? 0) - 7.25) < 0.3);
  freshness.take(ages(0.01, 0.01), 7.5); // it goes on
  assert.equal(freshness.stalenessOfAll(7.6), null);
});

test('of two silences the longer one is said', () => {
  const freshness = new Freshness();
  tell(freshness, 30, (index) => ages(0.25 * index, 0.25 * index));
  const told = freshness.stalenessOfAll(7.25 + 2) ?? 0; // the node has been silent for 2 s of them
  assert.ok(Math.abs(told - 9.25) < 0.5, String(told));
});

test('a robot without a simulator has no clock to be stale', () => {
  const freshness = new Freshness();
  tell(freshness, 4, () => ages(null, 5));
  assert.equal(freshness.stalenessOfAll(1), null);
  assert.equal(freshness.staleness('/', 'odometry', 1), 5);
  assert.equal(freshness.staleness('/', 'truth', 1), null);
  assert.equal(freshness.staleness('/other', 'odometry', 1), null);
});

test('a topic of 1 Hz is not stale between two messages, but after one and a half', () => {
  const freshness = new Freshness();
  const saw = (index: number): Ages => ages(null, 0.05 + 0.25 * (index % 4));
  tell(freshness, 12, saw);
  assert.equal(freshness.staleness('/', 'odometry', 2.8), null);
  tell(freshness, 8, (index) => ages(null, 0.05 + 0.25 * index), 3);
  assert.ok((freshness.staleness('/', 'odometry', 4.8) ?? 0) > 1.5);
});

test('a new connection knows nothing of the last one', () => {
  const freshness = new Freshness();
  tell(freshness, 4, () => ages(9, 9));
  freshness.take(null, 1);
  assert.equal(freshness.stalenessOfAll(50), null);
});

test('ages are said in seconds, and in minutes when they are long', () => {
  assert.deepEqual([0.6, 3.4, 61, 180].map(ageText), ['1 s', '3 s', '61 s', '3 min']);
});
