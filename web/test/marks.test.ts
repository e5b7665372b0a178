// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { BufferGeometry, InstancedMesh, Matrix4, Mesh, Points, Vector3, type Object3D } from 'three';
import type { MarkBatch, Marks, SensorInfo } from '../src/protocol';
import { batchesOf, type Sample } from '../src/samples';
import { MarkLayer } from '../src/scene/marks';
import type { Locate } from '../src/scene/sensors';
import { BadState } from '../src/state';

const TOPIC: SensorInfo = { topic: '/m', robot: '/', kind: 'markers', message: 'visualization_msgs/msg/MarkerArray' };
const BOX = [1, 2, 3, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0];
const POINT = [4, 5, 6, 0, 1, 0];
const nowhere = (): null => null;

function batch(kind: MarkBatch['kind'], known: Partial<MarkBatch> = {}): MarkBatch {
  return {
    kind, frame: 'base', stamp: 5, count: 1, opacity: 1, size: 0, resource: '', address: '', is_tinted: false, ...known,
  };
}

function marks(batches: readonly MarkBatch[], ...numbers: number[]): Sample<Marks> {
  const floats = new Float32Array(numbers);
  const head: Marks = {
    type: 'marks', origin: { topic: '/m', frame: 'base', stamp: 5, rate: 1 }, count: 1, shown: 1,
    batches: [...batches], texts: [], faults: [],
  };
  return { head, floats, bytes: new Uint8Array(floats.buffer) };
}

function layer(): MarkLayer {
  return new MarkLayer(() => {}, () => {});
}

/** A frame that is at x, as it is asked for. */
function at(x: number, isSettled = true): Locate {
  return () => ({ pose: new Matrix4().makeTranslation(x, 0, 0), isSettled });
}

function placeOf(made: MarkLayer, object: Object3D | undefined = made.object.children[0]?.children[0]): number[] {
  made.object.updateMatrixWorld(true);
  const matrix = object?.matrixWorld.clone() ?? new Matrix4();
  if (object instanceof InstancedMesh) {
    const own = new Matrix4();
    object.getMatrixAt(0, own);
    matrix.multiply(own);
  }
  return new Vector3().setFromMatrixPosition(matrix).toArray();
}

test('each batch has its own numbers, and no others', () => {
  const found = batchesOf(marks([batch('box'), batch('points')], ...BOX, ...POINT));
  assert.deepEqual(found.map(([, rows]) => rows.length), [13, 6]);
  assert.throws(() => batchesOf(marks([batch('box')], ...BOX, 1)), BadState);
});

test('marks are drawn where their frame was', () => {
  const made = layer();
  assert.ok(made.take(TOPIC, marks([batch('box'), batch('points')], ...BOX, ...POINT)));
  made.place(at(10), nowhere);
  assert.deepEqual(placeOf(made), [11, 2, 3]);
  assert.ok(made.object.children[0]?.children[1] instanceof Points);
  assert.deepEqual(made.numbers()['/m'], { kinds: { box: 1, points: 1 }, texts: [], hidden: 0 });
});

test('what has its place stays there when its frame goes on, also when it is sent again', () => {
  const made = layer();
  made.take(TOPIC, marks([batch('box')], ...BOX));
  made.place(at(10, false), nowhere); // a later state may know better
  made.place(at(20), nowhere);
  made.place(at(30), nowhere);
  assert.deepEqual(placeOf(made), [21, 2, 3]);
  made.take(TOPIC, marks([batch('box'), batch('box', { frame: 'other' })], ...BOX, ...BOX));
  made.place(at(40), nowhere);
  assert.deepEqual(placeOf(made), [21, 2, 3]);
  assert.deepEqual(placeOf(made, made.object.children[0]?.children[1]), [41, 2, 3]);
  made.unsettle(); // another frame stands still
  made.place(at(50), nowhere);
  assert.deepEqual(placeOf(made), [51, 2, 3]);
});

test('what is locked to its frame goes with it; without a stamp it stays', () => {
  for (const [stamp, x] of [[null, 31], [0, 21]] as const) {
    const made = layer();
    made.take(TOPIC, marks([batch('box', { stamp })], ...BOX));
    made.place(at(20, false), nowhere);
    made.place(at(30, false), nowhere);
    assert.deepEqual(placeOf(made), [x, 2, 3]);
  }
});

test('what has no place is hidden, but on a map that TF does not have yet', () => {
  const made = layer();
  made.take(TOPIC, marks([batch('box'), batch('box', { frame: 'map' })], ...BOX, ...BOX));
  const lost: Locate = () => ({ pose: null, isSettled: false });
  made.place(lost, () => new Matrix4());
  assert.equal(made.numbers()['/m']?.hidden, 1);
  assert.deepEqual(placeOf(made, made.object.children[0]?.children[1]), [1, 2, 3]);
});

test('a topic that is hidden is gone, and what is no mark is left to others', () => {
  const made = layer();
  made.take(TOPIC, marks([batch('box'), batch('lines')], ...BOX, ...POINT, ...POINT));
  made.retain(new Set(['/other']));
  assert.deepEqual([made.object.children.length, made.numbers()], [0, {}]);
  const other = { ...marks([]), head: { ...marks([]).head, type: 'path' as const, length: 0 } };
  assert.equal(made.take(TOPIC, other), false);
});

test('of meshes that no mark has any more nothing is kept', async () => {
  const freed: string[] = [];
  const read = (resource: string): Promise<Object3D> => {
    const mesh = new Mesh(new BufferGeometry());
    mesh.geometry.addEventListener('dispose', () => freed.push(resource));
    return Promise.resolve(mesh);
  };
  const made = new MarkLayer(() => {}, () => {}, undefined, read);
  const mesh = (name: string): Sample<Marks> => marks([batch('mesh', { resource: name, address: `/mesh/${name}` })], ...BOX);
  for (const name of ['a', 'b']) {
    made.take(TOPIC, mesh(name));
    await Promise.resolve();
  }
  assert.deepEqual(freed, ['a']);
  made.take(TOPIC, mesh('b'));
  assert.deepEqual(freed, ['a']);
  made.retain(new Set());
  assert.deepEqual(freed, ['a', 'b']);
});
