// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { acceptUrdf, takeDropped } from '../src/drop';
import { connectedApp, graphOf, robotInfo, type TestApp } from './page';

function dropped(text: string, entities: string[] | null): { app: TestApp; done: Promise<void> } {
  const app = connectedApp();
  const simulators = entities === null ? [] : [{ id: '/sim', entities, world: '', worlds: [] }];
  app.say({ type: 'graph', robots: [], simulators, hint: null, sensors: [], navigators: [] });
  return { app, done: takeDropped(app, new File([text], 'arm.urdf'), [1, 2, 0.2]) };
}

test('a URDF that is dropped stands in the world, under a name that is free', async () => {
  const urdf = '<?xml version="1.0"?>\n<robot name="my arm">…</robot>';
  const { app } = dropped(urdf, ['my_arm']);
  await new Promise((resolve) => setTimeout(resolve));
  assert.deepEqual(app.sent, [
    {
      type: 'spawn', id: 1, simulator: '/sim', name: 'my_arm1', namespace: '/my_arm1',
      position: [1, 2, 0.2], yaw: 0, like: null, urdf, fixed: false,
    },
  ]);
});

test('with Shift held it is fixed to the world where it was dropped', async () => {
  const app = connectedApp();
  const simulators = [{ id: '/sim', entities: [], world: '', worlds: [] }];
  app.say({ type: 'graph', robots: [], simulators, hint: null, sensors: [], navigators: [] });
  const element = document.createElement('div');
  acceptUrdf(app, element, () => [3, 4, 0], () => []);
  for (const shiftKey of [true, false]) {
    const drop = Object.assign(new Event('drop', { cancelable: true }), {
      shiftKey, dataTransfer: { files: [new File(['<robot name="arm"/>'], 'arm.urdf')] },
    });
    element.dispatchEvent(drop);
  }
  await new Promise((resolve) => setTimeout(resolve));
  const places = app.sent.map((each) => each.type === 'spawn' && [each.fixed, each.position]);
  assert.deepEqual(places, [[true, [3, 4, 0]], [false, [3, 4, 0.2]]]);
});

test('a name that no robot can have becomes one', async () => {
  for (const [name, taken] of [['7 of 9', 'robot7_of_9'], ['', 'robot']] as const) {
    const { app } = dropped(`<robot name="${name}"/>`, []);
    await new Promise((resolve) => setTimeout(resolve));
    assert.equal((app.sent[0] as { name: string }).name, taken);
  }
});

test('what is no URDF is refused in a line that says what would do', async () => {
  const cases: [string, string[] | null, RegExp][] = [
    [' '.repeat(1e6), [], /1000000 bytes are more than 900000/],
    ['hello', [], /^arm\.urdf: it is no URDF: there is no <robot>/],
    ['<robot xmlns:xacro="http://ros.org/wiki/xacro">', [], /it is xacro; `ros2 run xacro xacro/],
    ['<robot name="a"/>', null, /nothing simulates here.*scripts\/run display take it/],
  ];
  for (const [text, entities, said] of cases) {
    const { app, done } = dropped(text, entities);
    await done;
    assert.deepEqual(app.sent, []);
    assert.match(app.store.notices[0]!.text, said);
  }
});

test('nothing is dropped into what stands there', async () => {
  const app = connectedApp();
  const simulators = [{ id: '/sim', entities: ['amr'], world: '', worlds: [] }];
  app.say({ type: 'graph', robots: [], simulators, hint: null, sensors: [], navigators: [] });
  const file = new File(['<robot name="arm"/>'], 'arm.urdf');
  const amr = { id: '/', x: 1, y: 2, yaw: 0, radius: 0.4 };
  await takeDropped(app, file, [1.2, 2, 0.2], [amr]);
  assert.deepEqual(app.sent, []);
  assert.match(app.store.notices[0]!.text, /^arm\.urdf: something stands there; drop it where there is room/);
  void takeDropped(app, file, [1.6, 2, 0.2], [amr]);
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(app.sent.length, 1);
});

test('where a description is only looked at, the file takes its place', async () => {
  const app = connectedApp();
  app.say(graphOf([robotInfo({ joint_publisher: '/joint_state_publisher' })]));
  const urdf = '<robot name="arm"/>';
  void takeDropped(app, new File([urdf], 'arm.urdf'), [0, 0, 0]);
  await new Promise((resolve) => setTimeout(resolve));
  assert.deepEqual(app.sent, [
    {
      type: 'set_parameter', id: 1, node: '/robot_state_publisher', name: 'robot_description',
      kind: 'string', value: urdf,
    },
  ]);
});
