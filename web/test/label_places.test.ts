// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { placeLabels, type Anchor, type PlacedLabel } from '../src/scene/label_places';

const WIDTH = 800;
const HEIGHT = 600;

function anchor(key: string, x: number, y: number): Anchor {
  return { key, x, y, width: 80, height: 18, isAbove: key === 'robot' };
}

function place(anchors: Anchor[], habits = new Map<string, number>()): PlacedLabel[] {
  return placeLabels(anchors, WIDTH, HEIGHT, habits);
}

function assertApart(labels: readonly PlacedLabel[]): void {
  for (const one of labels) {
    for (const other of labels) {
      const isApart =
        one === other ||
        Math.abs(one.left - other.left) >= 80 ||
        Math.abs(one.top - other.top) >= 18;
      assert.ok(isApart, `${one.key} lies on ${other.key}`);
    }
  }
}

test('labels of points at one place do not lie on one another', () => {
  const anchors = Array.from({ length: 8 }, (_, i) => anchor(`frame ${i}`, 400, 300));
  const labels = place(anchors);
  assert.equal(labels.length, 8);
  assertApart(labels);
});

test('where there is no room for all, the first ones are written', () => {
  const anchors = Array.from({ length: 200 }, (_, i) => anchor(`frame ${i}`, 400, 300));
  const labels = place(anchors);
  assertApart(labels);
  assert.ok(labels.length > 15 && labels.length < 200, String(labels.length));
  assert.equal(labels[0]!.key, 'frame 0');
});

test('labels stay within the picture', () => {
  for (const [x, y] of [[0, 0], [WIDTH, 0], [0, HEIGHT], [WIDTH, HEIGHT], [400, 1]] as const) {
    const [label] = place([anchor('corner', x, y)]);
    assert.ok(label!.left >= 0 && label!.left + 80 <= WIDTH);
    assert.ok(label!.top >= 0 && label!.top + 18 <= HEIGHT);
  }
});

test('labels of a cluster stand outside of it', () => {
  const [left, right] = place([anchor('left', 380, 300), anchor('right', 420, 300)]);
  assert.ok(left!.left + 80 <= 380);
  assert.ok(right!.left >= 420);
});

test('a label stays on its side while its point moves a little', () => {
  const habits = new Map<string, number>();
  const [before] = place([anchor('a', 400, 300), anchor('b', 400, 300)], habits);
  for (let i = 1; i < 20; i++) {
    const [label] = place([anchor('a', 400 + i % 3, 300), anchor('b', 400, 300 + i % 2)], habits);
    assert.ok(Math.hypot(label!.left - before!.left - (i % 3), label!.top - before!.top) < 1e-9);
  }
});

test('the name of a robot stands right above it, whatever is about', () => {
  const robot = { ...anchor('robot', 400, 300), isAbove: true };
  const [label] = place([robot, anchor('a', 400, 200), anchor('b', 420, 260)]);
  assert.ok(Math.abs(label!.left + 40 - 400) < 1e-6);
  assert.ok(label!.top + 18 < 300 && label!.top + 18 > 280);
});

test('what else stands there is left free', () => {
  const tools = { left: 0, top: 0, right: WIDTH, bottom: 40 };
  const [free] = place([anchor('robot', 400, 50)]);
  assert.ok(free!.top < 40);
  const [label] = placeLabels([anchor('robot', 400, 50)], WIDTH, HEIGHT, new Map(), [tools]);
  assert.ok(label!.top > 40);
});
