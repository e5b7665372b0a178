// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { sensorsPanel, type SensorsPanel } from '../src/panels/sensors';
import type { Head, Layout, Origin, SensorInfo } from '../src/protocol';
import type { Sample } from '../src/samples';
import { Sensing } from '../src/sensors/sensing';
import { connectedApp, drawn, find, graphOf, robotInfo, texts, unknownState, type TestApp } from './page';

const LAYOUT: Layout = {
  type: 'layout', id: 1, frames: [{ name: 'laser', parent: 'base' }], robots: [],
};

function sensor(topic: string, kind: SensorInfo['kind'], message: string): SensorInfo {
  return { topic, robot: '/', kind, message: `sensor_msgs/msg/${message}` };
}

const SCAN = sensor('/scan', 'scan', 'LaserScan');
const CAMERA = sensor('/camera/compressed', 'picture', 'CompressedImage');

interface Shown {
  app: TestApp;
  sensing: Sensing;
  panel: SensorsPanel;
}

function shown(...sensors: SensorInfo[]): Shown {
  const app = connectedApp();
  app.say(graphOf([robotInfo()], { sensors }));
  const sensing = new Sensing(app.store);
  return { app, sensing, panel: sensorsPanel(app, sensing) };
}

function origin(topic: string, frame: string): Origin {
  return { topic, frame, stamp: 9.5, rate: 10 };
}

function sample(head: Head, ...numbers: number[]): Sample {
  const floats = new Float32Array(numbers);
  return { head, floats, bytes: new Uint8Array(floats.buffer) };
}

function scan(frame: string): Sample {
  const head: Head = {
    type: 'scan', origin: origin('/scan', frame), angle_min: 0, angle_increment: 0.1,
    range_min: 0.1, range_max: 10, count: 3,
  };
  return sample(head, 4, 0.5, 2);
}

async function pulse(panel: SensorsPanel): Promise<void> {
  panel.pulse?.({ ...unknownState(LAYOUT), time: 10 });
  await drawn();
}

test('without sensors the panel says which kinds there could be', () => {
  assert.match(texts(shown().panel, '.empty')[0] ?? '', /^No sensor of this robot publishes/);
});

test('a sensor is on or off, and only what is on is asked for', async () => {
  const { app, panel } = shown(SCAN, CAMERA);
  assert.deepEqual(texts(panel, '.unit-name'), ['/scan', '/camera']);
  assert.deepEqual(texts(panel, '.chip'), ['LaserScan', 'CompressedImage']);
  assert.deepEqual(panel.topics, ['/scan'], 'a scan is small');
  const switches = [...panel.element.querySelectorAll<HTMLElement>('.switch')];
  const [scanKnob, cameraKnob] = switches as [HTMLElement, HTMLElement];
  cameraKnob.click();
  scanKnob.click();
  await drawn();
  assert.equal(cameraKnob.getAttribute('aria-checked'), 'true');
  assert.deepEqual(panel.topics, ['/camera/compressed']);
  app.say(graphOf([robotInfo()], { sensors: [CAMERA, SCAN, sensor('/range', 'range', 'Range')] }));
  await drawn();
  const knobs = [...panel.element.querySelectorAll('.switch')];
  assert.deepEqual([knobs.indexOf(cameraKnob), knobs.indexOf(scanKnob)], [0, 1], 'the focus stays');
  scanKnob.click();
  cameraKnob.click();
  await drawn();
});

test('what was measured is in words, and why it is not in the view', async () => {
  const { sensing, panel } = shown(SCAN);
  await pulse(panel);
  assert.deepEqual(texts(panel, '.sensor > .fine'), ['nothing has come yet']);
  sensing.take(scan('laser'));
  await pulse(panel);
  assert.match(texts(panel, '.sensor > .fine')[0] ?? '', /0\.50 s old/);
  assert.deepEqual(texts(panel, '.measured'), ['3 rays · nearest 0.50 m']);
  sensing.take(scan('lost'));
  await pulse(panel);
  assert.match(texts(panel, '.measured')[0] ?? '', /its frame "lost" is not in TF/);
  sensing.take(sample({ type: 'unreadable', origin: origin('/scan', 'laser'), text: 'too short', channel: 'sensor' }));
  await pulse(panel);
  assert.deepEqual(texts(panel, '.measured'), ['too short']);
  assert.equal(find(panel, '.measured').dataset.tone, 'warning');
});

test('a cloud says how much of it is shown, and all of it is asked for', async () => {
  const { sensing, panel } = shown(sensor('/points', 'cloud', 'PointCloud2'));
  find(panel, '.switch').click();
  const cloud = (count: number): Sample => sample({
    type: 'cloud', origin: origin('/points', 'laser'), count, colouring: 'none', low: null, high: null,
  }, 1, 2, 3, 4, 5, 6);
  sensing.take(cloud(2));
  await pulse(panel);
  assert.deepEqual(texts(panel, '.measured'), ['2 points']);
  assert.equal(panel.element.querySelector('.toggle'), null, 'these are all');
  sensing.take(cloud(300_000));
  await pulse(panel);
  assert.deepEqual(texts(panel, '.measured'), ['2 of 300\u202f000 points']);
  assert.deepEqual(sensing.whole, []);
  find(panel, '.toggle').click();
  await drawn();
  assert.deepEqual(sensing.whole, ['/points']);
  assert.equal(find(panel, '.toggle').getAttribute('aria-pressed'), 'true');
  sensing.take(cloud(2));
  await pulse(panel);
  find(panel, '.toggle').click();
  await drawn();
  assert.deepEqual(sensing.whole, []);
  find(panel, '.switch').click();
});

test('a picture is drawn once, and its place goes when it is switched off', async () => {
  Object.assign(globalThis, {
    createImageBitmap: () => Promise.resolve({ width: 4, height: 2, close: () => {} }),
  });
  const { sensing, panel } = shown(CAMERA);
  assert.equal(panel.element.querySelector('canvas'), null);
  const knob = find(panel, '.switch');
  knob.click();
  await pulse(panel);
  assert.equal(find(panel, 'canvas').hidden, true, 'until there is a picture');
  sensing.take(sample({
    type: 'picture', origin: origin(CAMERA.topic, 'camera'), format: 'image/jpeg',
    encoding: 'rgb8', width: 640, height: 320, low: null, high: null,
  }));
  await pulse(panel);
  await pulse(panel);
  const canvas = find(panel, 'canvas') as HTMLCanvasElement;
  assert.deepEqual([canvas.hidden, canvas.width, canvas.height], [false, 4, 2]);
  assert.deepEqual(panel.drawn, { [CAMERA.topic]: 1 });
  knob.click();
  await drawn();
  assert.equal(panel.element.querySelector('canvas'), null);
});

test('a sample is shown also where no newer state has come', async () => {
  const { sensing, panel } = shown(SCAN);
  const state = { ...unknownState(LAYOUT), time: 10 };
  panel.pulse?.(state);
  await drawn();
  sensing.take(scan('laser'));
  panel.pulse?.(state);
  await drawn();
  assert.deepEqual(texts(panel, '.measured'), ['3 rays · nearest 0.50 m']);
});
