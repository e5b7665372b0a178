// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Graph, Hello, RobotInfo } from '../src/protocol';
import { Store } from '../src/store';

const HELLO: Hello = {
  type: 'hello', client: 'page 1', version: '1.0', domain: 0, rate: 60, drive_timeout: 0.4,
};

function robot(id: string): RobotInfo {
  return {
    id, name: 'amr', present: true, command: null, odometry: null, truth: null, wheels: null,
    joint_states: null, joint_publisher: null, manager: null, entity: null,
  };
}

function graph(...ids: string[]): Graph {
  return { type: 'graph', robots: ids.map(robot), simulators: [], hint: null, sensors: [], navigators: [] };
}

function connected(...ids: string[]): Store {
  const store = new Store();
  store.take(HELLO);
  store.take(graph(...ids));
  return store;
}

test('the first robot is the one, until another is chosen, and again when that goes', () => {
  const store = connected('/', '/robot1');
  assert.equal(store.robot?.id, '/');
  store.choose('/robot1');
  assert.equal(store.robot?.id, '/robot1');
  store.take(graph('/'));
  assert.equal(store.robot?.id, '/');
  store.take(graph());
  assert.equal(store.robot, null);
});

test('of several robots, one that can be driven is the first choice', () => {
  const store = new Store();
  store.take(HELLO);
  const command = { topic: '/robot1/cmd_vel', message: 'geometry_msgs/msg/TwistStamped' };
  const robots = [robot('/fleet'), { ...robot('/robot1'), command }];
  store.take({ ...graph(), robots });
  assert.equal(store.robot?.id, '/robot1');
  store.choose('/fleet');
  assert.equal(store.robot?.id, '/fleet');
});

test('a robot that is only described is not offered, but another can be made like it', () => {
  const store = connected();
  const fleet = { ...robot('/fleet'), present: false };
  const deleted = { ...robot('/'), present: false };
  store.take({ ...graph(), robots: [fleet, deleted, robot('/robot1')] });
  assert.deepEqual(store.robots.map(({ id }) => id), ['/robot1']);
  store.choose('/');
  assert.equal(store.robot?.id, '/robot1');
  store.select({ robot: '/robot1', frame: 'base_link' });
  store.take({ ...graph(), robots: [fleet, deleted] });
  assert.equal(store.robot, null);
  assert.equal(store.selection, null);
  assert.equal(store.pattern, null, 'its description has not come');
  const described = { root: 'a', meshes: {}, joints: [], findings: [] };
  store.take({ type: 'model', robot: '/fleet', urdf: '<robot><link name="a"/></robot>', ...described });
  assert.equal(store.pattern, null, 'a tree of frames is no robot');
  store.take({ type: 'model', robot: '/', urdf: '<robot><visual/></robot>', ...described });
  assert.equal((store.pattern as RobotInfo | null)?.id, '/');
});

test('what belongs to a robot goes with it', () => {
  const store = connected('/', '/robot1');
  store.take({ type: 'driver', robot: '/robot1', client: 'page 2', stopped: null });
  store.take({ type: 'diagnostics', robot: '/robot1', items: [] });
  store.select({ robot: '/robot1', frame: 'base_link' });
  store.take(graph('/'));
  assert.equal(store.drivers.size + store.diagnostics.size, 0);
  assert.equal(store.selection, null);
});

test('who drives is told from who looks', () => {
  const store = connected('/');
  assert.equal(store.driver, null);
  store.take({ type: 'driver', robot: '/', client: 'page 2', stopped: null });
  assert.deepEqual(store.driver, { me: false, name: 'page 2' });
  store.take({ type: 'driver', robot: '/', client: 'page 1', stopped: null });
  assert.deepEqual(store.driver, { me: true, name: 'page 1' });
  store.take({ type: 'driver', robot: '/', client: null, stopped: null });
  assert.equal(store.driver, null);
});

test('a node that starts anew makes all that an older one said void', () => {
  const store = connected('/');
  store.take({ type: 'layout', id: 7, frames: [], robots: [] });
  store.take({ ...HELLO, client: 'page 9' });
  assert.equal(store.layout, null);
  assert.equal(store.robot, null);
  assert.equal(store.notices.length, 0);
  store.take({ ...HELLO, version: '1.1' });
  assert.match(store.notices[0]!.text, /1\.0 → 1\.1.*reload/);
});

test('a listener hears its topics, at first and on each change', () => {
  const store = new Store();
  let calls = 0;
  store.watch(['graph', 'robot'], () => {
    calls += 1;
  });
  assert.equal(calls, 1);
  store.take(graph('/'));
  store.choose('/');
  store.note('info', 'x');
  assert.equal(calls, 3);
});

test('a controller that would hear commands but does not run is found by its topic', () => {
  const store = new Store();
  store.take(HELLO);
  const command = { topic: '/robot1/diff_drive_controller/cmd_vel', message: 'x/msg/Twist' };
  store.take({ ...graph(), robots: [{ ...robot('/robot1'), command }] });
  const say = (state: string): void =>
    store.take({
      type: 'controllers',
      robot: '/robot1',
      controllers: [{ name: 'diff_drive_controller', kind: 'k', state, claims: [], moves: [] }],
      hardware: [],
    });
  const deaf = (): string | undefined => store.deafController?.state;
  assert.equal(deaf(), undefined, 'nobody says');
  say('inactive');
  assert.equal(deaf(), 'inactive');
  say('active');
  assert.equal(deaf(), undefined);
});

test('active controllers tell which joints can be moved, and whether it goes sideways', () => {
  const store = connected('/');
  assert.equal(store.movedJoints.size, 0);
  const of = (name: string, kind: string, state: string, moves: string[]) => ({
    name, kind, state, claims: [], moves,
  });
  const tell = (...controllers: ReturnType<typeof of>[]): void =>
    store.take({ type: 'controllers', robot: '/', controllers, hardware: [] });
  tell(of('arm', 'a/JointTrajectoryController', 'active', ['a', 'b']), of('wheels', 'm/MecanumDriveController', 'inactive', []));
  assert.deepEqual([...store.movedJoints], [['a', 'arm'], ['b', 'arm']]);
  assert.equal(store.goesSideways, false);
  tell(of('wheels', 'm/MecanumDriveController', 'active', []));
  assert.equal(store.goesSideways, true);
});

test('notices that repeat are counted, and only the latest are kept', () => {
  const store = new Store();
  store.note('info', 'same');
  store.note('info', 'same');
  assert.deepEqual(store.notices.map((notice) => notice.count), [2]);
  for (let number = 0; number < 200; number += 1) {
    store.note('warning', `notice ${number}`);
  }
  assert.equal(store.notices.length, 50);
  assert.equal(store.notices[0]!.text, 'notice 199');
});

test('a refusal becomes a notice, a yes does not', () => {
  const store = new Store();
  store.take({ type: 'reply', id: 0, ok: true, message: 'yes', data: null, again: null });
  store.take({ type: 'reply', id: 0, ok: false, message: 'page 2 drives', data: null, again: null });
  assert.deepEqual(store.notices.map((notice) => notice.text), ['page 2 drives']);
});
