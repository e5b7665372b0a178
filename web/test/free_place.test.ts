// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Shape } from '../src/protocol';
import { freePlace, isFree, type Footprint } from '../src/spawn/free_place';

const GROUND: Shape = {
  name: 'ground', kind: 'plane', size: [0, 0, 0], position: [0, 0, 0], orientation: [0, 0, 0, 1],
  colour: [1, 1, 1, 1], points: [],
};

function box(x: number, y: number, wide: number, deep: number, yaw = 0, z = 0.5): Shape {
  const orientation: Shape['orientation'] = [0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)];
  return { ...GROUND, kind: 'box', size: [wide, deep, 1], position: [x, y, z], orientation };
}

function robot(x: number, y: number, yaw = 0, id = '/'): Footprint {
  return { id, x, y, yaw, radius: 0.4 };
}

test('the first robot stands in the origin, or beside what stands there', () => {
  assert.deepEqual(freePlace(0.4, [], [GROUND]), { x: 0, y: 0 });
  const crate = box(0, 0, 1, 1);
  const place = freePlace(0.4, [], [GROUND, crate]);
  assert.ok(place !== null && isFree(place, 0.4, [], [crate]));
});

test('another robot stands to the left of the first one, with a gap', () => {
  assert.deepEqual(freePlace(0.4, [robot(0, 0)], [GROUND]), { x: 0, y: 1.1 });
  const turned = freePlace(0.4, [robot(2, 3, Math.PI / 2)], [GROUND]);
  assert.deepEqual(turned, { x: 0.9, y: 3 });
});

test('each of many has room beside those before', () => {
  const robots = [robot(0, 0)];
  for (let number = 1; number < 12; number += 1) {
    const place = freePlace(0.4, robots, [GROUND]);
    assert.ok(place !== null);
    assert.ok(isFree(place, 0.4, robots, [GROUND]));
    robots.push(robot(place.x, place.y, 0, `/robot${number}`));
  }
});

test('it is not put into walls, nor behind them', () => {
  const walls = [box(0, 0.9, 8, 0.1), box(-0.9, 0, 0.1, 8), box(0, -0.9, 8, 0.1), box(3, 0, 0.1, 8)];
  const place = freePlace(0.4, [robot(0, 0)], [GROUND, ...walls]);
  assert.deepEqual(place, { x: 1.1, y: 0 }, 'ahead is the only room left');
  assert.equal(freePlace(0.4, [robot(0, 0)], [...walls, box(1, 0, 0.2, 1.6)]), null);
});

test('shapes are as wide as they are turned, and what is flat or high is no hindrance', () => {
  const wall = box(0, 0, 4, 0.1, Math.PI / 4);
  assert.equal(isFree({ x: 1, y: 1 }, 0.4, [], [wall]), false);
  assert.equal(isFree({ x: 1, y: -1 }, 0.4, [], [wall]), true);
  assert.equal(isFree({ x: 0, y: 0 }, 0.4, [], [box(0, 0, 1, 1, 0, -0.495)]), true);
  assert.equal(isFree({ x: 0, y: 0 }, 0.4, [], [box(0, 0, 1, 1, 0, 3)]), true);
  const triangles: Shape = { ...GROUND, kind: 'triangles', points: [1, 1, 0, 2, 1, 0, 1, 2, 1] };
  assert.equal(isFree({ x: 1.5, y: 1.5 }, 0.2, [], [triangles]), false);
  assert.equal(isFree({ x: 0, y: 0 }, 0.2, [], [triangles]), true);
  const tipped: Shape = { ...box(0, 0, 0.2, 0.2), size: [0.2, 0.2, 4], orientation: [0, Math.SQRT1_2, 0, Math.SQRT1_2] };
  assert.equal(isFree({ x: 1.5, y: 0 }, 0.2, [], [tipped]), false, 'a pillar that lies along x');
});
