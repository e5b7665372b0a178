// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4, Quaternion, Vector3 } from 'three';
import type { Layout } from '../src/protocol';
import { Placement, WORLD, type Body } from '../src/scene/placement';
import { FrameTree, readPose } from '../src/scene/tree';

type Pose = [x: number, y: number, yaw: number];

/** A transform in the plane: m, m, rad. */
function at([x, y, yaw]: Pose): Matrix4 {
  return new Matrix4().makeRotationZ(yaw).setPosition(x, y, 0);
}

/** A tree with a pose for each `child < parent`; null: not known. */
function treeOf(frames: Record<string, Pose | null>): FrameTree {
  const layout: Pick<Layout, 'frames'> = {
    frames: Object.keys(frames).map((key) => {
      const [name = '', parent = ''] = key.split(' < ');
      return { name, parent };
    }),
  };
  const tree = new FrameTree(layout);
  const numbers = Object.values(frames).flatMap((pose) => {
    if (pose === null) {
      return Array<number>(7).fill(NaN);
    }
    const [x, y, yaw] = pose;
    return [x, y, 0, 0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)];
  });
  tree.read(new Float32Array(numbers));
  return tree;
}

function body(base: string, truth: Pose | null = null, links: Record<string, Pose> = {}): Body {
  const poses = Object.entries({ [base]: [0, 0, 0] as Pose, ...links });
  return {
    base,
    truth: truth && at(truth),
    links: new Map(poses.map(([name, pose]) => [name, at(pose)])),
  };
}

function assertPose(actual: Matrix4 | null, expected: Matrix4): void {
  assert.ok(actual, 'it has no place');
  actual.elements.forEach((value, i) => {
    assert.ok(
      Math.abs(value - expected.elements[i]!) < 1e-5,
      `${actual.elements.join(' ')}, not ${expected.elements.join(' ')}`,
    );
  });
}

test('a pose is read with a unit quaternion, and not at all if a part is unknown', () => {
  const numbers = new Float32Array([9, 1, 2, 3, 0, 0, 2, 2]);
  const pose = readPose(numbers, 1, new Matrix4());
  const turned = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), Math.PI / 2);
  assertPose(pose, new Matrix4().makeRotationFromQuaternion(turned).setPosition(1, 2, 3));
  numbers[4] = NaN;
  assert.equal(readPose(numbers, 1, new Matrix4()), null);
});

test('poses are composed along the tree', () => {
  const tree = treeOf({
    'odom < map': [1, 0, Math.PI / 2],
    'base < odom': [2, 0, 0],
    'laser < base': [0, 1, 0],
  });
  assert.equal(tree.rootOf('laser'), 'map');
  const product = at([1, 0, Math.PI / 2]).multiply(at([2, 0, 0])).multiply(at([0, 1, 0]));
  assertPose(tree.inRoot('laser'), product);
  assertPose(tree.inRoot('map'), new Matrix4());
});

test('without truth all is as TF has it, and the fixed frame stands at the origin', () => {
  const tree = treeOf({ 'base < odom': [2, 1, 0.5], 'wheel < base': [0.2, 0, 0] });
  const robot = body('base', null, { wheel: [0.2, 0, 0] });
  const placement = new Placement();
  for (const fixed of ['odom', 'base', 'wheel']) {
    placement.update(tree, [robot], fixed);
    assertPose(placement.poseOf(fixed), new Matrix4());
    const wanted = (tree.inRoot(fixed) as Matrix4).invert().multiply(at([2, 1, 0.5]));
    assertPose(placement.poseOfBody(robot), wanted);
  }
});

test('with truth a robot is where it is, and odom where the two agreed first', () => {
  const placement = new Placement();
  const start: Pose = [5, 5, 1];
  placement.update(treeOf({ 'base < odom': [0, 0, 0] }), [body('base', start)], WORLD);
  assertPose(placement.poseOf('odom'), at(start));

  const drifted = body('base', [6, 5, 1.2]);
  placement.update(treeOf({ 'base < odom': [1.3, 0, 0.1] }), [drifted], WORLD);
  assertPose(placement.poseOfBody(drifted), at([6, 5, 1.2]));
  assertPose(placement.poseOf('base'), at([6, 5, 1.2]));
  assertPose(placement.poseOf('odom'), at(start));
});

test('after a reset the two agree anew', () => {
  const placement = new Placement();
  placement.update(treeOf({ 'base < odom': [0, 0, 0] }), [body('base', [5, 5, 1])], WORLD);
  placement.clear();
  placement.update(treeOf({ 'base < odom': [0, 0, 0] }), [body('base', [1, 2, 3])], WORLD);
  assertPose(placement.poseOf('odom'), at([1, 2, 3]));
});

