// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Euler, Matrix4, Vector3 } from 'three';
import { follow, type Motion, pull, twist, upright } from '../src/scene/grip';

const at = (x: number, velocity = 0, interval = 33): Motion => ({
  at: 0,
  point: new Vector3(x, 0, 0),
  velocity: new Vector3(velocity, 0, 0),
  interval,
});

test('a hand pulls to where it is, by the mass of the robot, and no stronger than it can', () => {
  const to = new Vector3(0.1, 0, 0);
  assert.deepEqual(pull(10, at(0), to).toArray(), [30, 0, 0]);
  assert.deepEqual(pull(20, at(0), to).toArray(), [60, 0, 0]);
  const strongest = pull(10, at(0), new Vector3(0, 99, 0));
  assert.ok(Math.abs(strongest.length() - 120) < 1e-9);
});

/** Pull a mass of 15 kg in the air for 10 s, seen every `interval` s; how far it was off in the last 2 s, m. */
function swing(interval: number): number {
  const [mass, dt, to] = [15, 0.002, new Vector3(0.5, 0, 0)];
  const [position, velocity] = [new Vector3(), new Vector3()];
  let motion = follow(null, position.clone(), 0);
  let force = new Vector3();
  let [seen, off] = [0, 0];
  for (let time = dt; time < 10; time += dt) {
    velocity.addScaledVector(force, dt / mass);
    position.addScaledVector(velocity, dt);
    if (time - seen >= interval) {
      seen = time;
      force = pull(mass, motion, to); // by what was drawn the last time
      motion = follow(motion, position.clone(), time * 1000);
    }
    off = time > 8 ? Math.max(off, Math.abs(position.x - 0.5)) : 0;
  }
  return off;
}

test('a body that is pulled comes to rest where the hand is, however seldom it is drawn', () => {
  for (const interval of [0.016, 0.033, 0.05, 0.1, 0.15]) {
    assert.ok(swing(interval) < 0.05, `${swing(interval)} m, drawn every ${interval} s`);
  }
});

test('a body is turned where it is drawn often, and not spun up where it is not', () => {
  const [arm, force] = [new Vector3(0, 0.3, 0), new Vector3(10, 0, 0)];
  assert.deepEqual(twist(arm, force, at(0)).toArray(), [0, 0, -3]);
  assert.ok(twist(arm, force, at(0, 0, 100)).length() < 0.2);
});

test('how fast a point moves is told by the places where it was drawn', () => {
  const place = (x: number): Vector3 => new Vector3(x, 0, 0);
  let motion = follow(null, place(0), 0);
  assert.deepEqual(motion.velocity.toArray(), [0, 0, 0]);
  motion = follow(motion, place(0), 33);
  motion = follow(motion, place(0.05), 100);
  assert.deepEqual(motion.velocity.toArray(), [0.5, 0, 0], 'since it was first seen at the last');
  motion = follow(motion, place(0.05), 133);
  motion = follow(motion, place(0.05), 166);
  assert.deepEqual(motion.velocity.toArray(), [0.5, 0, 0], 'it has not been drawn anew');
  motion = follow(motion, place(0.05), 400);
  assert.deepEqual(motion.velocity.toArray(), [0, 0, 0], 'it stands');
});

test('a robot that is put elsewhere stands upright, its heading kept', () => {
  const pose = (roll: number, z: number): Matrix4 =>
    new Matrix4().makeRotationFromEuler(new Euler(roll, 0, 0.7, 'ZYX')).setPosition(1, 2, z);
  const standing = upright(pose(0.1, 0.03));
  assert.deepEqual(standing.position, [1, 2, 0.03]);
  assert.ok(Math.abs(standing.yaw - 0.7) < 1e-9);
  const lying = upright(pose(1.5, -0.1));
  assert.deepEqual(lying.position, [1, 2, 0.02], 'not within the ground');
});
