// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Matrix4, Vector3 } from 'three';
import { drawn, connectedApp, graphOf, robotInfo, type TestApp } from './page';
import { pointTools } from '../src/pointing';
import type { Scene } from '../src/scene/scene';

interface Bench {
  app: TestApp;
  buttons: HTMLElement[];
  words: HTMLElement;
  /** Click a point of the page. */
  click: (x: number, y: number) => void;
  press: (key: string) => void;
  measured: string[];
}

/** A view of the ground, in which a point of the page is as many metres from the middle of `odom`. */
function bench(): Bench {
  const app = connectedApp();
  app.say(graphOf([robotInfo()]));
  app.say({ type: 'layout', id: 1, frames: [{ name: 'base', parent: 'odom' }], robots: [] });
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const measured: string[] = [];
  let ask: [((x: number, y: number) => void) | null, () => void] = [null, () => {}];
  const scene = {
    canvas,
    fixedFrame: 'world',
    askForPoint: (...asked: typeof ask) => void (ask = asked),
    surfaceAt: (x: number, y: number) => (y < 0 ? null : new Vector3(x, y, 0)),
    measure: (_: unknown, __: unknown, text: string) => void measured.push(text),
    poseOfFrame: (frame: string) => (frame === 'odom' ? new Matrix4().makeTranslation(1, 0, 0) : null),
  };
  const tools = pointTools(app, scene as unknown as Scene);
  const click = (x: number, y: number): void => {
    ask[0]?.(x, y);
    ask[1]();
  };
  const press = (key: string): void => {
    canvas.dispatchEvent(Object.assign(new Event('keydown', { bubbles: true }), { key }));
  };
  return { app, ...tools, click, press, measured };
}

test('two clicks measure, and what was measured stays until the tool is put down', () => {
  const { buttons, words, click, press, measured } = bench();
  assert.equal(words.hidden, true);
  buttons[0]!.click();
  assert.match(words.textContent, /^From where/);
  click(1, 1);
  assert.equal(words.textContent, 'To where?');
  click(4, 5);
  assert.equal(words.textContent, '5.000 m (x 3.000, y 4.000, z 0.000)');
  assert.equal(measured.at(-1), '5.000 m');
  press('Escape');
  assert.deepEqual([words.hidden, measured.at(-1)], [true, '']);
  assert.equal(buttons[0]!.getAttribute('aria-pressed'), 'false');
});

test('a point is published once, in a frame that TF has', async () => {
  const { app, buttons, words, click } = bench();
  buttons[1]!.click();
  click(3, 2);
  const values = { header: { stamp: 'now', frame_id: 'odom' }, point: { x: 2, y: 2, z: 0 } };
  assert.deepEqual(app.sent.at(-1), {
    type: 'publish', id: 1, topic: '/clicked_point', message: 'geometry_msgs/msg/PointStamped', values, rate: 0,
  });
  assert.equal(words.hidden, true);
  app.say({ type: 'reply', id: 1, ok: true, message: '', data: null, again: null });
  await drawn();
  assert.equal(app.store.notices[0]?.text, 'Published on /clicked_point: 2.000, 2.000, 0.000 in odom');
});

test('keys alone do it: Enter takes the middle of the view', () => {
  const { app, buttons, press } = bench();
  buttons[1]!.click();
  press('Enter');
  assert.equal(app.sent.length, 1);
  press('Enter'); // the tool is put down
  assert.equal(app.sent.length, 1);
});

test('above the horizon there is nothing to point at', () => {
  const { app, buttons, words, click } = bench();
  buttons[1]!.click();
  click(0, -1);
  assert.match(words.textContent, /nothing to point at/);
  assert.deepEqual(app.sent, []);
});
