// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { forgetLink, fragment, partOf } from '../src/address';
import { recall, remember } from '../src/remember';
import { Workspace } from '../src/workspace';
import { atFragment } from './page';

function workspace(kept: string, link = ''): Workspace {
  remember('tools', kept);
  atFragment(link);
  return new Workspace();
}

const placesOf = (there: Workspace, ...ids: string[]) => ids.map((id) => there.placeOf(id));

test('at first all tools are in the column, and Drive is whole', () => {
  const there = workspace('');
  assert.deepEqual(placesOf(there, 'graph', 'plots'), [null, null]);
  assert.equal(there.isDriveSmall, false);
});

test('a tool stands at one place, and a place has one tool', () => {
  const there = workspace('');
  there.put('graph', 'beside');
  there.put('log', 'below');
  assert.deepEqual(placesOf(there, 'graph', 'log'), ['beside', 'below']);
  there.put('graph', 'below');
  assert.deepEqual(placesOf(there, 'graph', 'log'), ['below', null]);
  there.put('health', 'beside');
  there.put('graph', null);
  assert.deepEqual(placesOf(there, 'graph', 'health'), [null, 'beside']);
});

test('the place of the plots is below, wherever nothing else stands there', () => {
  const there = workspace('');
  there.put('graph', 'below');
  there.put('plots', 'beside');
  assert.deepEqual(placesOf(there, 'graph', 'plots'), ['below', 'beside']);
  there.put('plots', 'below');
  assert.deepEqual(placesOf(there, 'graph', 'plots'), [null, null]);
});

test('it is kept, and whoever looks is told', () => {
  const there = workspace('');
  let changes = 0;
  there.onChange = () => (changes += 1);
  there.put('graph', 'beside');
  there.setDriveSmall(true);
  assert.equal(recall('tools'), 'beside.graph,drive.small');
  assert.deepEqual(placesOf(new Workspace(), 'graph'), ['beside']);
  assert.equal(new Workspace().isDriveSmall, true);
  there.reset();
  assert.equal(recall('tools'), '');
  assert.equal(changes, 3);
});

test('a link comes before what is kept, until something is changed', () => {
  const there = workspace('beside.log', '#plots=linear&tools=below.graph');
  assert.deepEqual(placesOf(there, 'log', 'graph'), [null, 'below']);
  assert.equal(recall('tools'), 'beside.log', 'one’s own layout stays until something is changed');
  assert.equal(partOf(fragment(), 'tools'), 'below.graph');
  there.put('health', 'beside');
  assert.equal(window.location.hash, '');
  assert.equal(recall('tools'), 'beside.health,below.graph');
});

test('of a text that means no layout nothing is taken', () => {
  for (const text of ['above.graph', 'beside', 'beside.', 'beside.<b>', 'below.plots', '.,.,', 'small.drive']) {
    const there = workspace(text);
    assert.deepEqual(placesOf(there, 'graph', '<b>', '', 'plots'), [null, null, null, null], text);
  }
  const twice = workspace('beside.graph,below.graph');
  assert.equal(twice.placeOf('graph'), 'beside');
  twice.setDriveSmall(false);
  assert.equal(recall('tools'), 'beside.graph');
});

test('a fragment that is no link of this page is left alone', () => {
  atFragment('#drive');
  forgetLink();
  assert.equal(window.location.hash, '#drive');
  assert.equal(partOf('#plots=a;b&tools=x', 'plots'), 'a;b');
  assert.equal(partOf('#tools', 'tools'), null);
});
