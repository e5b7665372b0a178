// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4 } from 'three';
import type { Panel } from '../src/app';
import { framesPanel } from '../src/panels/frames';
import type { Layout } from '../src/protocol';
import { Places } from '../src/scene/places';
import type { State } from '../src/state';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

const LAYOUT: Layout = {
  type: 'layout',
  id: 1,
  frames: [
    { name: 'base', parent: 'odom' },
    { name: 'wheel', parent: 'base' },
    { name: 'far', parent: 'elsewhere' },
  ],
  robots: [{ id: '/', joints: [], wheels: [] }],
};
const HALF = Math.SQRT1_2;

/** The base 1 m ahead in odom, a quarter turn to the left; its wheel 0.5 m before it. */
function state(truth: readonly number[] | null = null): State {
  const made = unknownState(LAYOUT);
  made.poses.set([1, 0, 0, 0, 0, HALF, HALF, 0.5, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]);
  made.robots[0]!.truth.set(truth ?? []);
  return made;
}

function shown(): { app: TestApp; panel: Panel } {
  const app = connectedApp();
  app.say(graphOf([robotInfo()]));
  app.say({ type: 'model', robot: '/', urdf: '', root: 'base', meshes: {}, joints: [], findings: [] });
  app.say(LAYOUT);
  const places = new Places(app.store, new Map<string, Matrix4>());
  return { app, panel: framesPanel(app, places) };
}

function pressed(panel: Panel): string[] {
  return texts(panel, '[aria-pressed=true]');
}

/** What is said of the chosen frame: relative to what, and where it is. */
function where(panel: Panel): string[][] {
  const lists = [...panel.element.querySelectorAll('.facts')];
  return lists.map((list) => [...list.querySelectorAll('dd')].slice(0, 3).map((dd) => dd.textContent));
}

test('the tree is there, roots first, and a frame that is pressed is chosen', async () => {
  const { app, panel } = shown();
  assert.deepEqual(texts(panel, '.frame'), ['odom', 'base', 'wheel', 'elsewhere', 'far']);
  assert.deepEqual(texts(panel, 'ul ul ul .frame'), ['wheel']);
  const wheel = [...panel.element.querySelectorAll<HTMLElement>('.frame')][2]!;
  wheel.click();
  await drawn();
  assert.deepEqual(app.store.selection, { robot: '/', frame: 'wheel' });
  assert.deepEqual(pressed(panel), ['wheel']);
  app.store.select({ robot: '/', frame: 'base' }); // by a click in the scene
  await drawn();
  assert.deepEqual(pressed(panel), ['base']);
});

test('a frame in the namespace of a robot is of that robot', async () => {
  const { app, panel } = shown();
  app.say(graphOf([robotInfo({ id: '/robot1' }), robotInfo({ id: '/robot2' })]));
  const frames = [{ name: 'robot2/base', parent: 'robot2/odom' }];
  app.say({ ...LAYOUT, id: 2, frames });
  await drawn();
  find(panel, 'ul ul .frame').click();
  assert.deepEqual(app.store.selection, { robot: '/robot2', frame: 'robot2/base' });
});

test('the chosen frame is where it is in its parent, and in the fixed frame', async () => {
  const { app, panel } = shown();
  app.store.select({ robot: '/', frame: 'wheel' });
  panel.pulse?.(state());
  await drawn();
  assert.deepEqual(where(panel), [
    ['base', '0.500  0.000  0.000', '0.0°  0.0°  0.0°'],
    ['odom', '1.000  0.500  0.000', '0.0°  0.0°  90.0°'],
  ]);
  app.store.select({ robot: '/', frame: 'base' });
  await drawn();
  assert.deepEqual(where(panel).length, 1, 'its parent is the fixed frame: once will do');
  app.store.select({ robot: '/', frame: 'far' });
  await drawn();
  assert.deepEqual(where(panel)[1], ['odom', '–', '–'], 'nothing connects the two');
});

test('the fixed frame is that of the scene: world, where the truth is known', async () => {
  const { app, panel } = shown();
  app.store.select({ robot: '/', frame: 'wheel' });
  panel.pulse?.(state());
  await drawn();
  const names = ['automatic: odom', 'odom', 'base', 'wheel', 'elsewhere', 'far'];
  assert.deepEqual(texts(panel, 'option'), names);
  assert.doesNotMatch(panel.element.textContent, /world is/);
  panel.pulse?.(state([5, 5, 0, 0, 0, 0, 1]));
  await drawn();
  assert.deepEqual(texts(panel, 'option').slice(0, 2), ['automatic: world', 'world']);
  assert.match(find(panel, '.section .fine').textContent, /^world is the simulator’s/, 'it is in no tree');
  assert.deepEqual(where(panel)[1], ['world', '5.500  5.000  0.000', '0.0°  0.0°  0.0°']);
  const choice = find(panel, '#fixed-frame') as HTMLSelectElement;
  choice.value = 'odom';
  choice.dispatchEvent(new Event('change'));
  await drawn();
  assert.equal(app.store.fixedFrame, 'odom');
  assert.deepEqual(where(panel)[1]?.slice(0, 2), ['odom', '1.000  0.500  0.000']);
});
