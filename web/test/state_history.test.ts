// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { StateHistory } from '../src/scene/history';
import type { State } from '../src/state';

function state(time: number, layout = 1): State {
  const frames = { type: 'layout', id: layout, frames: [], robots: [] } as const;
  return {
    layout: { ...frames, frames: [], robots: [] }, sequence: 0, time,
    poses: new Float32Array(), robots: [],
  };
}

function history(...times: number[]): StateHistory {
  const kept = new StateHistory();
  times.forEach((time) => kept.add(state(time)));
  return kept;
}

test('the state nearest to a stamp is found', () => {
  const kept = history(1, 1.1, 1.2, 1.3);
  const found = [0.9, 1.0, 1.04, 1.06, 1.24, 1.26, 1.3, 5].map((at) => kept.nearest(at)?.time);
  assert.deepEqual(found, [1, 1, 1, 1.1, 1.2, 1.3, 1.3, 1.3]);
  assert.equal(new StateHistory().nearest(1), null);
});

test('a stamp of another clock is one of now', () => {
  const kept = history(1000, 1000.1);
  assert.equal(kept.nearest(3)?.time, 1000.1);
  assert.equal(kept.isSettled(3), false);
});

test('a stamp is settled once a state is as late', () => {
  const kept = history(1, 1.1);
  assert.equal(kept.isSettled(1.05), true);
  assert.equal(kept.isSettled(1.15), false);
  kept.add(state(1.2));
  assert.equal(kept.isSettled(1.15), true);
});

test('it begins anew when time jumps back, and with another layout', () => {
  const kept = history(5, 6, 1);
  assert.equal(kept.length, 1);
  kept.add(state(1.5, 2));
  assert.equal(kept.length, 1);
  assert.equal(kept.nearest(1)?.layout.id, 2);
});

test('its memory is bounded', () => {
  const kept = new StateHistory();
  for (let tick = 0; tick < 2000; tick += 1) {
    kept.add(state(tick / 60));
  }
  assert.ok(kept.length <= 200);
  assert.equal(kept.latest?.time, 1999 / 60);
});
