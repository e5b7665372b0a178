// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { simulationPanel } from '../src/panels/simulation';
import type { RobotInfo } from '../src/protocol';
import type { MarkedPlace } from '../src/scene/placing';
import type { Footprint } from '../src/spawn/free_place';
import type { Ground } from '../src/spawn/offer';
import { connectedApp, drawn, graphOf, type TestApp } from './page';

const ROBOT: RobotInfo = {
  id: '/', name: 'amr', present: true, command: null, odometry: null, truth: null, wheels: null,
  joint_states: null, joint_publisher: null, manager: null, entity: null,
};

class FakeGround implements Ground {
  robots: Footprint[] = [{ id: '/', x: 0, y: 0, yaw: 0, radius: 0.4 }];
  marked: MarkedPlace | null = null;
  shown: string[] = [];
  point: ((x: number, y: number) => void) | null = null;
  click: () => void = () => {};
  footprints = (): readonly Footprint[] => this.robots;
  radiusOf = (): number => 0.4;
  markPlace = (place: MarkedPlace | null): void => void (this.marked = place);
  bringIntoView = (robot: string): void => void this.shown.push(robot);
  askForPlace = (pointed: FakeGround['point'], chosen: () => void = () => {}): void => {
    this.point = pointed;
    this.click = chosen;
  };
}

interface Shown {
  app: TestApp;
  ground: FakeGround;
  element: HTMLElement;
  field: (name: string) => HTMLInputElement;
  button: (type: string) => HTMLButtonElement;
  says: () => string;
}

async function shown(): Promise<Shown> {
  const app = connectedApp();
  const ground = new FakeGround();
  const { element } = simulationPanel(app, () => ground);
  const simulators = [{ id: '/sim', entities: ['amr'], world: '', worlds: [] }];
  app.say({ type: 'graph', robots: [ROBOT], simulators, hint: null, sensors: [], navigators: [] });
  await drawn();
  return {
    app,
    ground,
    element,
    field: (name) => element.querySelector(`[name=${name}]`) as HTMLInputElement,
    button: (type) => element.querySelector(`button[type=${type}]`) as HTMLButtonElement,
    says: () => element.querySelector('output')?.textContent ?? '',
  };
}

function submit(element: HTMLElement): void {
  element.querySelector('form.spawn')?.dispatchEvent(new Event('submit', { cancelable: true }));
}

test('a free name and a free place are offered, and the next ones after a robot has come', async () => {
  const { app, ground, element, field, button, says } = await shown();
  assert.deepEqual(['name', 'x', 'y'].map((name) => field(name).value), ['robot1', '0', '1.2']);
  submit(element);
  await drawn();
  assert.equal(button('submit').disabled, true, 'at once');
  assert.equal(button('submit').textContent, 'Spawning robot1 …');
  assert.match(says(), /controllers/);
  const asked = app.sent.at(-1);
  assert.ok(asked?.type === 'spawn');
  assert.deepEqual(asked.position, [0, 1.2, 0]);
  assert.deepEqual([asked.name, asked.namespace, asked.like], ['robot1', '/robot1', '/']);
  ground.robots.push({ id: '/robot1', x: 0, y: 1.2, yaw: 0, radius: 0.4 });
  const simulators = [{ id: '/sim', entities: ['amr', 'robot1'], world: '', worlds: [] }];
  app.say({ type: 'graph', robots: [ROBOT], simulators, hint: null, sensors: [], navigators: [] });
  app.say({ type: 'reply', id: asked.id, ok: true, message: "'robot1' is in the world", data: null, again: null });
  await drawn();
  assert.deepEqual(ground.shown, ['/robot1']);
  assert.equal(button('submit').disabled, false);
  assert.deepEqual(['name', 'x', 'y'].map((name) => field(name).value), ['robot2', '0', '-1.1']);
});

