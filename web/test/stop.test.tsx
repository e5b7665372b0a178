// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import test from 'node:test';
import { connectedApp, drawn, graphOf, robotInfo, type TestApp } from './page';
import { stopElement } from '../src/drive/stop';
import { stopWords, whoDrives } from '../src/drive/words';
import type { HeldRobot } from '../src/protocol';

const SINCE = 1_700_000_000;

function page(...ids: string[]): TestApp {
  const app = connectedApp();
  app.say({ type: 'hello', client: 'page 1', version: '1', domain: 0, rate: 60, drive_timeout: 0.4 });
  app.say(graphOf(ids.map((id) => robotInfo({ id, command: { topic: '/cmd_vel', message: 'x' } }))));
  return app;
}

function held(known: Partial<HeldRobot> = {}): HeldRobot {
  return {
    robot: '/', client: 'page 2', since: SINCE, state: 'holds', is_locked: true, controllers: [], deactivated: [], ...known,
  };
}

function stop(app: TestApp, ...robots: HeldRobot[]): void {
  app.say({ type: 'emergency_stop', client: 'page 2', since: SINCE, robots });
}

function commanded(app: TestApp, rate: number, ...nodes: string[]): void {
  app.say({ type: 'commanders', robot: '/', nodes, rate });
}

function word(app: TestApp): string {
  return stopWords(app.store)?.text ?? '';
}

function press(element: HTMLElement, selector: string): void {
  const found = element.querySelector<HTMLElement>(selector);
  assert.ok(found, `there is no ${selector} in ${element.innerHTML}`);
  found.click();
}

test('nobody drives when nobody does, and others are named with their rate', () => {
  assert.equal(whoDrives(page().store).text, 'No robot');
  const app = page('/');
  assert.deepEqual(whoDrives(app.store), { tone: 'calm', text: 'Nobody drives' });
  commanded(app, 0, '/planner');
  assert.equal(whoDrives(app.store).text, 'Nobody drives');
  commanded(app, 10, '/planner');
  assert.deepEqual(whoDrives(app.store), { tone: 'warning', text: '/planner drives, 10 Hz' });
  assert.equal(app.store.isDriven, true);
  commanded(app, 30, '/planner', '/teleop');
  assert.equal(whoDrives(app.store).text, '/planner, /teleop drive, 30 Hz');
  app.say({ type: 'driver', robot: '/', client: 'page 1', stopped: null });
  assert.equal(whoDrives(app.store).text, 'You drive');
});

test('nobody is said to drive while nothing is known', () => {
  const app = page('/');
  app.store.setSilence('No data for 3 s');
  assert.deepEqual(whoDrives(app.store), { tone: 'error', text: 'No data for 3 s' });
  app.store.setSilence('');
  app.store.setLink({ state: 'waiting', attempt: 1, reason: '' });
  assert.equal(whoDrives(app.store).text, 'Not connected');
});

test('why the connection was lost is said until it is there again', () => {
  const { store } = page('/');
  store.setLink({ state: 'waiting', attempt: 1, reason: 'the viewer has ended' });
  store.setLink({ state: 'waiting', attempt: 2, reason: 'no worker' });
  assert.deepEqual(store.link, { state: 'waiting', attempt: 2, reason: 'the viewer has ended' });
});

test('driving while time stands still is said', () => {
  const app = page('/');
  app.say(graphOf([robotInfo()], { simulators: [{ id: '/sim', entities: [], world: '', worlds: [] }] }));
  app.say({ type: 'simulation', simulator: '/sim', state: 'paused', time: 1, factor: 1, real_factor: null });
  app.say({ type: 'driver', robot: '/', client: 'page 1', stopped: null });
  assert.equal(whoDrives(app.store).text, 'You drive, but time stands still');
});

test('a controller that is not active is said in place of who drives by it', () => {
  const app = page('/');
  const kind = 'diff_drive_controller/DiffDriveController';
  const drive = { name: 'diff_drive_controller', kind, state: 'inactive', claims: [], moves: [] };
  const command = { topic: '/diff_drive_controller/cmd_vel', message: 'geometry_msgs/msg/TwistStamped' };
  app.say(graphOf([robotInfo({ command })]));
  app.say({ type: 'controllers', robot: '/', controllers: [drive], hardware: [] });
  assert.deepEqual(whoDrives(app.store), { tone: 'warning', text: 'diff_drive_controller is inactive' });
  commanded(app, 10, '/planner');
  assert.equal(whoDrives(app.store).text, '/planner commands, 10 Hz');
  app.say({ type: 'driver', robot: '/', client: 'page 1', stopped: null });
  const text = 'You drive, but diff_drive_controller is inactive';
  assert.deepEqual(whoDrives(app.store), { tone: 'warning', text });
});

test('a stop says whether it holds, who pressed it and who commands all the same', () => {
  const app = page('/');
  assert.equal(stopWords(app.store), null);
  stop(app, held());
  assert.match(word(app), /^Stands still\. Stopped by page 2 at \d\d:\d\d:\d\d\.$/);
  commanded(app, 10, '/planner');
  assert.match(word(app), /^Stands still\. Still commanded by \/planner, 10 Hz\./);
  stop(app, held({ state: 'moves' }));
  assert.match(word(app), /^still moves: driven by \/planner, 10 Hz\. Stopped by page 2/);
  assert.equal(stopWords(app.store)?.tone, 'error');
  stop(app, held({ state: 'unknown' }));
  assert.match(word(app), /nothing measures whether it stands/);
  stop(app);
  assert.match(word(app), /No robot is there/);
});

test('of several robots the one that moves is said', () => {
  const app = page('/r1', '/r2');
  stop(app, held({ robot: '/r1' }), held({ robot: '/r2', state: 'moves' }));
  assert.match(word(app), /^r2 still moves/);
});

test('STOP is pressed, held and released by the same place', async () => {
  const app = page('/');
  const element = stopElement(app);
  assert.deepEqual([...element.querySelectorAll('button')].map((each) => each.textContent), ['STOPSpaceEsc']);
  stop(app, held());
  await drawn();
  assert.match(element.querySelector('.stop')?.textContent ?? '', /^STOPPED/);
  press(element, '.release');
  assert.deepEqual(app.sent, [{ type: 'release', robot: null }]);
});

test('a robot that still moves can have its controller deactivated', async () => {
  const app = page('/');
  const element = stopElement(app);
  stop(app, held({ state: 'moves', controllers: ['diff_drive_controller'] }));
  await drawn();
  press(element, '.danger');
  assert.deepEqual(app.sent, [{ type: 'deactivate_drive', robot: '/', id: 1 }]);
  stop(app, held({ deactivated: ['diff_drive_controller'] }));
  await drawn();
  assert.equal(element.querySelector('.danger'), null);
});

test('without a connection STOP is there, and says that it cannot reach the node, and why', async () => {
  const app = page('/');
  const element = stopElement(app);
  app.store.setLink({ state: 'waiting', attempt: 1, reason: 'the viewer has ended' });
  await drawn();
  assert.ok(element.querySelector('.stop'));
  assert.match(element.textContent, /No connection to the node: the viewer has ended\. STOP cannot reach it/);
});

test('a new connection begins without a stop, until the node says otherwise', () => {
  const app = page('/');
  stop(app, held());
  assert.equal(app.store.isStopped, true);
  app.say({ type: 'hello', client: 'page 9', version: '1', domain: 0, rate: 60, drive_timeout: 0.4 });
  assert.equal(app.store.isStopped, false);
});
