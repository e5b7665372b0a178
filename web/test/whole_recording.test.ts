// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Recorder } from '../src/plots/recorder';
import { toCsv } from '../src/plots/csv';
import type { Layout, Reply, ServerMessage } from '../src/protocol';
import { seriesFeed, WholeRecording } from '../src/recording/whole';
import { stateBytes, type State } from '../src/state';
import { connectedApp, type TestApp } from './page';

const LAYOUT: Layout = { type: 'layout', id: 3, frames: [], robots: [{ id: '/', joints: [], wheels: [] }] };
const RECORDING: ServerMessage = {
  type: 'recording', name: 'drive', path: '/tmp/drive', begin: 0, length: 600, messages: 1, size: 1,
};

/** States of these times as the node sends them. */
function statesOf(times: readonly number[]): string {
  const size = stateBytes(LAYOUT);
  const bytes = new Uint8Array(size * times.length);
  for (const [index, time] of times.entries()) {
    const view = new DataView(bytes.buffer, index * size, size);
    view.setUint8(0, 1);
    view.setUint16(2, LAYOUT.id, true);
    view.setFloat64(8, time, true);
  }
  return Buffer.from(bytes).toString('base64');
}

function numbers(values: readonly number[]): string {
  return Buffer.from(new Float64Array(values).buffer).toString('base64');
}

/** Answer the last request of a type; wait until the page has taken it in. */
async function answer(app: TestApp, type: string, known: Partial<Reply>): Promise<void> {
  const asked = app.sent[app.sent.map((each): string => each.type).lastIndexOf(type)];
  assert.ok(asked !== undefined && 'id' in asked, `${type} was not asked`);
  app.say({ type: 'reply', id: asked.id, ok: true, message: '', data: null, again: null, ...known });
  await new Promise((resolve) => setTimeout(resolve));
}

const OVERVIEW = { states: statesOf([1, 2, 3]), count: 3, layout: LAYOUT.id, frames: [], robots: LAYOUT.robots };

test('the states of a whole recording come once a layout is known, whichever it is', async () => {
  const app = connectedApp();
  const taken: (readonly State[])[] = [];
  new WholeRecording(app, (states) => taken.push(states));
  app.say(RECORDING);
  await answer(app, 'overview', { data: OVERVIEW });
  assert.equal(taken.length, 0);
  const shown: Layout = { ...LAYOUT, id: 7, frames: [{ name: 'base_link', parent: 'odom' }] };
  app.say(shown);
  app.say({ ...shown }); // said again to a page that comes later
  assert.deepEqual(taken.map((states) => states.map(({ time }) => time)), [[1, 2, 3]]);
});

test('a page says why there is nothing of the whole recording', async () => {
  const app = connectedApp();
  new WholeRecording(app, () => assert.fail());
  app.say(RECORDING);
  await answer(app, 'overview', { ok: false, message: 'the bag cannot be read' });
  assert.deepEqual(
    app.store.notices.map(({ level, text }) => [level, text]),
    [['error', 'No plots and trails of the whole recording: the bag cannot be read']],
  );
});

test('a field of a recording comes whole, and is saved so', async () => {
  const app = connectedApp();
  const recorder = new Recorder(() => []);
  recorder.setSpan(600);
  const field = { topic: '/odom', path: 'x' };
  seriesFeed(app).plot('/odom', 'x', {
    take: ({ stamps, values }) => stamps.forEach((stamp, at) => recorder.take(field, stamp, values[at]!)),
    fail: (reason) => assert.fail(reason),
  });
  await answer(app, 'series', { data: { stamps: numbers([10, 300, 599]), values: numbers([1, 2.5, -4]) } });
  const series = recorder.series('/', field);
  assert.ok(series !== null);
  assert.deepEqual([series.first, series.latest], [10, 599]); // more than what is kept of a robot that runs
  assert.equal(toCsv([{ name: 'x', series }], 0, 600), 'time_s,x\r\n10,1\r\n300,2.5\r\n599,-4\r\n');
});

test('why there are no numbers is said; what is wished no more is dropped', async () => {
  const app = connectedApp();
  const said: string[] = [];
  const follower = { take: () => assert.fail(), fail: (reason: string) => void said.push(reason) };
  const end = seriesFeed(app).plot('/odom', 'y', follower);
  await answer(app, 'series', { ok: false, message: 'no such field' });
  end();
  seriesFeed(app).plot('/odom', 'z', follower)();
  await answer(app, 'series', { ok: false, message: 'too late' });
  assert.deepEqual(said, ['no such field']);
});
