// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compose, inverse, poseIn, rollPitchYaw, rootsOf, type Pose } from '../src/poses';
import type { Layout, Quaternion } from '../src/protocol';
import type { State } from '../src/state';

const LAYOUT: Layout = {
  type: 'layout',
  id: 1,
  frames: [
    { name: 'base', parent: 'odom' },
    { name: 'wheel', parent: 'base' },
    { name: 'far', parent: 'elsewhere' },
  ],
  robots: [],
};
const HALF = Math.SQRT1_2;

function state(...poses: number[][]): State {
  const numbers = new Float32Array(poses.flat());
  return { layout: LAYOUT, sequence: 0, time: 0, poses: numbers, robots: [] };
}

const STATE = state(
  [1, 0, 0, 0, 0, HALF, HALF], // base: 1 m ahead, a quarter turn to the left
  [0.5, 0, 0, 0, 0, 0, 1],
  [0, 0, 0, 0, 0, 0, 1],
);

function near(one: readonly number[], other: readonly number[]): void {
  assert.equal(one.length, other.length);
  one.forEach((value, index) => assert.ok(Math.abs(value - other[index]) < 1e-6, String(one)));
}

test('a frame is found in any other of its tree', () => {
  near(poseIn(STATE, 'wheel', 'odom')!.position, [1, 0.5, 0]);
  near(poseIn(STATE, 'odom', 'wheel')!.position, [-0.5, 1, 0]);
  near(poseIn(STATE, 'wheel', 'wheel')!.position, [0, 0, 0]);
});

test('a frame of another tree is not', () => {
  assert.equal(poseIn(STATE, 'wheel', 'far'), null);
});

test('a pose and its inverse are nothing', () => {
  const pose: Pose = { position: [1, -2, 3], orientation: [0.5, -0.5, 0.5, 0.5] };
  for (const nothing of [compose(pose, inverse(pose)), compose(inverse(pose), pose)]) {
    near(nothing.position, [0, 0, 0]);
    near(nothing.orientation, [0, 0, 0, 1]);
  }
});

test('roll, pitch and yaw each turn about their axis', () => {
  const angle = 0.3;
  const sine = Math.sin(angle / 2);
  const cosine = Math.cos(angle / 2);
  for (const axis of [0, 1, 2]) {
    const quaternion: Quaternion = [0, 0, 0, cosine];
    quaternion[axis] = sine;
    const wanted = [0, 0, 0];
    wanted[axis] = angle;
    near(rollPitchYaw(quaternion), wanted);
  }
});

test('roots are the frames that are nobody’s child', () => {
  assert.deepEqual(rootsOf(LAYOUT), ['odom', 'elsewhere']);
});