test('one tree is forgotten without the other', () => {
  const tree = treeOf({ 'a/base < a/odom': [0, 0, 0], 'b/base < b/odom': [0, 0, 0] });
  const placement = new Placement();
  placement.update(tree, [body('a/base', [1, 0, 0]), body('b/base', [2, 0, 0])], WORLD);
  placement.forget('a/odom');
  placement.update(tree, [body('a/base', [3, 0, 0]), body('b/base', [4, 0, 0])], WORLD);
  assertPose(placement.poseOf('a/odom'), at([3, 0, 0]));
  assertPose(placement.poseOf('b/odom'), at([2, 0, 0]));
});

test('the choice of the fixed frame moves the view, not what is in it', () => {
  const tree = treeOf({ 'base < odom': [1, 2, 0.3], 'laser < base': [0.1, 0, 0.2] });
  const robot = body('base', [4, -1, 2]);
  const placement = new Placement();
  const between = (fixed: string): Matrix4 => {
    placement.update(tree, [robot], fixed);
    const [world, laser] = [WORLD, 'laser'].map((name) => placement.poseOf(name) as Matrix4);
    return world!.invert().multiply(laser!);
  };
  const seen = between(WORLD);
  for (const fixed of ['odom', 'base', 'laser']) {
    assertPose(between(fixed), seen);
  }
});

test("a frame below a link goes with the robot's body, fresher than TF", () => {
  const tree = treeOf({
    'base < odom': [0, 0, 0],
    'arm < base': [0, 0, 0],
    'camera < arm': [0.5, 0, 0],
  });
  const robot = body('base', null, { arm: [0, 0, Math.PI / 2] });
  const placement = new Placement();
  placement.update(tree, [robot], 'odom');
  assertPose(placement.poseOf('camera'), at([0, 0.5, Math.PI / 2]));
});

test('what is not connected to the fixed frame has no place', () => {
  const tree = treeOf({
    'base < odom': [0, 0, 0],
    'tag < camera': [1, 0, 0],
    'lost < base': null,
  });
  const placement = new Placement();
  placement.update(tree, [body('base')], 'odom');
  assert.equal(placement.poseOf('tag'), null);
  assert.equal(placement.poseOf('lost'), null);
  assert.equal(placement.poseOf(WORLD), null);
  placement.update(tree, [body('base')], 'nowhere');
  assert.equal(placement.poseOf('base'), null);
});

test('two robots with truth are connected through the world', () => {
  const tree = treeOf({ 'a/base < a/odom': [0, 0, 0], 'b/base < b/odom': [3, 0, 0] });
  const robots = [body('a/base', [1, 0, 0]), body('b/base', [0, 2, 0])];
  const placement = new Placement();
  placement.update(tree, robots, 'a/odom');
  assertPose(placement.poseOf('b/odom'), at([-4, 2, 0]));
});

test('a world that is in TF is the world', () => {
  const tree = treeOf({ 'map < world': [1, 0, 0], 'base < map': [1, 0, 0] });
  const placement = new Placement();
  placement.update(tree, [body('base', [2.5, 0, 0])], WORLD);
  assertPose(placement.poseOf('map'), at([1, 0, 0]));
  assertPose(placement.poseOf('base'), at([2.5, 0, 0]));
});

test('a robot of one link, unknown to TF, is a frame by itself', () => {
  const robot = body('base');
  const placement = new Placement();
  placement.update(treeOf({}), [robot], 'base');
  assertPose(placement.poseOfBody(robot), new Matrix4());
  assertPose(placement.poseOf('base'), new Matrix4());
});

test('a map of the world lies where the world does, however its robot was localised at first', () => {
  const placement = new Placement();
  const robot = body('base', [3, 2, 0]);
  placement.update(treeOf({ 'odom < map': [0.4, 0.1, 0.02], 'base < odom': [2.5, 2, 0] }), [robot], WORLD);
  assert.deepEqual(placement.poseOf('map')?.elements, new Matrix4().elements);
});

test('a map that begins elsewhere, as that of SLAM, lies where it and the truth agreed', () => {
  const placement = new Placement();
  const robot = body('base', [3, 2, 0]);
  placement.update(treeOf({ 'odom < map': [0, 0, 0], 'base < odom': [0, 0, 0] }), [robot], WORLD);
  const [x, y] = new Vector3().setFromMatrixPosition(placement.poseOf('map')!).toArray();
  assert.deepEqual([x, y], [3, 2]);
});

test('once localisation corrects itself, what it said before is forgotten', () => {
  const placement = new Placement();
  const robot = body('base', [5, 2, 0]);
  const believed = (x: number): FrameTree => treeOf({ 'odom < map': [x, 2, 0], 'base < odom': [1, 0, 0] });
  const place = (): number => new Vector3().setFromMatrixPosition(placement.poseOf('map')!).x;
  placement.update(believed(0), [robot], WORLD);
  assert.equal(place(), 4, 'it believed that it was at 1 m');
  placement.update(believed(0.1), [robot], WORLD);
  assert.equal(place(), 4, 'small corrections do not move the map');
  placement.update(believed(4), [robot], WORLD);
  assert.equal(place(), 0, 'an initial pose does');
});
