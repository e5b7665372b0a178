// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Panel } from '../src/app';
import { simulationPanel } from '../src/panels/simulation';
import type { ServerMessage, SimulationStatus } from '../src/protocol';
import type { State } from '../src/state';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

function graph(...entities: string[]): ServerMessage {
  return graphOf([robotInfo()], { simulators: [{ id: '/sim', entities, world: '', worlds: [] }] });
}

const STATUS: SimulationStatus = {
  type: 'simulation', simulator: '/sim', state: 'playing', time: 1, factor: 1, real_factor: 0.5,
};
/** A state with robots at these places, m. */
function robotsAt(...places: [x: number, y: number][]): State {
  const robots = places.map((_, at) => ({ id: `/${at}`, joints: [], wheels: [] }));
  const state = unknownState({ type: 'layout', id: 1, frames: [], robots });
  places.forEach(([x, y], at) => state.robots[at]!.truth.set([x, y, 0, 0, 0, 0, 1]));
  return { ...state, time: 61.25 };
}

function simulating(): { app: TestApp; panel: Panel } {
  const app = connectedApp();
  app.say(graph('amr'));
  app.say(STATUS);
  return { app, panel: simulationPanel(app, () => null) };
}

function input(panel: Panel, name: string): HTMLInputElement {
  return find(panel, `input[name=${name}]`) as HTMLInputElement;
}

test('another world is chosen, and waited for', async () => {
  const { app, panel } = simulating();
  assert.equal(panel.element.querySelector('#world'), null, 'there is none to choose');
  const simulators = [{ id: '/sim', entities: [], world: 'hall', worlds: ['empty', 'walls'] }];
  app.say(graphOf([robotInfo()], { simulators }));
  await drawn();
  const choice = find(panel, '#world') as HTMLSelectElement;
  assert.deepEqual([...choice.options].map((each) => each.value), ['hall', 'empty', 'walls']);
  assert.equal(choice.value, 'hall');
  choice.value = 'walls';
  choice.dispatchEvent(new Event('change'));
  await drawn();
  assert.deepEqual(app.sent.at(-1), { type: 'load_world', id: 1, simulator: '/sim', name: 'walls' });
  assert.equal(choice.disabled, true);
  app.say({ type: 'reply', id: 1, ok: false, message: 'no', data: null, again: null });
  await drawn();
  assert.equal(choice.disabled, false);
});

test('of a simulator that is silent nothing is said to play, and nothing is asked', async () => {
  const { app, panel } = simulating();
  const state = (): string | undefined => texts(panel, '.facts dd')[1];
  const controls = (): boolean[] =>
    [...panel.element.querySelectorAll('fieldset')].map(({ disabled }) => disabled);
  assert.equal(state(), 'playing');
  assert.deepEqual(controls(), [false]);
  app.store.setSilence('No data for 6 s');
  await drawn();
  assert.equal(state(), 'No data for 6 s');
  assert.equal(texts(panel, '.facts dd')[2], '–');
  assert.deepEqual(controls(), [true]);
  app.store.setSilence('');
  await drawn();
  assert.equal(state(), 'playing');
});

test('without a simulator the panel says so', () => {
  const panel = simulationPanel(connectedApp(), () => null);
  assert.deepEqual(texts(panel, '.empty'), ['There is no simulator in the graph.']);
});

test('the clock is shown, and a machine that is too slow is told of', async () => {
  const { app, panel } = simulating();
  panel.pulse?.(robotsAt());
  await drawn();
  assert.deepEqual(texts(panel, 'dd'), ['1:01.2', 'playing', '0.50×']);
  assert.deepEqual(texts(panel, '.why-slow'), ['This machine is too slow for it.']);
  const line = { stamp: 1, level: 'warning', place: '' } as const;
  const why = 'real time is not kept: factor 0.5 instead of 1. Most goes to physics';
  app.say({
    type: 'log',
    lines: [
      { ...line, number: 1, node: 'sim', text: why },
      { ...line, number: 2, node: 'sim', text: 'something else' },
      { ...line, number: 3, node: 'other', text: 'real time is not kept by others' },
    ],
  });
  await drawn();
  assert.deepEqual(texts(panel, '.why-slow'), [why], 'in the words of the simulator');
  app.say({ ...STATUS, state: 'paused' });
  await drawn();
  assert.deepEqual(texts(panel, 'dd'), ['1:01.2', 'paused', '–']);
  assert.equal(panel.element.querySelector('[data-tone=warning]'), null);
});

test('a factor that was set elsewhere is there, and another one is asked for', async () => {
  const { app, panel } = simulating();
  app.say({ ...STATUS, factor: 3 });
  await drawn();
  const choice = find(panel, '#factor') as HTMLSelectElement;
  assert.equal(choice.value, '3');
  choice.value = '0';
  choice.dispatchEvent(new Event('change'));
  assert.deepEqual(app.sent.at(-1), { type: 'set_factor', id: 1, simulator: '/sim', factor: 0 });
});

test('it steps as far as was said', async () => {
  const { app, panel } = simulating();
  const steps = find(panel, '#steps') as HTMLInputElement;
  steps.value = '250';
  steps.dispatchEvent(new Event('input'));
  await drawn();
  find(panel, '.join button').click();
  assert.deepEqual(app.sent.at(-1), { type: 'step', id: 1, simulator: '/sim', steps: 250 });
});

test('what is in the world is deleted on the second press', async () => {
  const { app, panel } = simulating();
  const remove = find(panel, '.rows button[title^=Take]');
  remove.click();
  await drawn();
  assert.equal(remove.textContent, 'Really delete?');
  assert.equal(app.sent.length, 0);
  app.say(graph('amr', 'box')); // meanwhile the graph changes
  await drawn();
  assert.ok(find(panel, '.rows button[title^=Take]') === remove);
  remove.click();
  assert.deepEqual(app.sent.at(-1), { type: 'delete', id: 1, simulator: '/sim', name: 'amr' });
});

test('where nothing is drawn, a place beside the robots is offered by the truth', async () => {
  const { app, panel } = simulating();
  for (let count = 0; count < 4; count += 1) {
    panel.pulse?.(robotsAt([0, 0], [0, 1.3]));
    await drawn();
  }
  app.say(graph('amr', 'robot1'));
  await drawn();
  const [x, y] = ['x', 'y'].map((name) => Number(input(panel, name).value));
  assert.equal(input(panel, 'name').value, 'robot2');
  assert.ok(Math.hypot(x! - 0, y! - 0) > 1 && Math.hypot(x! - 0, y! - 1.3) > 1);
});
