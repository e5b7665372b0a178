// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { healthToLookAt, healthPanel } from '../src/panels/health';
import type { DiagnosticItem, FindingInfo, Layout } from '../src/protocol';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

function connected(): TestApp {
  const app = connectedApp();
  app.say(graphOf([robotInfo()]));
  return app;
}

function say(app: TestApp, ...items: DiagnosticItem[]): void {
  app.say({ type: 'diagnostics', robot: '/', items });
}

const WELL: DiagnosticItem = { level: 'ok', name: 'battery', message: 'full' };

test('diagnostics are there, the worst first, and those that are not well are counted', async () => {
  const app = connected();
  const panel = healthPanel(app);
  assert.deepEqual(texts(panel, '.empty'), ['Examining …', 'Nobody publishes /diagnostics.', 'None.']);
  say(app, WELL, { level: 'error', name: 'loop', message: 'late' }, { level: 'warn', name: 'wheel', message: '' });
  await drawn();
  assert.deepEqual(texts(panel, '.unit-name'), ['loop', 'wheel', 'battery']);
  assert.deepEqual(texts(panel, '.chip'), ['error', 'warn', 'ok']);
  assert.equal(find(panel, '.chip').dataset.tone, 'error');
  assert.deepEqual(healthToLookAt(app.store), { count: 2, tone: 'error' });
});

test('what says the same is said once', async () => {
  const app = connected();
  const panel = healthPanel(app);
  const late = (name: string): DiagnosticItem => ({ level: 'warn', name, message: 'late' });
  say(app, WELL, late('controllers'), { level: 'warn', name: 'wheel', message: '' }, late('hardware'), { ...WELL, name: 'arm' });
  await drawn();
  assert.deepEqual(texts(panel, '.unit-name'), ['controllers, hardware', 'wheel', 'battery', 'arm']);
  assert.equal(healthToLookAt(app.store).count, 3);
});

test('errors that the doctor finds are counted, warnings are not', () => {
  const app = connected();
  const [what, why, fix, rule] = ['seen', 'bad', 'mend', 'rule'];
  const of = (severity: 'error' | 'warning'): FindingInfo => ({ severity, rule, what, why, fix });
  app.say({ type: 'findings', items: [of('warning')] });
  assert.deepEqual(healthToLookAt(app.store), { count: 0, tone: 'warning' });
  say(app, { level: 'warn', name: 'wheel', message: '' });
  app.say({ type: 'findings', items: [of('error'), of('error'), of('warning')] });
  assert.deepEqual(healthToLookAt(app.store), { count: 3, tone: 'error' });
});

test('a late loop is an alarm on a machine, and a note in a simulation', async () => {
  const app = connected();
  const panel = healthPanel(app);
  const message = '\nHigh execution jitter or mean error : [ diff_drive_controller ]';
  const late: DiagnosticItem = { level: 'error', name: 'loop', message };
  const weak: DiagnosticItem = { level: 'warn', name: 'battery', message: 'Low voltage' };
  say(app, late, weak);
  await drawn();
  assert.deepEqual(texts(panel, '.chip'), ['error', 'warn']);
  assert.deepEqual(healthToLookAt(app.store), { count: 2, tone: 'error' });
  const simulators = [{ id: '/sim', entities: ['amr'], world: '', worlds: [] }];
  app.say(graphOf([robotInfo({ entity: { simulator: '/sim', name: 'amr' } })], { simulators }));
  await drawn();
  assert.deepEqual(texts(panel, '.chip'), ['warn', 'note']);
  assert.match(texts(panel, '.unit .fine')[1]!, /^The control loop takes uneven time .*\(High execution/);
  assert.deepEqual(healthToLookAt(app.store), { count: 1, tone: 'warning' });
  say(app, { ...late, message: `${message}; Hardware is lost` });
  assert.deepEqual(healthToLookAt(app.store), { count: 1, tone: 'error' });
});

test('a text stays the same node while diagnostics come, so that it can be selected and copied', async () => {
  const app = connected();
  const panel = healthPanel(app);
  const loop: DiagnosticItem = { level: 'warn', name: 'loop', message: 'late by 3 ms' };
  say(app, loop, WELL);
  await drawn();
  const text = find(panel, '.unit .fine').firstChild;
  assert.ok(text);
  const selection = getSelection();
  selection?.selectAllChildren(find(panel, '.unit .fine'));
  for (const message of ['90 %', '80 %']) {
    say(app, loop, { ...WELL, message });
    await drawn();
  }
  assert.deepEqual(texts(panel, '.unit .fine'), ['late by 3 ms', '80 %']);
  assert.equal(find(panel, '.unit .fine').firstChild, text);
  assert.equal(String(selection), 'late by 3 ms');
});

test('wheels are shown as they are on the ground, and not at all where there are none', async () => {
  const app = connected();
  const panel = healthPanel(app);
  const layout: Layout = {
    type: 'layout', id: 1, frames: [],
    robots: [{ id: '/', joints: ['joint_wheel_left'], wheels: ['joint_wheel_left'] }],
  };
  panel.pulse?.(unknownState({ ...layout, robots: [{ id: '/', joints: [], wheels: [] }] }));
  await drawn();
  assert.equal(panel.element.querySelector('table'), null);
  const state = unknownState(layout);
  state.robots[0]!.velocities[0] = 4;
  state.robots[0]!.wheels.set([1, 33.06, -0.125]);
  panel.pulse?.(state);
  await drawn();
  assert.deepEqual(texts(panel, 'tbody th'), ['left']);
  assert.deepEqual(texts(panel, 'td'), ['4.00', '33.1', '−0.125', '–']);
  assert.equal(find(panel, 'tbody i').title, 'on the ground');
});

test('notices are listed, the latest first, equal ones counted, until they are cleared', async () => {
  const app = connected();
  const panel = healthPanel(app);
  for (const text of ['one', 'two', 'two']) {
    app.say({ type: 'notice', level: 'warning', text });
  }
  await drawn();
  assert.deepEqual(texts(panel, '.notices .grow'), ['two (2 times)', 'one']);
  find(panel, 'button').click();
  await drawn();
  assert.deepEqual(texts(panel, '.notices li'), ['None.']);
  assert.equal(panel.element.querySelector('button'), null, 'there is nothing to clear');
});

test('findings have what was seen, why it matters, and a fix to copy; none are healthy', async () => {
  const app = connected();
  const panel = healthPanel(app);
  Object.defineProperty(globalThis, 'navigator', { value: {}, configurable: true }); // no clipboard
  const [rule, what, why] = ['two_clocks', '/clock has two publishers', 'time jumps'];
  app.say({ type: 'findings', items: [{ severity: 'error', rule, what, why, fix: '`ros2 node list`' }] });
  await drawn();
  assert.deepEqual(texts(panel, '.doctor .unit-name'), [what]);
  assert.deepEqual(texts(panel, '.doctor .fine'), [why]);
  assert.deepEqual(texts(panel, '.doctor code'), ['ros2 node list']);
  assert.equal(find(panel, '.doctor .chip').dataset.tone, 'error');
  app.say({ type: 'findings', items: [] });
  await drawn();
  assert.match(texts(panel, '.empty')[0]!, /^Nothing is wrong/);
});
