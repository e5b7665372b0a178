// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4, Mesh, MeshBasicMaterial } from 'three';
import { atFragment } from './page';
import { fragment } from '../src/address';
import type { Scan, SensorInfo } from '../src/protocol';
import { remember } from '../src/remember';
import type { Sample } from '../src/samples';
import { Grids } from '../src/scene/grids';
import type { DynamicPoints } from '../src/scene/points';
import { SensorLayer } from '../src/scene/sensors';
import { PALETTES } from '../src/scene/theme';
import { Looks } from '../src/sensors/looks';

const SCAN: SensorInfo = { topic: '/scan', robot: '/', kind: 'scan', message: 'sensor_msgs/msg/LaserScan' };

function fresh(): Looks {
  remember('looks', '');
  atFragment('');
  return new Looks();
}

function scan(stamp: number): Sample<Scan> {
  const floats = new Float32Array([1, 2]);
  const head: Scan = {
    type: 'scan', origin: { topic: '/scan', frame: 'laser', stamp, rate: 10 }, angle_min: 0,
    angle_increment: 0.1, range_min: 0, range_max: 10, count: 2,
  };
  return { head, floats, bytes: new Uint8Array(floats.buffer) };
}

/** How many sets of points are drawn of a scan that came at these times. */
function drawn(layer: SensorLayer, ...stamps: number[]): number {
  layer.setPalette(PALETTES.light);
  for (const stamp of stamps) {
    layer.take(SCAN, scan(stamp));
    layer.place(() => ({ pose: new Matrix4(), isSettled: true }));
  }
  return layer.points.children.length;
}

test('a topic is drawn as its kind is at first, until something is chosen', () => {
  const looks = fresh();
  assert.deepEqual(looks.of(SCAN), { size: 4, colouring: 'plain', opacity: 1, decay: 0, order: 0 });
  looks.set('/scan', { size: 8 });
  looks.set('/scan', { colouring: 'height' });
  assert.deepEqual(looks.of(SCAN), { size: 8, colouring: 'height', opacity: 1, decay: 0, order: 0 });
  assert.deepEqual([looks.isOwn('/scan'), looks.isOwn('/points')], [true, false]);
  looks.set('/scan', null);
  assert.equal(looks.of(SCAN).size, 4);
});

test('what was chosen is kept, and in the link', () => {
  const looks = fresh();
  looks.set('/scan', { size: 8, opacity: 0.5 });
  assert.deepEqual(new Looks().of(SCAN).opacity, 0.5);
  assert.match(fragment(), /looks=\/scan:size\.8,opacity\.0\.5/);
});

test('a link says how, and what is out of bounds in it does no harm', () => {
  fresh();
  atFragment('#looks=/scan:size.900,colouring.height,order.-11;/map:opacity.x;nothing;/a b:size.2;/c:colour.1');
  const looks = new Looks();
  assert.deepEqual(looks.of(SCAN), { size: 20, colouring: 'height', opacity: 1, decay: 0, order: -10 });
  assert.equal(looks.of({ topic: '/map', kind: 'map' }).opacity, 1);
  assert.deepEqual(['nothing', '/a b', '/c'].filter((each) => looks.isOwn(each)), []);
  atFragment('');
});

test('points are as large, as clear and as high as told', () => {
  const looks = fresh();
  const layer = new SensorLayer((info) => looks.of(info));
  drawn(layer, 1);
  looks.set('/scan', { size: 9, opacity: 0.5, order: 3 });
  layer.restyle('/scan');
  const { material, renderOrder } = layer.points.children[0] as DynamicPoints['object'];
  assert.equal(renderOrder, 3);
  assert.deepEqual([material.size, material.opacity, material.transparent], [9, 0.5, true]);
});

test('points stay as long as told, and none of a time to come', () => {
  const looks = fresh();
  looks.set('/scan', { decay: 2 });
  const layer = new SensorLayer((info) => looks.of(info));
  assert.equal(drawn(layer, 1, 2, 3), 3);
  assert.equal(drawn(layer, 4.5), 2, 'those of 1 s and 2 s have gone');
  assert.equal(drawn(layer, 0.5), 1, 'after a reset');
  drawn(layer, 1);
  looks.set('/scan', null);
  layer.restyle('/scan');
  assert.equal(layer.points.children.length, 1);
});

test('a map lies over a costmap where that is told, and never over the marks of robots', () => {
  const orders: Record<string, number> = { '/map': 0, '/global_costmap/costmap': 0 };
  const grids = new Grids(() => {}, () => {}, (topic) => ({ opacity: 1, order: orders[topic] ?? 0 }));
  const known = grids as unknown as { shown: Map<string, { mesh: Mesh }> };
  for (const topic of Object.keys(orders)) {
    known.shown.set(topic, { mesh: new Mesh(undefined, new MeshBasicMaterial()) });
  }
  const heights = (): number[] => Object.keys(orders).map((topic) => {
    grids.restyle(topic);
    return known.shown.get(topic)!.mesh.renderOrder;
  });
  assert.deepEqual(heights(), [2, 2.5]);
  orders['/map'] = 8;
  assert.ok(heights()[0]! > 2.5);
  orders['/global_costmap/costmap'] = 10;
  assert.ok(heights()[1]! < 3);
});
