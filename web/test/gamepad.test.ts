// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { demandOf, wantsStop, type Pad } from '../src/drive/gamepad';

function pad(axes: number[], pressed: number[] = []): Pad {
  const buttons = Array.from({ length: 4 }, (_, index) => ({ pressed: pressed.includes(index) }));
  return { axes, buttons };
}

test('the left stick drives, the right one turns', () => {
  assert.deepEqual(demandOf(pad([0, -1, 0, 0]), false), { forward: 1, turn: 0 });
  assert.deepEqual(demandOf(pad([-1, 0, 0, 0]), false), { forward: 0, turn: 1 });
  assert.deepEqual(demandOf(pad([0, 0, 1, 0]), false), { forward: 0, turn: -1 });
});

test('both sticks together turn no more than the limit', () => {
  assert.deepEqual(demandOf(pad([-1, 0, -1, 0]), false), { forward: 0, turn: 1 });
});

test('a robot that goes sideways does so by the left stick', () => {
  assert.deepEqual(demandOf(pad([-1, 0, 0, 0]), true), { forward: 0, turn: 0, left: 1 });
  assert.deepEqual(demandOf(pad([0, 0, -1, 0]), true), { forward: 0, turn: 1 });
  assert.equal(demandOf(pad([0, 0, 0, 0]), true), null);
});

test('a worn stick at rest is no hand', () => {
  assert.equal(demandOf(pad([0.08, -0.06, 0.1, 0.5]), false), null);
  assert.equal(demandOf(pad([]), false), null);
});

test('B stops', () => {
  assert.equal(wantsStop(pad([0, 0], [1])), true);
  assert.equal(wantsStop(pad([0, 0], [0])), false);
  assert.equal(wantsStop({ axes: [], buttons: [] }), false);
});
