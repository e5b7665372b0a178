// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Trail } from '../src/scene/trail';

/** The x of each point kept. */
function xs(trail: Trail): number[] {
  return Array.from({ length: trail.count }, (_, i) => trail.points[3 * i]!);
}

test('a robot that stands leaves one point', () => {
  const trail = new Trail({ spacing: 0.1 });
  for (let i = 0; i < 1000; i++) {
    trail.add(1 + 1e-4 * (i % 2), 0, 0);
  }
  assert.equal(trail.count, 1);
});

test('creeping is seen: points are far from the last one kept, not the last one given', () => {
  const trail = new Trail({ spacing: 0.1 });
  for (let i = 0; i <= 1000; i++) {
    trail.add(i * 0.001, 0, 0);
  }
  assert.ok(trail.count >= 10 && trail.count <= 11, String(trail.count));
});

test('its memory is bounded, whatever comes', () => {
  const trail = new Trail({ coarse: 16, fine: 16, spacing: 0.1 });
  const buffer = trail.points;
  for (let i = 0; i < 100_000; i++) {
    trail.add(i * 0.13, Math.sin(i), 0);
    assert.ok(trail.count <= 32);
  }
  assert.equal(trail.points, buffer);
  assert.equal(buffer.length, 3 * 33); // one is where it is now
});

test('it keeps its beginning, its order and, finely, its end', () => {
  const trail = new Trail({ coarse: 16, fine: 16, spacing: 0.125 });
  for (let i = 0; i < 10_000; i++) {
    trail.add(i * 0.125, 0, 0);
    const kept = xs(trail);
    assert.equal(kept[0], 0);
    assert.equal(kept.at(-1), i * 0.125);
    assert.ok(kept.every((x, at) => at === 0 || x > kept[at - 1]!));
  }
  const end = xs(trail).slice(-8);
  assert.ok(end.every((x, at) => at === 0 || 0.125 === x - end[at - 1]!));
});

test('the old part is even: no gap of it is twice as long as most', () => {
  const trail = new Trail({ coarse: 64, fine: 16, spacing: 0.125 });
  for (let i = 0; i < 5000; i++) {
    trail.add(i * 0.125, 0, 0);
  }
  const kept = xs(trail).slice(0, -17);
  const gaps = kept.slice(1).map((x, at) => x - kept[at]!);
  assert.ok(Math.max(...gaps) <= 2 * Math.min(...gaps), String(gaps));
});

test('points below firstChanged are as they were drawn', () => {
  const trail = new Trail({ coarse: 16, fine: 16, spacing: 0.125 });
  const drawn = new Float32Array(trail.points.length);
  for (let i = 0; i < 2000; i++) {
    trail.add(i * 0.125, 0, 0);
    const from = 3 * trail.firstChanged;
    const to = 3 * trail.count;
    drawn.set(trail.points.subarray(from, to), from);
    trail.markDrawn();
    assert.deepEqual(drawn.subarray(0, to), trail.points.subarray(0, to));
  }
});

test('eight hours at 1 m/s fit, and the last 40 m are there to 2 cm', () => {
  const trail = new Trail();
  const steps = 8 * 3600 * 10;
  for (let i = 0; i < steps; i++) {
    trail.add(Math.cos(i * 0.02) * 5, Math.sin(i * 0.02) * 5, 0);
  }
  assert.ok(trail.count <= 8192);
  assert.ok(trail.count > 2048);
});

test('cleared, it begins anew', () => {
  const trail = new Trail({ coarse: 4, fine: 4, spacing: 0.1 });
  for (let i = 0; i < 100; i++) {
    trail.add(i, 0, 0);
  }
  trail.clear();
  assert.equal(trail.count, 0);
  trail.add(5, 6, 7);
  assert.deepEqual([...trail.points.subarray(0, 3)], [5, 6, 7]);
  assert.equal(trail.firstChanged, 0);
});

/** The greatest distance of a trail's points from a circle about 0, and between two of them. */
function worst(trail: Trail, radius: number): { off: number; gap: number } {
  const at = (i: number): number[] => [...trail.points.subarray(3 * i, 3 * i + 2)];
  const all = Array.from({ length: trail.count - 1 }, (_, i) => at(i)); // to the last but one it is bent
  const gaps = all.slice(2, -1).map(([x, y], i) => Math.hypot(x! - all[i + 1]![0]!, y! - all[i + 1]![1]!));
  return {
    off: Math.max(...all.slice(1).map(([x, y]) => Math.abs(Math.hypot(x!, y!) - radius))),
    gap: Math.max(...gaps),
  };
}

test('where few places come, as on a busy machine, the way has no corners', () => {
  const trail = new Trail({ spacing: 0.02 });
  for (let i = 0; i < 60; i++) {
    trail.add(Math.cos(0.25 * i), Math.sin(0.25 * i), 0); // 0.25 m apart: a corner would lie 8 mm inside
  }
  const { off, gap } = worst(trail, 1);
  assert.ok(off < 0.002, `${off} m beside the circle`);
  assert.ok(gap < 0.03, `${gap} m between two points`);
});

test('it ends where the robot is, however little that has moved since a point was kept', () => {
  const trail = new Trail({ spacing: 0.125 });
  trail.add(0, 0, 0);
  assert.equal(trail.drawn, 1);
  assert.equal(trail.add(0.1, 0, 0), true);
  assert.equal(trail.add(0.1001, 0, 0), false, 'too little to be seen');
  assert.deepEqual([trail.count, trail.drawn, ...trail.points.subarray(3, 6)], [1, 2, ...new Float32Array([0.1, 0, 0])]);
  trail.add(0.125, 0, 0);
  assert.deepEqual([trail.count, trail.drawn], [2, 2]);
});

test('one that goes back leaves no bulge where it turned', () => {
  const trail = new Trail({ spacing: 0.02 });
  for (const x of [0, 0.2, 0.4, 0.6, 0.4, 0.2, 0]) {
    trail.add(x, 0.001 * x, 0);
  }
  const far = Array.from({ length: trail.count }, (_, i) => Math.abs(trail.points[3 * i + 1]!));
  assert.ok(Math.max(...far) < 0.001, String(Math.max(...far)));
});
