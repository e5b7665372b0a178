// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { handsOf } from '../src/hands';
import { connectedApp, graphOf, robotInfo, type TestApp } from './page';

const FORCE: [number, number, number] = [10, 0, 0];
const NONE: [number, number, number] = [0, 0, 0];

/** Robots of one kind, as the node knows them: the name of the URDF says nothing. */
function simulating(...entities: [id: string, name: string | null][]): TestApp {
  const app = connectedApp();
  const robots = entities.map(([id, name]) =>
    robotInfo({ id, name: 'amr', entity: name === null ? null : { simulator: '/second', name } }),
  );
  const names = ['amr', 'robot1', 'robot2'];
  const simulators = ['/first', '/second'].map((id) => ({ id, entities: names, world: '', worlds: [] }));
  app.say(graphOf(robots, { simulators }));
  return app;
}

test('what is grasped moves, whatever the names', () => {
  const app = simulating(['/', 'amr'], ['/robot1', 'robot2'], ['/robot2', 'robot1']);
  const hands = handsOf(app)!;
  hands.push('/robot1', 'base_link', FORCE, NONE);
  assert.deepEqual(app.sent.at(-1), {
    type: 'push', simulator: '/second', entity: 'robot2', link: 'base_link', force: FORCE, torque: NONE,
  });
  void hands.place('/robot2', [1, 2, 0], 0.5);
  assert.deepEqual(app.sent.at(-1), {
    type: 'place', id: 1, simulator: '/second', name: 'robot1', position: [1, 2, 0], yaw: 0.5,
  });
});

test('nothing moves where the node cannot tell what is grasped', async () => {
  const app = simulating(['/', null], ['/robot1', null]);
  const hands = handsOf(app)!;
  for (const robot of ['/', '/robot1', '/amr']) {
    hands.push(robot, 'base_link', FORCE, NONE);
    await hands.place(robot, NONE, 0);
  }
  assert.deepEqual(app.sent, []);
});

test('a robot that was put into something is told as a warning', async () => {
  const app = simulating(['/', 'amr']);
  for (const [id, data, message] of [[1, false, 'it stands'], [2, true, "'amr' was put inside 'shelf'"]] as const) {
    const placed = handsOf(app)!.place('/', NONE, 0);
    app.say({ type: 'reply', id, ok: true, message, data, again: null });
    await placed;
  }
  const notices = app.store.notices.map(({ level, text }) => [level, text]);
  assert.deepEqual(notices, [['warning', "'amr' was put inside 'shelf'"]]);
});
