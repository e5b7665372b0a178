// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Asked } from '../src/connection';
import type { Playhead } from '../src/protocol';
import { Scrubber } from '../src/recording/scrubber';

/** A node that answers when it is told to. */
class Node {
  asked: Asked[] = [];
  head: Playhead = { type: 'playhead', place: 0, playing: false, rate: 1 };
  private answers: (() => void)[] = [];
  readonly scrubber = new Scrubber(
    (asked) => {
      this.asked.push(asked);
      return new Promise<void>((resolve) => this.answers.push(resolve));
    },
    () => 10,
    () => this.head,
  );

  async answer(): Promise<void> {
    this.answers.shift()?.();
    await new Promise((resolve) => setTimeout(resolve));
  }

  get places(): number[] {
    return this.asked.flatMap((each) => (each.type === 'seek' ? [each.place] : []));
  }
}

test('while one move is asked for, the last of the next ones waits', async () => {
  const node = new Node();
  [1, 2, 3, 4].forEach((place) => node.scrubber.move(place));
  assert.deepEqual(node.places, [1]);
  await node.answer();
  assert.deepEqual(node.places, [1, 4]);
  await node.answer();
  node.scrubber.move(5);
  assert.deepEqual(node.places, [1, 4, 5]);
});

test('a place is within the recording', () => {
  const node = new Node();
  node.scrubber.move(-3);
  assert.equal(node.scrubber.place, 0);
  node.scrubber.move(30);
  assert.equal(node.scrubber.place, 10);
});

test('arrows go on from where it will be, with Shift by less', () => {
  const node = new Node();
  node.head = { ...node.head, place: 4 };
  node.scrubber.press('ArrowRight', false);
  node.scrubber.press('ArrowRight', true);
  assert.ok(Math.abs(node.scrubber.place - 5.1) < 1e-9);
  node.scrubber.press('Home', false);
  assert.equal(node.scrubber.place, 0);
  node.scrubber.press('End', false);
  assert.equal(node.scrubber.place, 10);
});

test('Space plays and pauses, up and down change the rate', () => {
  const node = new Node();
  assert.ok(node.scrubber.press(' ', false));
  node.head = { ...node.head, playing: true };
  node.scrubber.press(' ', false);
  node.scrubber.press('ArrowUp', false);
  node.scrubber.press('ArrowDown', false);
  node.head = { ...node.head, rate: 10 };
  node.scrubber.press('ArrowUp', false);
  assert.deepEqual(node.asked, [
    { type: 'playback', playing: true, rate: 1 },
    { type: 'playback', playing: false, rate: 1 },
    { type: 'playback', playing: true, rate: 2 },
    { type: 'playback', playing: true, rate: 0.5 },
    { type: 'playback', playing: true, rate: 10 },
  ]);
});

test('other keys are for others', () => {
  const node = new Node();
  assert.ok(!node.scrubber.press('a', false));
  assert.deepEqual(node.asked, []);
});
