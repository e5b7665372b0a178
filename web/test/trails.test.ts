// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4, Vector3 } from 'three';
import { Trails } from '../src/scene/trails';
import type { RobotState } from '../src/state';

type Pose = [x: number, y: number, yaw: number];

const UNKNOWN: Pose = [NaN, NaN, NaN];

/** A robot of which only the places are known. */
function robot(truth: Pose, odometry: Pose): RobotState {
  const motion = ([x, y, yaw]: Pose): Float32Array =>
    new Float32Array([x, y, 0, 0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2), 0, 0]);
  const none = new Float32Array();
  return {
    id: '/', positions: none, velocities: none, commanded: none, command: none, wheels: none,
    truth: motion(truth), odometry: motion(odometry),
  };
}

/** Where a point of the odometry's frame is in `world`. */
function inWorld(anchor: Matrix4 | null, x: number, y: number): number[] {
  assert.ok(anchor);
  return new Vector3(x, y, 0).applyMatrix4(anchor).toArray().map((value) => +value.toFixed(5));
}

test('the odometry is laid onto the truth where both are first known, and stays there', () => {
  const trails = new Trails(false);
  trails.add(robot([5, 6, Math.PI / 2], [1, 0, 0]), 0);
  assert.deepEqual(inWorld(trails.anchorInWorld, 1, 0), [5, 6, 0]);
  assert.deepEqual(inWorld(trails.anchorInWorld, 2, 0), [5, 7, 0]);
  trails.add(robot([5, 6.5, Math.PI / 2], [1.7, 0, 0]), 1);
  assert.deepEqual(inWorld(trails.anchorInWorld, 1, 0), [5, 6, 0]);
  assert.deepEqual(trails.counts, [2, 2]);
});

test('a robot without truth has one trail', () => {
  const trails = new Trails(false);
  trails.add(robot(UNKNOWN, [0, 0, 0]), 0);
  trails.add(robot(UNKNOWN, [1, 0, 0]), 1);
  assert.equal(trails.anchorInWorld, null);
  assert.deepEqual(trails.counts, [0, 2]);
});

test('a robot that is put elsewhere begins anew; one that drives fast does not', () => {
  const trails = new Trails(false);
  trails.add(robot([0, 0, 0], [0, 0, 0]), 0);
  assert.equal(trails.add(robot([4, 0, 0], [4, 0, 0]), 1), false);
  assert.equal(trails.add(robot([0, 3, 0], [4, 0, 0]), 1.02), true);
  assert.deepEqual(trails.counts, [1, 1]);
  assert.deepEqual(inWorld(trails.anchorInWorld, 4, 0), [0, 3, 0]);
});

test('cleared, the two agree anew', () => {
  const trails = new Trails(false);
  trails.add(robot([0, 0, 0], [0, 0, 0]), 0);
  trails.clear();
  assert.deepEqual(trails.counts, [0, 0]);
  trails.add(robot([1, 1, 0], [0, 0, 0]), 1);
  assert.deepEqual(inWorld(trails.anchorInWorld, 0, 0), [1, 1, 0]);
});
