// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { connectedApp, graphOf, robotInfo, type TestApp } from './page';
import { keepChoice } from '../src/choice';

/** A page that is loaded anew, in a ROS domain with two robots. */
function loaded(domain: number): TestApp {
  const app = connectedApp();
  keepChoice(app.store);
  app.say({ type: 'hello', client: 'page 1', version: '1', domain, rate: 60, drive_timeout: 0.4 });
  app.say(graphOf([robotInfo({ id: '/one' }), robotInfo({ id: '/two' })]));
  return app;
}

test('the chosen robot is so again after a reload, in its domain', () => {
  const first = loaded(1);
  assert.equal(first.store.robot?.id, '/one');
  first.store.choose('/two');
  assert.equal(loaded(1).store.robot?.id, '/two');
  assert.equal(loaded(2).store.robot?.id, '/one');
});

test('a choice stands when the connection was lost meanwhile', () => {
  const page = loaded(3);
  page.store.choose('/two');
  loaded(3).store.choose('/one'); // another page of this browser
  page.say({ type: 'hello', client: 'page 1', version: '1', domain: 3, rate: 60, drive_timeout: 0.4 });
  page.say(graphOf([robotInfo({ id: '/one' }), robotInfo({ id: '/two' })]));
  assert.equal(page.store.robot?.id, '/two');
});
