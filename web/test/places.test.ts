// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { connectedApp, graphOf, robotInfo, unknownState } from './page';
import type { Layout, Model } from '../src/protocol';
import { Picture } from '../src/scene/picture';
import { Places } from '../src/scene/places';
import { PALETTES } from '../src/scene/theme';
import { unseenWords } from '../src/scene/unseen';
import type { State } from '../src/state';

const URDF = `<robot name="amr"><link name="base"/><link name="wheel"/>
  <joint name="j" type="fixed"><parent link="base"/><child link="wheel"/><origin xyz="0.5 0 0"/></joint>
</robot>`;
const MODEL: Model = {
  type: 'model', robot: '/', urdf: URDF, root: 'base', meshes: {}, joints: [], findings: [],
};
const LAYOUT: Layout = {
  type: 'layout',
  id: 1,
  frames: [{ name: 'base', parent: 'odom' }, { name: 'wheel', parent: 'base' }],
  robots: [{ id: '/', joints: [], wheels: [] }],
};

/** A robot that odometry has at x, m; its truth: x y z qx qy qz qw in the world. */
function state(time: number, x: number, truth: readonly number[]): State {
  const made = unknownState(LAYOUT);
  made.poses.set([x, 0, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 0, 0, 1]);
  made.robots[0]?.truth.set(truth);
  return { ...made, time };
}

/** The numbers of the panel and the view, of the same states. */
function both(...states: State[]): { places: Places; picture: Picture } {
  const app = connectedApp();
  app.say(graphOf([robotInfo()]));
  app.say(MODEL);
  app.say(LAYOUT);
  const picture = new Picture(true);
  const events = { changed: () => {}, problem: (text: string) => assert.fail(text) };
  picture.setModel(MODEL, events, PALETTES.light);
  picture.setLayout(LAYOUT);
  const places = new Places(app.store, picture.anchors);
  for (const each of states) {
    picture.setState(each);
    picture.place();
    places.update(each);
  }
  return { places, picture };
}

test('numbers and view hold the same frame still', () => {
  const without = both(state(0, 1, []));
  assert.deepEqual([without.places.fixedFrame, without.picture.fixedFrame], ['odom', 'odom']);
  const known = both(state(0, 1, [5, 5, 0, 0, 0, 0, 1]));
  assert.deepEqual([known.places.fixedFrame, known.picture.fixedFrame], ['world', 'world']);
});

test('every frame is where the view draws it, drift of the odometry and all', () => {
  // Odometry and truth agree at first; then the robot slips, and truly is 0.1 m behind.
  const { places, picture } = both(
    state(0, 1, [5, 5, 0, 0, 0, 0, 1]),
    state(1, 2, [5.9, 5, 0, 0, 0, 0, 1]),
  );
  const drawn = picture.placed.map(({ name, pose }) => [name, ...pose.elements.slice(12, 15)]);
  const told = picture.placed.map(({ name }) => [name, ...(places.poseIn(name, 'world')?.position ?? [])]);
  const round = (row: (string | number)[]): (string | number)[] =>
    row.map((value) => (typeof value === 'number' ? Number(value.toFixed(5)) : value));
  assert.deepEqual(told.map(round), drawn.map(round));
  assert.deepEqual(drawn.map(round), [
    ['world', 0, 0, 0], ['odom', 4, 5, 0], ['base', 5.9, 5, 0], ['wheel', 6.4, 5, 0],
  ]);
});

test('a robot that no transform leads to is unseen until one does', () => {
  const lost = state(0, NaN, []);
  const { picture } = both(lost);
  assert.deepEqual(picture.unseen('/'), { reason: 'place', base: 'base', frame: 'odom' });
  const [title, text] = unseenWords('amr', picture.unseen('/')!);
  assert.equal(title, 'amr cannot be placed');
  assert.match(text, /^No transform that is a number leads from "odom" to "base"\. .*Health/);
  picture.setState(state(1, 1, []));
  picture.place();
  assert.equal(picture.unseen('/'), null);
  assert.equal(picture.unseen('/another'), null, 'nothing is known of it');
});

test('a robot none of whose meshes is there says of which package they are', async () => {
  const app = connectedApp();
  app.say(LAYOUT);
  const mesh = (name: string): string =>
    `<visual><geometry><mesh filename="package://ur_description/${name}"/></geometry></visual>`;
  const urdf = `<robot name="ur"><link name="base">${mesh('a.stl')}${mesh('b.stl')}</link></robot>`;
  const picture = new Picture(true);
  const problems: string[] = [];
  picture.setModel({ ...MODEL, urdf }, { changed: () => {}, problem: (text) => problems.push(text) }, PALETTES.light);
  picture.setLayout(LAYOUT);
  picture.setState(state(0, 1, []));
  picture.place();
  await new Promise((resolve) => setTimeout(resolve, 0)); // meshes are looked for apart
  assert.equal(problems.length, 2);
  const unseen = picture.unseen('/');
  assert.deepEqual(unseen, { reason: 'shapes', problems });
  const [title, text] = unseenWords('ur', unseen);
  assert.equal(title, 'Nothing of ur is drawn');
  assert.match(text, /^2 files of the package ur_description cannot be drawn: the mesh 'package:/);
});
