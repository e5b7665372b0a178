// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { controlPanel } from '../src/panels/control';
import type { RobotInfo } from '../src/protocol';
import { connectedApp, drawn, texts, type TestApp } from './page';

const ROBOT: RobotInfo = {
  id: '/', name: 'amr', present: true, command: null, odometry: null, truth: null, wheels: null,
  joint_states: null, joint_publisher: null, manager: '/controller_manager', entity: null,
};

function withControllers(): TestApp {
  const app = connectedApp();
  app.say({ type: 'graph', robots: [ROBOT], simulators: [], hint: null, sensors: [], navigators: [] });
  return app;
}

function say(app: TestApp, state: string): void {
  app.say({
    type: 'controllers',
    robot: '/',
    controllers: [{ name: 'wheels', kind: 'd/DiffDriveController', state, claims: ['a/velocity'], moves: [] }],
    hardware: [{ name: 'RobotSystem', kind: 'm/MujocoSystem', state: 'active' }],
  });
}

test('without a controller manager the panel says so', () => {
  const panel = controlPanel(withControllers());
  assert.deepEqual(texts(panel, '.empty'), ['No controller manager runs for this robot.']);
});

test('each controller is there with its state, and its switch asks for the other one', async () => {
  const app = withControllers();
  const panel = controlPanel(app);
  say(app, 'active');
  await drawn();
  assert.deepEqual(texts(panel, '.unit-name'), ['wheels', 'RobotSystem']);
  assert.deepEqual(texts(panel, '.chip'), ['active', 'active']);
  const knob = panel.element.querySelector('[role=switch]') as HTMLButtonElement;
  assert.equal(knob.getAttribute('aria-checked'), 'true');
  knob.click();
  await drawn();
  assert.deepEqual(app.sent.at(-1), {
    type: 'switch', id: 1, robot: '/', activate: [], deactivate: ['wheels'],
  });
  assert.equal(knob.disabled, true, 'until there is an answer');
  app.say({ type: 'reply', id: 1, ok: true, message: 'done', data: null, again: null });
  say(app, 'inactive');
  await drawn();
  assert.deepEqual(texts(panel, '.chip'), ['inactive', 'active']);
  assert.equal(panel.element.querySelector('[role=switch]'), knob, 'the focus stays on it');
  assert.equal(knob.getAttribute('aria-checked'), 'false');
  assert.equal(knob.disabled, false);
});

test('what is neither active nor inactive cannot be switched', async () => {
  const app = withControllers();
  const panel = controlPanel(app);
  say(app, 'unconfigured');
  await drawn();
  assert.equal((panel.element.querySelector('[role=switch]') as HTMLButtonElement).disabled, true);
});
