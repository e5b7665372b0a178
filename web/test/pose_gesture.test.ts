// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PoseGesture } from '../src/navigation/gesture';

const USUAL = 0.7; // rad, where nothing was dragged

/** A gesture, over a ground of 0.01 m to a CSS px; y of the ground goes up. */
function gesture(): PoseGesture {
  return new PoseGesture(() => USUAL);
}

function ground(x: number, y: number): { x: number; y: number } {
  return { x: x / 100, y: -y / 100 };
}

test('it is where it was pressed, and looks to where it was dragged', () => {
  const one = gesture();
  assert.equal(one.press(1, 100, 200, ground(100, 200)), true);
  assert.equal(one.move(1, 100, 150, ground(100, 150)), true);
  const place = one.release(1);
  assert.deepEqual([place?.x, place?.y], [1, -2]);
  assert.ok(Math.abs((place?.yaw ?? 0) - Math.PI / 2) < 1e-9);
  assert.equal(one.isHeld, false);
});

test('a hand that trembles has not dragged', () => {
  const one = gesture();
  one.press(1, 100, 100, ground(100, 100));
  one.move(1, 103, 104, ground(103, 104));
  assert.equal(one.release(1)?.yaw, USUAL);
});

test('once dragged it turns with every pixel, also near to where it began', () => {
  const one = gesture();
  one.press(1, 0, 0, ground(0, 0));
  one.move(1, 20, 0, ground(20, 0));
  assert.equal(one.place?.yaw, 0);
  one.move(1, -2, 0, ground(-2, 0));
  assert.equal(Math.abs(one.place?.yaw ?? 0), Math.PI);
});

test('above the horizon it looks where it did', () => {
  const one = gesture();
  one.press(1, 0, 0, ground(0, 0));
  one.move(1, 0, -50, ground(0, -50));
  const { yaw } = one.place ?? { yaw: NaN };
  one.move(1, 300, -900, null);
  assert.equal(one.release(1)?.yaw, yaw);
});

test('nothing begins where there is no ground, and other fingers move nothing', () => {
  const one = gesture();
  assert.equal(one.press(1, 0, 0, null), false);
  assert.equal(one.release(1), null);
  one.press(1, 0, 0, ground(0, 0));
  assert.equal(one.move(2, 90, 0, ground(90, 0)), false);
  assert.equal(one.release(2), null);
  assert.equal(one.isHeld, true);
  one.cancel();
  assert.equal(one.release(1), null);
});
