// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Past } from '../src/past';
import { HEADER_BYTES, STATE_KIND, type Layout } from '../src/protocol';
import type { Sample } from '../src/samples';
import { decodeState } from '../src/state';

const LAYOUT: Layout = { type: 'layout', id: 1, frames: [], robots: [] };

/** A page whose states and samples are numbers: what it shows, and how many it keeps. */
function page(): { past: Past; shown: string[]; state: (time: number, layout?: Layout) => boolean; sample: (topic: string, stamp: number, size?: number) => boolean } {
  const shown: string[] = [];
  const past = new Past({
    state: ({ time }) => shown.push(`state ${time}${past.isShown ? ', past' : ''}`),
    sample: ({ head: { origin } }) => shown.push(`${origin.topic} ${origin.stamp}`),
    over: () => shown.push('over'),
  });
  const state = (time: number, layout = LAYOUT): boolean => {
    const frame = new DataView(new ArrayBuffer(HEADER_BYTES));
    frame.setUint8(0, STATE_KIND);
    frame.setUint16(2, layout.id, true);
    frame.setFloat64(8, time, true);
    return past.takeState(decodeState(frame.buffer, layout)!);
  };
  const sample = (topic: string, stamp: number, size = 1): boolean =>
    past.takeSample({
      head: { type: 'unreadable', origin: { topic, frame: '', stamp, rate: null }, text: '', channel: 'sensor' },
      bytes: new Uint8Array(size),
      floats: new Float32Array(),
    } satisfies Sample);
  return { past, shown, state, sample };
}

test('what was is shown as it was, and what is, as it is then', () => {
  const { past, shown, state, sample } = page();
  for (let time = 1; time <= 3; time += 1) {
    assert.ok(state(time) && sample('/camera', time));
  }
  assert.equal(past.lookAt(2.5), 2);
  assert.deepEqual(shown.splice(0), ['state 2, past', '/camera 2']);
  assert.ok(!state(4) && !sample('/camera', 4) && !sample('/camera', 4.01), 'nothing that comes is shown');
  assert.equal(past.lookAt(0.5), 1, 'the oldest, where nothing older is kept');
  assert.deepEqual(shown.splice(0), ['state 1, past']);
  assert.equal(past.lookAt(null), null);
  assert.deepEqual(shown.splice(0), ['over', 'state 4', '/camera 4.01']);
  assert.ok(state(5) && sample('/camera', 5));
  assert.equal(past.lookAt(null), null);
  assert.deepEqual(shown, [], 'it was not looked at');
});

test('a minute is kept, ten states a second, five samples of a topic, of large ones one', () => {
  const { past, state, sample } = page();
  for (let step = 0; step < 100 * 60; step += 1) {
    state(step / 50);
    sample('/scan', step / 50);
    sample('/cloud', step / 50, 1 << 17);
  }
  const { samples, bytes } = past as unknown as { samples: Map<string, unknown[]>; bytes: number };
  assert.ok(Math.abs(past.lookAt(0)! - 60) < 1, 'of two minutes the second');
  assert.ok(Math.abs(past.lookAt(100)! - 100) < 0.11);
  assert.ok(samples.get('/scan')!.length > 290 && samples.get('/scan')!.length <= 310);
  assert.ok(samples.get('/cloud')!.length <= 61);
  assert.equal(bytes, samples.get('/scan')!.length + samples.get('/cloud')!.length * (1 << 17));
});

test('where samples are many, the oldest of all give way', () => {
  const { past, state, sample } = page();
  for (let time = 0; time < 50; time += 1) {
    state(time);
    sample('/one', time, 1 << 20);
    sample('/other', time, 1 << 10);
  }
  const { samples, bytes } = past as unknown as { samples: Map<string, unknown[]>; bytes: number };
  assert.ok(bytes <= 1 << 24 && bytes > 0.9 * (1 << 24));
  assert.ok(Math.abs(samples.get('/one')!.length - samples.get('/other')!.length) <= 1);
});

test('time that goes back, and other frames, end what was', () => {
  for (const [time, layout] of [[1, LAYOUT], [9, { ...LAYOUT, id: 2 }]] as const) {
    const { past, shown, state } = page();
    state(5);
    state(6);
    past.lookAt(5);
    shown.length = 0;
    assert.ok(state(time, layout));
    assert.deepEqual(shown, ['over', 'state 6']);
    assert.equal(past.lookAt(5), time, 'no other is kept');
  }
});
