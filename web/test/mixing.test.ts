// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fromKeys, fromStick, isDriveKey, mix, STILL, toVelocity } from '../src/drive/mixing';

test('W drives ahead, A turns left, S and D the other way', () => {
  assert.deepEqual(fromKeys(['KeyW']), { forward: 1, turn: 0 });
  assert.deepEqual(fromKeys(['KeyA']), { forward: 0, turn: 1 });
  assert.deepEqual(fromKeys(['KeyS']), { forward: -1, turn: 0 });
  assert.deepEqual(fromKeys(['KeyD']), { forward: 0, turn: -1 });
});

test('arrows are the same as letters, and both at once are no faster', () => {
  for (const [arrow, letter] of [
    ['ArrowUp', 'KeyW'],
    ['ArrowDown', 'KeyS'],
    ['ArrowLeft', 'KeyA'],
    ['ArrowRight', 'KeyD'],
  ] as const) {
    assert.deepEqual(fromKeys([arrow]), fromKeys([letter]));
    assert.deepEqual(fromKeys([arrow, letter]), fromKeys([letter]));
  }
});

test('opposite keys cancel', () => {
  assert.deepEqual(fromKeys(['KeyW', 'KeyS']), STILL);
  assert.deepEqual(fromKeys(['KeyW', 'KeyA', 'KeyD']), { forward: 1, turn: 0 });
});

test('other keys do not drive', () => {
  assert.equal(isDriveKey('KeyQ', false), false);
  assert.equal(isDriveKey('KeyW', false), true);
  assert.deepEqual(fromKeys(['KeyX', 'Tab']), STILL);
});

test('Q and E go sideways, where wheels can', () => {
  assert.equal(isDriveKey('KeyQ', true), true);
  assert.deepEqual(fromKeys(['KeyQ', 'KeyW']), { forward: 1, turn: 0, left: 1 });
  assert.deepEqual(fromKeys(['KeyE']), { forward: 0, turn: 0, left: -1 });
  assert.deepEqual(fromKeys(['KeyQ', 'KeyE']), STILL);
  const demand = { forward: 0.5, turn: 0, left: -1 };
  assert.deepEqual(toVelocity(demand, { linear: 0.4, angular: 2 }), {
    linear: 0.2,
    angular: 0,
    sideways: -0.4,
  });
});

test('a stick pushed up drives ahead, pushed to the left turns left', () => {
  assert.deepEqual(fromStick(0, -1, 0.1), { forward: 1, turn: 0 });
  assert.deepEqual(fromStick(-1, 0, 0.1), { forward: 0, turn: 1 });
});

test('a stick rests in its dead zone and leaves it without a step', () => {
  assert.deepEqual(fromStick(0.07, 0.07, 0.1), STILL);
  const { forward } = fromStick(0, -0.1001, 0.1);
  assert.ok(forward > 0 && forward < 0.001);
});

test('a stick is odd: the opposite push is the opposite demand, and never more than all', () => {
  for (let angle = 0; angle < 6.3; angle += 0.37) {
    for (const length of [0.05, 0.3, 1, 4]) {
      const right = length * Math.cos(angle);
      const down = length * Math.sin(angle);
      const one = fromStick(right, down, 0.1);
      const other = fromStick(-right, -down, 0.1);
      assert.ok(Math.abs(one.forward + other.forward) < 1e-12);
      assert.ok(Math.abs(one.turn + other.turn) < 1e-12);
      assert.ok(Math.hypot(one.forward, one.turn) <= 1 + 1e-12);
    }
  }
});

test('a stick that says nonsense rests', () => {
  assert.deepEqual(fromStick(Number.NaN, 0, 0.1), STILL);
  assert.deepEqual(fromStick(0, Number.POSITIVE_INFINITY, 0.1), STILL);
});

test('several hands add up, within the limits', () => {
  assert.deepEqual(mix([]), STILL);
  assert.deepEqual(mix([{ forward: 0.7, turn: -0.8 }, { forward: 0.7, turn: -0.8 }]), {
    forward: 1,
    turn: -1,
  });
});

test('a demand is a share of the limits', () => {
  assert.deepEqual(toVelocity({ forward: -0.5, turn: 1 }, { linear: 0.8, angular: 2 }), {
    linear: -0.4,
    angular: 2,
  });
});
