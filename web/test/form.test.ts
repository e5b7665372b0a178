// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { formOf, opensPanels } from '../src/form';
import { hiddenEnds } from '../src/overflow';

const SIZES = [
  [1440, 900, 'desk'], [1280, 720, 'desk'], [3840, 2160, 'desk'], [960, 1080, 'desk'],
  [844, 390, 'wide'], [667, 375, 'wide'], // phones on their side
  [720, 450, 'wide'], [853, 480, 'wide'], [640, 360, 'wide'], // 1440x900 and 1280x720, zoomed
  [1366, 620, 'wide'], [700, 600, 'wide'], [320, 256, 'wide'], // low windows; 1280x1024 at 400 %
  [390, 844, 'tall'], [320, 568, 'tall'], [820, 1180, 'tall'],
] as const;

for (const [width, height, form] of SIZES) {
  test(`a window of ${width}x${height} has the form ${form}`, () => {
    assert.equal(formOf(width, height), form);
  });
}

test('panels are open to begin with where they take nothing from the view', () => {
  assert.equal(opensPanels(1440, 900), true);
  assert.equal(opensPanels(1366, 620), true);
  assert.equal(opensPanels(844, 390), false);
  assert.equal(opensPanels(390, 844), false);
});

test('a row says at which ends it hides something', () => {
  assert.equal(hiddenEnds(0, 100, 100), '');
  assert.equal(hiddenEnds(0, 100, 101), '', 'rounding');
  assert.equal(hiddenEnds(0, 100, 300), 'right');
  assert.equal(hiddenEnds(80, 100, 300), 'left right');
  assert.equal(hiddenEnds(200, 100, 300), 'left');
});
