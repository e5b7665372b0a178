// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { HEAD_AT, SAMPLE_KIND } from '../src/protocol';
import { WaitingFrames } from '../src/socket/frames';

function state(number: number): ArrayBuffer {
  const frame = new ArrayBuffer(16);
  new DataView(frame).setUint8(0, 1);
  new DataView(frame).setUint32(4, number, true);
  return frame;
}

function sample(topic: string, type = 'range', size = 0): ArrayBuffer {
  const origin = { topic, frame: '', stamp: 0, rate: null };
  const text = JSON.stringify({ type, origin });
  const head = new TextEncoder().encode(text.padEnd(4 * Math.ceil(text.length / 4)));
  const frame = new Uint8Array(HEAD_AT + head.length + size);
  frame[0] = SAMPLE_KIND;
  new DataView(frame.buffer).setUint16(2, head.length, true);
  frame.set(head, HEAD_AT);
  return frame.buffer;
}

function waiting(): { given: ArrayBuffer[][]; frames: WaitingFrames } {
  const given: ArrayBuffer[][] = [];
  return { given, frames: new WaitingFrames((some) => void given.push(some)) };
}

test('a page that keeps up gets every frame at once', () => {
  const { given, frames } = waiting();
  for (let number = 0; number < 3; number += 1) {
    frames.add(state(number));
    frames.taken();
  }
  assert.deepEqual(given.map((some) => some.length), [1, 1, 1]);
});

test('a page that does not gets the newest state and the newest sample of each topic', () => {
  const { given, frames } = waiting();
  frames.add(state(0));
  const newest = [state(2), sample('/scan'), sample('/sonar')];
  for (const frame of [state(1), sample('/scan'), sample('/sonar'), ...newest]) {
    frames.add(frame);
  }
  assert.equal(given.length, 1, 'it is busy with the first');
  frames.taken();
  assert.deepEqual(given[1], newest);
  frames.taken();
  assert.equal(given.length, 2, 'nothing waits');
});

test('what cannot be read is left to the page to say', () => {
  const { given, frames } = waiting();
  const broken = new Uint8Array([SAMPLE_KIND, 0, 3, 0]).buffer;
  frames.add(broken);
  assert.deepEqual(given, [[broken]]);
});

test('of plotted values the page gets all, and whole messages beside the samples of a sensor', () => {
  const { given, frames } = waiting();
  frames.add(state(0));
  const all = [sample('/a'), sample('/a', 'message'), sample('/a', 'values'), sample('/a', 'values')];
  for (const frame of [sample('/a'), sample('/a', 'message'), ...all]) {
    frames.add(frame);
  }
  frames.taken();
  assert.deepEqual(given[1], all);
});

test('values that wait for too long give way to newer ones', () => {
  const { given, frames } = waiting();
  frames.add(state(0));
  const large = Array.from({ length: 12 }, () => sample('/a', 'values', 1_000_000));
  large.forEach((each) => frames.add(each));
  frames.taken();
  assert.deepEqual(given[1], large.slice(-8));
});
