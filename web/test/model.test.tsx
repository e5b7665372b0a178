// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Panel } from '../src/app';
import { findingsToLookAt, modelPanel } from '../src/panels/model';
import type { Finding, Layout, Model } from '../src/protocol';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

const URDF = `<robot name="amr">
  <link name="base"><inertial><mass value="1.5"/></inertial></link>
  <link name="arm"><inertial><mass value="0.25"/></inertial></link>
  <joint name="a" type="fixed"><parent link="base"/><child link="arm"/></joint>
</robot>`;
const FINDINGS: Finding[] = [
  { level: 'error', line: 2, at: 3, text: 'too heavy', remedy: 'eat less' },
  { level: 'warning', line: null, at: null, text: 'no inertia', remedy: '' },
  { level: 'note', line: 4, at: null, text: 'fixed', remedy: '' },
];

function model(known: Partial<Model> = {}): Model {
  return {
    type: 'model', robot: '/', urdf: URDF, root: 'base', meshes: {}, joints: [], findings: [], ...known,
  };
}

function described(known: Partial<Model> = {}): TestApp {
  const app = connectedApp();
  app.say(graphOf([robotInfo({ odometry: '/odom' })]));
  app.say(model(known));
  return app;
}

function detailsOf(panel: Panel): HTMLDetailsElement {
  return find(panel, 'details') as HTMLDetailsElement;
}

/** The value beside a name. */
function fact(panel: Panel, name: string): string | undefined {
  return texts(panel, 'dd')[texts(panel, 'dt').indexOf(name)];
}

test('without a robot the panel says what the node says would do', () => {
  const app = connectedApp();
  app.say(graphOf([], { hint: 'start a simulation' }));
  assert.deepEqual(texts(modelPanel(app), '.empty'), ['start a simulation']);
});

test('the description is summed up, and its names in the graph are there', () => {
  const panel = modelPanel(described());
  const shown = ['Root link', 'Links', 'Joints', 'Mass', 'Odometry', 'Truth', 'Command']
    .map((name) => fact(panel, name));
  assert.deepEqual(shown, [
    'base', '2', '1, of which 0 move', '1.75 kg', '/odom', 'nobody publishes it', 'nobody subscribes to one',
  ]);
  assert.deepEqual(texts(panel, '.verdict'), ['No errors, no warnings.']);
});

test('findings are listed with their line and what would do; notes are not to be looked at', () => {
  const app = described({ findings: FINDINGS });
  const panel = modelPanel(app);
  assert.deepEqual(texts(panel, '.findings b'), ['Error', 'Warning', 'Note, line 4']);
  assert.deepEqual(texts(panel, '.findings .fine'), ['eat less']);
  assert.deepEqual(findingsToLookAt(app.store), { count: 2, tone: 'error' });
});

test('an open URDF stays open, whatever comes and goes in the graph', async () => {
  const app = described();
  const panel = modelPanel(app);
  const source = detailsOf(panel);
  assert.equal(source.open, false);
  source.open = true;
  source.dispatchEvent(new Event('toggle'));
  await drawn();
  app.say(graphOf([robotInfo({ odometry: '/odom2' }), robotInfo({ id: '/robot1' })]));
  await drawn();
  assert.equal(fact(panel, 'Odometry'), '/odom2');
  assert.equal(find(panel, 'details'), source, 'it is the same element');
  assert.equal(source.open, true);
  app.say(graphOf([])); // the connection was lost …
  await drawn();
  app.say(graphOf([robotInfo()])); // … and is there again
  app.say(model({ urdf: `${URDF}\n` }));
  await drawn();
  assert.equal(detailsOf(panel).open, true);
  assert.deepEqual(texts(panel, 'pre'), [`${URDF}\n`]);
});

test('the line of a finding is shown in the URDF', async () => {
  const panel = modelPanel(described({ findings: FINDINGS }));
  document.body.append(panel.element);
  await drawn();
  assert.equal(find(panel, '.findings button').textContent, 'line 2', 'of its file');
  find(panel, '.findings button').click();
  await drawn();
  assert.equal(detailsOf(panel).open, true);
  assert.equal(String(document.getSelection()), URDF.split('\n')[2]);
  panel.element.remove();
});

test('where the robot is stands there, as far as it is known', async () => {
  const app = described();
  const panel = modelPanel(app);
  const layout: Layout = { type: 'layout', id: 1, frames: [], robots: [{ id: '/', joints: [], wheels: [] }] };
  const state = unknownState(layout);
  panel.pulse?.(state);
  await drawn();
  assert.equal(fact(panel, 'By truth'), undefined);
  state.robots[0]!.truth.set([1, -2, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2]);
  panel.pulse?.({ ...state });
  await drawn();
  assert.equal(fact(panel, 'By truth'), 'x 1.00 m, y \u22122.00 m, 90\u00b0');
});