test('a refused place stays, so that it can be mended', async () => {
  const { app, ground, element, field } = await shown();
  field('x').value = '0.2';
  field('x').dispatchEvent(new Event('input'));
  field('y').value = '0';
  field('y').dispatchEvent(new Event('input'));
  await drawn();
  assert.match(element.textContent ?? '', /Something stands there/);
  assert.equal(ground.marked?.isFree, false);
  submit(element);
  await drawn();
  const asked = app.sent.at(-1);
  assert.ok(asked?.type === 'spawn');
  app.say({ type: 'reply', id: asked.id, ok: false, message: 'it would be inside another', data: null, again: null });
  await drawn();
  assert.equal(field('x').value, '0.2');
  assert.deepEqual(ground.shown, []);
});

test('a place is pointed at in the scene, marked there, and kept by a click', async () => {
  const { ground, element, field } = await shown();
  const toggle = element.querySelector('.spawn .toggle') as HTMLButtonElement;
  toggle.click();
  await drawn();
  assert.equal(toggle.getAttribute('aria-pressed'), 'true');
  ground.point?.(2.004, -1.5);
  assert.deepEqual(ground.marked, { x: 2, y: -1.5, yaw: 0, radius: 0.4, isFree: true });
  ground.click();
  await drawn();
  assert.equal(ground.point, null);
  assert.equal(toggle.getAttribute('aria-pressed'), 'false');
  assert.deepEqual([field('x').value, field('y').value], ['2.00', '-1.50']);
});

test('no place is offered before it is known where the robots stand', async () => {
  const app = connectedApp();
  const ground = new FakeGround();
  const known = ground.robots;
  ground.robots = [];
  const panel = simulationPanel(app, () => ground);
  const robots = [{ ...ROBOT, truth: '/ground_truth/odom' }];
  const simulators = [{ id: '/sim', entities: ['amr'], world: '', worlds: [] }];
  app.say({ type: 'graph', robots, simulators, hint: null, sensors: [], navigators: [] });
  await drawn();
  const x = panel.element.querySelector('[name=x]') as HTMLInputElement;
  assert.equal(x.value, '');
  ground.robots = known;
  app.say({ type: 'graph', robots, simulators, hint: null, sensors: [], navigators: [] });
  await drawn();
  assert.equal(x.value, '0');
});

test('an offered place stays while it is not known yet where another robot stands', async () => {
  const { app, ground, field } = await shown();
  const truth = '/ground_truth';
  const simulators = [{ id: '/sim', entities: ['amr'], world: '', worlds: [] }];
  const say = (robots: RobotInfo[]): void =>
    app.say({ type: 'graph', robots, simulators, hint: null, sensors: [], navigators: [] });
  say([{ ...ROBOT, truth }]);
  say([{ ...ROBOT, truth }, { ...ROBOT, id: '/robot1', name: 'robot1', truth: '/robot1/ground_truth' }]);
  await drawn();
  assert.equal(ground.robots.length, 1);
  assert.deepEqual([field('x').value, field('y').value], ['0', '1.2']);
});

test('a robot that was deleted is offered again, by its name and in its namespace', async () => {
  const { app, ground, element, field } = await shown();
  const model = { root: 'base_link', meshes: {}, joints: [], findings: [] };
  app.say({ type: 'model', robot: '/', urdf: '<robot><visual/></robot>', ...model });
  const simulators = [{ id: '/sim', entities: [], world: '', worlds: [] }];
  app.say(graphOf([{ ...ROBOT, present: false }], { simulators }));
  ground.robots = [];
  await drawn();
  assert.ok([...element.querySelectorAll('h2, h3')].some((each) => each.textContent === 'The robot again'));
  assert.equal(field('name').value, 'amr');
  submit(element);
  await drawn();
  const asked = app.sent.at(-1);
  assert.ok(asked?.type === 'spawn');
  assert.deepEqual([asked.name, asked.namespace, asked.like], ['amr', '/', '/']);
});
