// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { linkFacts, principalAxes } from '../src/links';
import { framesPanel } from '../src/panels/frames';
import type { RobotInfo } from '../src/protocol';
import { Places } from '../src/scene/places';
import { readUrdf } from '../src/scene/urdf';
import { connectedApp, drawn, texts } from './page';

const URDF = `<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 0 0.2" rpy="0 0 1.5"/>
      <mass value="5"/>
      <inertia ixx="0.0417" iyy="0.1083" izz="0.1417" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><box size="0.5 0.3  0.1"/></geometry></collision>
    <collision><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
    <collision><geometry><mesh filename="package://arm/meshes/upper.stl"/></geometry></collision>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="2" velocity="3" effort="40"/>
  </joint>
  <link name="wheel"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="5"/></inertial></link>
  <joint name="axle" type="continuous"><parent link="upper"/><child link="wheel"/></joint>
</robot>`;

const ROBOT: RobotInfo = {
  id: '/arm1', name: 'arm', present: true, command: null, odometry: null, truth: null, wheels: null,
  joint_states: null, joint_publisher: null, manager: null, entity: null,
};

test('a link is read with its inertia, shapes and joint', () => {
  const link = linkFacts(URDF, 'upper');
  assert.ok(link !== null);
  assert.equal(link.mass, 5);
  assert.deepEqual(link.centre, { xyz: [0.1, 0, 0.2], rpy: [0, 0, 1.5] });
  assert.deepEqual(link.collisions, ['box 0.5 × 0.3 × 0.1 m', 'cylinder, radius 0.1 m, length 0.04 m', 'mesh upper.stl']);
  assert.deepEqual(link.joint, {
    name: 'shoulder', kind: 'revolute', parent: 'base', axis: [0, 1, 0],
    lower: -1.5, upper: 2, velocity: 3, effort: 40,
  });
  const axle = linkFacts(URDF, 'wheel')?.joint;
  assert.deepEqual([axle?.axis, axle?.lower, axle?.upper], [[1, 0, 0], null, null]);
  assert.equal(linkFacts(URDF, 'base')?.mass, null);
  assert.equal(linkFacts(URDF, 'base')?.joint, null);
  assert.equal(linkFacts(URDF, 'nowhere'), null);
});

test('the ellipsoid of a box is as long as its sides by the square root of 5/3', () => {
  const halves = linkFacts(URDF, 'upper')?.inertia?.ellipsoid ?? [];
  [0.5, 0.3, 0.1].forEach((side, axis) => {
    assert.ok(Math.abs(2 * (halves[axis] ?? 0) - Math.sqrt(5 / 3) * side) < 2e-3, `${2 * (halves[axis] ?? 0)}`);
  });
});

test('moments that no body has give no ellipsoid', () => {
  assert.equal(linkFacts(URDF, 'wheel')?.inertia?.ellipsoid, null);
});

test('principal axes turn a tensor into its diagonal', () => {
  const [a, b] = [Math.cos(0.7), Math.sin(0.7)];
  // diag(1, 2, 4), turned by 0.7 rad about z
  const tensor = [a * a + 2 * b * b, b * b + 2 * a * a, 4, a * b - 2 * a * b, 0, 0] as const;
  const { values, vectors } = principalAxes([...tensor]);
  assert.deepEqual([...values].sort((one, two) => one - two).map((value) => +value.toFixed(9)), [1, 2, 4]);
  const first = vectors[values.findIndex((value) => Math.abs(value - 1) < 1e-9)] ?? [];
  assert.ok(Math.abs(Math.abs(first[0] ?? 0) - a) < 1e-9 && Math.abs(Math.abs(first[1] ?? 0) - b) < 1e-9);
  const full = principalAxes([3, 4, 5, 0.5, -0.3, 0.8]);
  for (const [index, vector] of full.vectors.entries()) {
    const [x, y, z] = vector;
    const product = [3 * x + 0.5 * y - 0.3 * z, 0.5 * x + 4 * y + 0.8 * z, -0.3 * x + 0.8 * y + 5 * z];
    product.forEach((value, at) => {
      assert.ok(Math.abs(value - (full.values[index] ?? NaN) * (vector[at] ?? NaN)) < 1e-9);
    });
  }
});

test('the panel shows the chosen link, by its frame with the namespace', async () => {
  const app = connectedApp();
  app.say({ type: 'graph', robots: [ROBOT], simulators: [], hint: null, sensors: [], navigators: [] });
  app.say({
    type: 'model', robot: '/arm1', urdf: URDF, root: 'base', meshes: {}, joints: [], findings: [],
  });
  const panel = framesPanel(app, new Places(app.store, new Map()));
  assert.equal(app.store.robotOf('arm1/upper'), '/arm1');
  app.store.select({ robot: '/arm1', frame: 'arm1/upper' });
  await drawn();
  assert.ok(texts(panel, 'h3').includes('Link upper'));
  const words = texts(panel, 'dd');
  for (const word of ['5 kg', '0.1  0  0.2', '-1.5 rad (-86°)', '2 rad (115°)', '40 N m', 'revolute, on base']) {
    assert.ok(words.includes(word), `${word} in ${words.join('|')}`);
  }
  app.store.select({ robot: '/arm1', frame: 'odom' });
  await drawn();
  assert.equal(texts(panel, 'h3').some((title) => title.startsWith('Link')), false);
});

test('a visual has a colour that is seen on a white map, unless it has its own', () => {
  const visual = (inner: string): string => `<link name="l"><visual>${inner}</visual></link>`;
  const mesh = (file: string): string => `<geometry><mesh filename="${file}"/></geometry>`;
  const xml = readUrdf(
    `<robot name="r">${[
      visual('<geometry><box size="1 1 1"/></geometry>'), visual(mesh('a.STL')), visual(mesh('a.dae')),
      visual(`${mesh('b.stl')}<material name="red"/>`),
    ].join('')}</robot>`,
    {},
    () => {},
  );
  const names = [...xml.querySelectorAll('visual')].map(
    (each) => each.querySelector('material')?.getAttribute('name') ?? null,
  );
  assert.deepEqual(names, ['plain', 'plain', null, 'red']);
});
