// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Watcher } from '../src/watcher';

class Node {
  isThere = true;
  heard: string[] = [];
  readonly watcher = new Watcher(({ type, parts }) => {
    if (this.isThere) {
      this.heard.push([type, ...parts].join(' '));
    }
    return this.isThere;
  });
}

test('a page that shows nothing special says nothing', () => {
  const { watcher, heard } = new Node();
  watcher.show([]);
  watcher.show([]);
  assert.deepEqual(heard, []);
});

test('what is shown is told once, however many show it, and that it is shown no more', () => {
  const { watcher, heard } = new Node();
  watcher.show(['wheels']);
  watcher.show(['wheels', 'wheels']);
  watcher.show([]);
  watcher.show([]);
  assert.deepEqual(heard, ['watch wheels', 'watch']);
});

test('a new connection is told anew, as soon as there is one', () => {
  const node = new Node();
  node.watcher.show(['wheels']);
  node.isThere = false;
  node.watcher.forget();
  node.watcher.show(['wheels']);
  node.isThere = true;
  node.watcher.show(['wheels']);
  assert.deepEqual(node.heard, ['watch wheels', 'watch wheels']);
});

test('a new connection is told nothing when nothing is shown by then', () => {
  const { watcher, heard } = new Node();
  watcher.show(['wheels']);
  watcher.forget();
  watcher.show([]);
  assert.deepEqual(heard, ['watch wheels']);
});
