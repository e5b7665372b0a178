// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { coloured, inflate, schemeOf, type Scheme } from '../src/navigation/cells';

function deflated(...cells: number[]): Uint8Array<ArrayBuffer> {
  return new Uint8Array(deflateSync(new Int8Array(cells)));
}

/** Red, green, blue of a cell, and whether it is seen at all. */
function colour(value: number, scheme: Scheme): [number[], boolean] {
  const [red = -1, green = -1, blue = -1, alpha = -1] = coloured(new Int8Array([value]), scheme);
  return [[red, green, blue], alpha > 0];
}

test('cells come out as they went in', async () => {
  assert.deepEqual([...(await inflate(deflated(0, 100, -1, 50), 4))], [0, 100, -1, 50]);
});

test('what is not deflated, or of another size, is refused', async () => {
  await assert.rejects(inflate(new Uint8Array([1, 2, 3]), 3), /not deflated/);
  await assert.rejects(inflate(deflated(0, 0), 3), /a map of 3 cells that has 2/);
});

test('a map is white where it is free, black where it is not, and not there where it is unknown', () => {
  assert.deepEqual(colour(0, 'map'), [[255, 255, 255], true]);
  assert.deepEqual(colour(100, 'map'), [[0, 0, 0], true]);
  assert.deepEqual(colour(50, 'map'), [[127, 127, 127], true]);
  assert.equal(colour(-1, 'map')[1], false);
});

test('what is no probability has a colour that no map has', () => {
  assert.deepEqual(colour(101, 'map'), [[0, 255, 0], true]);
  assert.deepEqual(colour(-128, 'map'), [[255, 0, 0], true]);
  assert.deepEqual(colour(-2, 'map'), [[255, 255, 0], true]);
});

test('a costmap goes from blue to red, and what hits is cyan and magenta', () => {
  assert.equal(colour(0, 'costmap')[1], false);
  assert.deepEqual(colour(1, 'costmap')[0], [3, 0, 252]);
  assert.deepEqual(colour(98, 'costmap')[0], [250, 0, 5]);
  assert.deepEqual(colour(99, 'costmap')[0], [0, 255, 255]);
  assert.deepEqual(colour(100, 'costmap')[0], [255, 0, 255]);
  assert.equal(colour(-1, 'costmap')[1], false);
});

test('a costmap is known by its name', () => {
  assert.equal(schemeOf('/map'), 'map');
  assert.equal(schemeOf('/robot1/global_costmap/costmap'), 'costmap');
});
