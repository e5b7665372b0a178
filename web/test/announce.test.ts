// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { announce } from '../src/announce';
import { ask, type App } from '../src/app';
import { connectedApp, drawn, find, texts } from './page';

const SPAWN = {
  type: 'spawn', simulator: '/sim', name: 'robot1', namespace: '/robot1', position: [0, 0, 0], yaw: 0, like: '/',
} as const;

function spawn(app: App): Promise<boolean> {
  return ask(app, { ...SPAWN, position: [0, 0, 0] });
}

test('what was done in part is an error, and can be tried again', async () => {
  const app = connectedApp();
  const panel = { element: announce(app) };
  void spawn(app);
  const again = { type: 'set_up', robot: '/robot1', like: '/' };
  const message = "'robot1' is in the world, but its controllers are not active";
  app.say({ type: 'reply', id: 1, ok: false, message, data: null, again });
  await drawn();
  assert.deepEqual(texts(panel, '.toast p'), [message]);
  assert.equal(find(panel, '.toast').dataset.tone, 'error');
  find(panel, '.toast .button:not(.quiet)').click();
  assert.deepEqual(app.sent.at(-1), { ...again, id: 2 });
  assert.deepEqual(texts(panel, '.toast'), [], 'it was tried');
  app.say({ type: 'reply', id: 2, ok: true, message: 'active: drive', data: null, again: null });
  await drawn();
  assert.deepEqual(texts(panel, '.toast p'), ['active: drive']);
  assert.equal(find(panel, '.toast').dataset.tone, 'info');
});

test('what cannot be tried again has no button for it', async () => {
  const app = connectedApp();
  const panel = { element: announce(app) };
  void spawn(app);
  app.say({ type: 'reply', id: 1, ok: false, message: 'no', data: null, again: null });
  await drawn();
  assert.deepEqual(texts(panel, '.toast .button'), ['']);
});
