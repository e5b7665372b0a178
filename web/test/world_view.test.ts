// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4, Mesh, MeshLambertMaterial, Vector3 } from 'three';
import type { Shape } from '../src/protocol';
import { WorldView } from '../src/scene/world';

function box(name: string, x: number, y: number, alpha = 1): Shape {
  return {
    name, kind: 'box', size: [1, 1, 2], position: [x, y, 1], orientation: [0, 0, 0, 1],
    colour: [0.5, 0.5, 0.5, alpha], points: [],
  };
}

/** The opacity of each shape, and whether it hides what is behind it. */
function looks(view: WorldView): Record<string, [opacity: number, hides: boolean]> {
  const entries = view.object.children.map((each) => {
    const { material, name } = each as Mesh<never, MeshLambertMaterial>;
    return [name, [material.opacity, material.depthWrite]] as const;
  });
  return Object.fromEntries(entries) as Record<string, [number, boolean]>;
}

function shelves(): WorldView {
  const view = new WorldView(false);
  view.set({ type: 'world', simulator: '/sim', shapes: [box('near', -2, 0), box('far', 2, 0), box('glass', -3, 0, 0.1)] });
  view.place(new Matrix4());
  view.object.updateMatrixWorld(true);
  return view;
}

test('what stands between the eye and the robot is seen through, and nothing else', () => {
  const view = shelves();
  const robot = [new Vector3(0, 0, 0.2)];
  view.reveal(new Vector3(-6, 0, 1), robot);
  assert.deepEqual(looks(view), { near: [0.22, false], far: [1, true], glass: [0.1, false] });
  view.reveal(new Vector3(6, 0, 1), robot);
  assert.deepEqual(looks(view), { near: [1, true], far: [0.22, false], glass: [0.1, false] });
});

test('nothing is seen through where no robot is followed, or it is in sight', () => {
  const view = shelves();
  view.reveal(new Vector3(-6, 0, 1), [new Vector3(0, 0, 0.2)]);
  view.reveal(new Vector3(0, -6, 1), [new Vector3(0, 0, 0.2)]);
  assert.deepEqual(looks(view).near, [1, true]);
  view.reveal(new Vector3(-6, 0, 1), []);
  assert.deepEqual(looks(view).near, [1, true]);
});
