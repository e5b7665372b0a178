// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Channels, type FieldBatch, type TopicMessage } from '../src/channels';
import type { Head, Origin } from '../src/protocol';
import { decodeSample, type Sample } from '../src/samples';
import { BadState } from '../src/state';

const ORIGIN: Origin = { topic: '/odom', frame: '', stamp: 2, rate: 100 };

function sample(head: Head, after: Uint8Array): Sample {
  let text = JSON.stringify(head);
  text = text.padEnd(8 * Math.ceil((4 + text.length) / 8) - 4);
  const bytes = new Uint8Array(4 + text.length + after.length);
  bytes[0] = 2;
  new DataView(bytes.buffer).setUint16(2, text.length, true);
  bytes.set(new TextEncoder().encode(text), 4);
  bytes.set(after, 4 + text.length);
  return decodeSample(bytes.buffer);
}

function values(paths: string[], columns: number[][], first = 0, faults = {}): Sample {
  const count = columns[0]?.length ?? 0;
  return sample(
    { type: 'values', origin: ORIGIN, paths, count, first, faults, names: {} },
    new Uint8Array(new Float64Array(columns.flat()).buffer),
  );
}

function follower() {
  const batches: FieldBatch[] = [];
  const faults: string[] = [];
  return {
    batches,
    faults,
    take: (batch: FieldBatch) => void batches.push(batch),
    fail: (reason: string) => void faults.push(reason),
  };
}

test('each path is handed its own values, with the stamps of all', () => {
  const channels = new Channels();
  const [x, y] = [follower(), follower()];
  channels.plot('/odom', 'x', x);
  channels.plot('/odom', 'y', y);
  assert.deepEqual(channels.fields, { '/odom': ['x', 'y'] });
  const columns = [[1, 2], [0.5, 0.25], [7, Number.NaN], [9, 9]];
  assert.equal(channels.take(values(['x', 'y', 'of another page'], columns)), true);
  assert.deepEqual([...(x.batches[0]?.stamps ?? [])], [1, 2]);
  assert.deepEqual([...(x.batches[0]?.values ?? [])], [0.5, 0.25]);
  assert.deepEqual([...(y.batches[0]?.values ?? [])], [7, Number.NaN]);
  assert.equal(x.batches[0]?.rate, 100);
});

test('messages that never came are counted', () => {
  const channels = new Channels();
  const x = follower();
  channels.plot('/odom', 'x', x);
  channels.take(values(['x'], [[1, 2], [0, 0]], 10));
  channels.take(values(['x'], [[3], [0]], 12));
  channels.take(values(['x'], [[9], [0]], 18));
  channels.forget(); // another node, which counts from 0
  channels.take(values(['x'], [[9], [0]], 3));
  assert.deepEqual(x.batches.map(({ lost }) => lost), [0, 0, 5, 0]);
});

test('what is not wished any more is not asked for, and goes nowhere', () => {
  const channels = new Channels();
  const [one, two] = [follower(), follower()];
  const ends = [channels.plot('/odom', 'x', one), channels.plot('/odom', 'x', two)];
  ends[0]?.();
  channels.take(values(['x'], [[1], [1]]));
  assert.deepEqual([one.batches.length, two.batches.length], [0, 1]);
  ends[1]?.();
  ends[1]?.();
  assert.deepEqual(channels.fields, {});
  assert.equal(channels.take(values(['x'], [[1], [1]])), true);
  const end = channels.follow('/odom', { take: () => {}, fail: () => {} });
  assert.deepEqual(channels.messages, ['/odom']);
  end();
  assert.deepEqual(channels.messages, []);
});

test('a path that leads nowhere says why, and so does a topic', () => {
  const channels = new Channels();
  const [x, y] = [follower(), follower()];
  channels.plot('/odom', 'x', x);
  channels.plot('/odom', 'y', y);
  channels.take(values(['x', 'y'], [[1], [1], [Number.NaN]], 0, { y: 'no y' }));
  assert.deepEqual([x.batches.length, x.faults, y.batches.length, y.faults], [1, [], 0, ['no y']]);
  const unreadable: Head = {
    type: 'unreadable', origin: ORIGIN, text: 'no package', channel: 'values',
  };
  channels.take(sample(unreadable, new Uint8Array()));
  assert.deepEqual(x.faults, ['no package']);
  const ofSensor: Head = { ...unreadable, channel: 'sensor' };
  assert.equal(channels.take(sample(ofSensor, new Uint8Array())), false);
});

test('a message is handed over whole', () => {
  const channels = new Channels();
  const came: TopicMessage[] = [];
  channels.follow('/odom', { take: (each) => void came.push(each), fail: () => {} });
  const head: Head = { type: 'message', origin: ORIGIN, message: 'a/msg/B', size: 12 };
  const text = '{"name":"ü","x":[1,{"#number":"NaN"}]}';
  channels.take(sample(head, new TextEncoder().encode(text)));
  assert.deepEqual(came, [{ head, tree: JSON.parse(text) as unknown }]);
});

test('what is broken is refused', () => {
  const channels = new Channels();
  channels.plot('/odom', 'x', follower());
  channels.follow('/odom', { take: () => {}, fail: () => {} });
  const short = sample(
    { type: 'values', origin: ORIGIN, paths: ['x'], count: 2, first: 0, faults: {}, names: {} },
    new Uint8Array(24),
  );
  assert.throws(() => channels.take(short), BadState);
  const head: Head = { type: 'message', origin: ORIGIN, message: 'a/msg/B', size: 1 };
  assert.throws(() => channels.take(sample(head, new Uint8Array([123]))), BadState);
});
