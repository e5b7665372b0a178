// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { BagWriting, SensorInfo } from '../src/protocol';
import { recordButton } from '../src/recording/record_button';
import { connectedApp, drawn, graphOf, robotInfo, type TestApp } from './page';

const IMAGE = 'sensor_msgs/msg/Image';
const CLOUD = 'sensor_msgs/msg/PointCloud2';
const NOTHING: BagWriting = {
  type: 'bag_writing', active: false, path: '', seconds: 0, messages: 0, size: 0, topics: 0, lost: 0, error: '',
  folder: '/home/me/bags', free: 12.34e9,
};

function sensor(kind: SensorInfo['kind'], message: string): SensorInfo {
  return { topic: `/${kind}`, robot: '/', kind, message };
}

async function shown(...sensors: SensorInfo[]): Promise<{ app: TestApp; element: HTMLElement; click: (at: string) => Promise<void> }> {
  const app = connectedApp();
  const element = recordButton(app);
  app.say(graphOf([robotInfo()], { sensors }));
  app.say(NOTHING);
  await drawn();
  const click = async (at: string): Promise<void> => {
    element.querySelector<HTMLElement>(at)?.click();
    await drawn();
  };
  return { app, element, click };
}

function asked(app: TestApp): unknown {
  const [last] = app.sent.flatMap((each) => (each.type === 'start_recording' ? [each] : [])).slice(-1);
  return { topics: last?.topics, without: last?.without_types };
}

test('where nothing is bulky all is recorded at one press', async () => {
  const { app, click } = await shown(sensor('scan', 'sensor_msgs/msg/LaserScan'));
  await click('.button');
  assert.deepEqual(asked(app), { topics: [], without: [] });
});

test('pictures and clouds are recorded only if that is wanted, and what is free is said', async () => {
  const { app, element, click } = await shown(sensor('picture', IMAGE), sensor('cloud', CLOUD));
  assert.match(element.textContent ?? '', /12\.3 GB free in \/home\/me\/bags/);
  await click('.record-offer .button');
  assert.deepEqual(asked(app), { topics: [], without: [IMAGE, CLOUD] });
  await click('.record-offer .switch');
  await click('.record-offer .button');
  assert.deepEqual(asked(app), { topics: [], without: [CLOUD] });
  await click('.record-offer .switch'); // it is remembered
});

test('how much a recording takes is said, and when there is little room', async () => {
  const { app, element } = await shown();
  app.say({ ...NOTHING, active: true, seconds: 10, size: 25e6, path: '/bag' });
  await drawn();
  assert.equal(element.querySelector('.recorder-words')?.textContent, '10 s · 25.0 MB · 2.5 MB/s');
  app.say({ ...NOTHING, active: true, seconds: 10, size: 25e6, path: '/bag', free: 0.5e9 });
  await drawn();
  assert.equal(
    element.querySelector('.recorder-words')?.textContent, '10 s · 25.0 MB · 2.5 MB/s · only 500 MB free',
  );
});
