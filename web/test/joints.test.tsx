// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Panel } from '../src/app';
import { jointsPanel } from '../src/panels/joints';
import type { JointInfo, RobotInfo } from '../src/protocol';
import type { State } from '../src/state';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

const ARM: JointInfo = { name: 'arm', kind: 'revolute', lower: -1, upper: 2, zero: 0.5, follows: null };
const LIFT: JointInfo = { name: 'lift', kind: 'prismatic', lower: 0, upper: 0.4, zero: 0, follows: null };
const FINGER: JointInfo = { ...ARM, name: 'finger', follows: 'arm' };

function shown(joints: JointInfo[], known: Partial<RobotInfo> = {}): { app: TestApp; panel: Panel } {
  const app = connectedApp();
  app.say(graphOf([robotInfo({ joint_states: '/joint_states', ...known })]));
  app.say({ type: 'model', robot: '/', urdf: '', root: 'base', meshes: {}, joints, findings: [] });
  return { app, panel: jointsPanel(app) };
}

/** A state with these positions. */
function at(positions: Record<string, number>): State {
  const joints = Object.keys(positions);
  const state = unknownState({
    type: 'layout', id: 1, frames: [], robots: [{ id: '/', joints, wheels: [] }],
  });
  state.robots[0]!.positions.set(Object.values(positions));
  return state;
}

function slider(panel: Panel): HTMLInputElement {
  return find(panel, 'input[type=range]') as HTMLInputElement;
}

function field(panel: Panel): HTMLInputElement {
  return find(panel, 'input[type=number]') as HTMLInputElement;
}

function enter(input: HTMLInputElement, value: string, ...kinds: string[]): void {
  input.value = value;
  kinds.forEach((kind) => input.dispatchEvent(new Event(kind)));
}

/** Wait until the page has sent something, as it does with a frame of the screen. */
async function sent(app: TestApp, count: number): Promise<unknown> {
  while (app.sent.length < count) {
    await drawn();
  }
  return app.sent.at(-1);
}

test('a robot without joints says so', () => {
  assert.deepEqual(texts(shown([]).panel, '.empty'), ['No joint moves.']);
});

test('what nobody can move is shown as measured, with unit and limits', async () => {
  const { panel } = shown([ARM, LIFT]);
  const state = at({ arm: Math.PI / 2, lift: 0.125 });
  state.robots[0]!.velocities.set([0.5]);
  panel.pulse?.(state);
  await drawn();
  assert.deepEqual(texts(panel, '.value'), ['1.571 rad', '0.125 m']);
  assert.deepEqual(texts(panel, '.joint > .fine'), [
    '90.0°  0.50 rad/s', '−1.00 … 2.00 rad', '', '0.000 … 0.400 m',
  ]);
  assert.match(texts(panel, 'p')[0] ?? '', /^Measured, from \/joint_states\. No active controller/);
  assert.equal(panel.element.querySelector('input'), null);
});

test('joint_state_publisher gives a slider to each joint that follows no other', async () => {
  const { app, panel } = shown([ARM, FINGER], { joint_publisher: '/joint_state_publisher' });
  assert.equal(panel.element.querySelectorAll('input[type=range]').length, 1);
  assert.equal(find(panel, '.joint[title="follows arm"] .joint-name').textContent, 'finger');
  panel.pulse?.(at({ arm: 1.25 }));
  await drawn();
  assert.deepEqual([slider(panel).value, field(panel).value], ['1.25', '1.250']);
  enter(slider(panel), '-0.5', 'input');
  assert.deepEqual(await sent(app, 1), { type: 'set_joints', robot: '/', positions: { arm: -0.5 } });
  const [, center] = panel.element.querySelectorAll<HTMLElement>('.tools button');
  center?.click();
  assert.deepEqual(await sent(app, 2), { type: 'set_joints', robot: '/', positions: { arm: 0.5 } });
});

test('a controller moves its joints; a slider stays where a hand has put it for a while', async () => {
  const { app, panel } = shown([ARM, LIFT]);
  const controller = { name: 'mover', kind: 'jtc', state: 'active', claims: [], moves: ['arm'] };
  app.say({ type: 'controllers', robot: '/', controllers: [controller], hardware: [] });
  await drawn();
  assert.match(texts(panel, 'p')[0] ?? '', /Sliders command mover: the robot moves\./);
  assert.equal(panel.element.querySelectorAll('.joint.slides').length, 1);
  const knob = slider(panel);
  enter(knob, '1', 'input');
  await drawn();
  panel.pulse?.(at({ arm: 0.1, lift: 0 })); // it has only begun to move
  await drawn();
  assert.equal(field(panel).value, '1.000');
  assert.equal(slider(panel), knob, 'it is not taken out of the hand');
  assert.deepEqual(await sent(app, 1), { type: 'set_joints', robot: '/', positions: { arm: 1 } });
});

test('a typed value is kept while it is typed, and bounded by the limits', async () => {
  const { app, panel } = shown([ARM], { joint_publisher: '/joint_state_publisher' });
  enter(field(panel), '9', 'focus', 'input');
  panel.pulse?.(at({ arm: 0.25 }));
  await drawn();
  assert.equal(field(panel).value, '9');
  enter(field(panel), '9', 'change');
  assert.deepEqual(await sent(app, 1), { type: 'set_joints', robot: '/', positions: { arm: 2 } });
  assert.equal(field(panel).value, '2.000');
  field(panel).dispatchEvent(new Event('blur'));
  panel.pulse?.(at({ arm: 0.75 }));
  await drawn();
  assert.equal(field(panel).value, '0.750');
});

test('many joints can be searched', async () => {
  const many = Array.from({ length: 18 }, (_, index) => ({ ...ARM, name: `joint_${index}` }));
  const { panel } = shown(many);
  enter(find(panel, '.search') as HTMLInputElement, '_1', 'input');
  await drawn();
  assert.equal(panel.element.querySelectorAll('.joint').length, 9);
  enter(find(panel, '.search') as HTMLInputElement, 'wheel', 'input');
  await drawn();
  assert.deepEqual(texts(panel, '.empty'), ['No joint has “wheel” in its name.']);
  assert.equal(shown([ARM]).panel.element.querySelector('.search'), null);
});
