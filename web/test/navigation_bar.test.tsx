// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { connectedApp, drawn, graphOf, robotInfo, texts, type TestApp } from './page';
import { navigationBar } from '../src/navigation/bar';
import { goalWords, mapFrameOf } from '../src/navigation/words';
import type { GoalStatus, Navigator } from '../src/protocol';

const NAVIGATOR: Navigator = {
  robot: '/', goal: '/goal_pose', action: '/navigate_to_pose', initial_pose: null,
};

function goal(known: Partial<GoalStatus> = {}): GoalStatus {
  return {
    type: 'goal', robot: '/', client: 'page 1', state: 'active', frame: 'map', x: 1, y: 2, yaw: 0, text: '',
    distance: null, time: null, recoveries: 0, ...known,
  };
}

function page(...navigators: Navigator[]): { app: TestApp; element: HTMLElement } {
  const app = connectedApp();
  app.say(graphOf([robotInfo()], { navigators }));
  return { app, element: navigationBar(app, null) };
}

test('how far it is, how long, and how often it had to recover', () => {
  const words = (known: Partial<GoalStatus>): string => goalWords(goal(known)).text;
  assert.equal(words({ distance: 3.2, time: 8 }), '3.2 m to go, 8 s');
  assert.equal(words({ distance: 3.2 }), '3.2 m to go');
  assert.equal(words({}), 'On the way');
  assert.equal(words({ distance: 3, time: 9, recoveries: 1 }), '3.0 m to go, 9 s, 1 recovery');
  assert.equal(words({ distance: 3, recoveries: 2 }), '3.0 m to go, 2 recoveries');
});

test('how it ended, and why', () => {
  assert.deepEqual(goalWords(goal({ state: 'reached' })), { tone: 'good', text: 'Goal reached' });
  const stopped = goalWords(goal({ state: 'cancelled', text: 'STOP was pressed' }));
  assert.deepEqual(stopped, { tone: 'warning', text: 'Goal cancelled: STOP was pressed' });
  assert.deepEqual(goalWords(goal({ state: 'failed', text: 'NO_VALID_PATH' })), {
    tone: 'error', text: 'Goal failed: NO_VALID_PATH',
  });
  assert.equal(goalWords(goal({ state: 'published' })).tone, 'calm');
});

test('goals are given in the frame of the robot\'s own map, else of the one map', () => {
  const frames = (...names: string[]): { frames: { name: string; parent: string }[] } => ({
    frames: names.map((name) => ({ name, parent: 'root' })),
  });
  assert.equal(mapFrameOf(frames('map', 'odom'), '/'), 'map');
  assert.equal(mapFrameOf(frames('odom'), '/'), 'map');
  assert.equal(mapFrameOf(null, '/'), 'map');
  assert.equal(mapFrameOf(frames('map', 'robot1/map', 'robot1/odom'), '/robot1'), 'robot1/map');
  assert.equal(mapFrameOf(frames('map', 'robot1/odom'), '/robot1'), 'map');
  assert.equal(mapFrameOf(frames('robot1/odom'), '/robot1'), 'robot1/map');
  assert.equal(mapFrameOf(frames('odom'), '/robot1'), 'map');
});

test('there is nothing where nobody navigates', async () => {
  const { app, element } = page();
  await drawn();
  assert.equal(element.textContent, '');
  app.say(graphOf([robotInfo()], { navigators: [{ ...NAVIGATOR, robot: '/robot9' }] }));
  await drawn();
  assert.equal(element.textContent, '', 'another robot is navigated');
});

test('a goal is followed, and cancelled while it can be', async () => {
  const { app, element } = page(NAVIGATOR);
  app.say(goal({ distance: 3.2, time: 8 }));
  await drawn();
  assert.deepEqual(texts({ element }, 'output'), ['3.2 m to go, 8 s']);
  const cancel = element.querySelector<HTMLElement>('button');
  cancel?.click();
  const [sent] = app.sent;
  assert.ok(sent?.type === 'cancel_goal');
  assert.equal(sent.robot, '/');
  app.say(goal({ state: 'cancelled' }));
  await drawn();
  assert.deepEqual(texts({ element }, 'output'), ['Goal cancelled']);
  assert.equal(element.querySelector('button'), null);
  app.say(goal({ state: 'published' }));
  await drawn();
  assert.equal(element.querySelector('button'), null, 'what was published cannot be cancelled');
});
