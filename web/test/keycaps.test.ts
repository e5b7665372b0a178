// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { connectedApp, drawn } from './page';
import { keycaps, labelOf } from '../src/drive/keycaps';

const AZERTY = new Map([['KeyW', 'z'], ['KeyA', 'q'], ['KeyS', 's'], ['KeyD', 'd']]);

test('a key is named as it is labelled', () => {
  connectedApp();
  assert.equal(labelOf('KeyW', AZERTY), 'Z');
  assert.equal(labelOf('KeyE', AZERTY), 'E', 'what the layout does not say is as on a US keyboard');
  assert.equal(labelOf('KeyW', null), 'W');
});

test('key caps get their letters when the browser has told them', async () => {
  const keyboard = { getLayoutMap: () => Promise.resolve(AZERTY) };
  Object.defineProperty(globalThis, 'navigator', { value: { keyboard }, configurable: true });
  const caps = keycaps('KeyW', 'KeyA');
  assert.deepEqual(caps.map((cap) => cap.textContent), ['W', 'A']);
  await drawn();
  assert.deepEqual(caps.map((cap) => cap.textContent), ['Z', 'Q']);
});
