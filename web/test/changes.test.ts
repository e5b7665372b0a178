// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Layout } from '../src/protocol';
import { differ } from '../src/scene/changes';
import { decodeState, stateBytes, type State } from '../src/state';

const LAYOUT: Layout = {
  type: 'layout', id: 1, frames: [{ name: 'base', parent: 'odom' }], robots: [],
};

let clock = 0;

function state(x: number, layout: Layout = LAYOUT): State {
  const buffer = new ArrayBuffer(stateBytes(layout));
  const view = new DataView(buffer);
  view.setUint8(0, 1);
  view.setUint16(2, layout.id, true);
  view.setFloat64(8, ++clock, true); // the time alone changes nothing
  view.setFloat32(16, x, true);
  return decodeState(buffer, layout) as State;
}

test('a robot that stands, or trembles by less than can be seen, is the same', () => {
  assert.ok(!differ(state(1), state(1)));
  assert.ok(!differ(state(1), state(1.00001)));
  assert.ok(!differ(state(NaN), state(NaN)));
});

test('what moves, comes or goes is not', () => {
  assert.ok(differ(state(1), state(1.001)));
  assert.ok(differ(state(1), state(NaN)));
  assert.ok(differ(state(NaN), state(1)));
  assert.ok(differ(null, state(1)));
  assert.ok(differ(state(1), state(1, { ...LAYOUT, id: 2 })));
});
