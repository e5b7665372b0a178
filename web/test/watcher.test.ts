// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Watcher } from '../src/watcher';

class Node {
  isThere = true;
  isSeen = true;
  heard: string[] = [];
  readonly watcher = new Watcher(
    ({ type, parts, topics = [] }) => {
      if (this.isThere) {
        this.heard.push([type, ...parts, ...topics].join(' '));
      }
      return this.isThere;
    },
    () => this.isSeen,
  );
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

test('sensors are told beside parts', () => {
  const { watcher, heard } = new Node();
  watcher.show([], ['/scan']);
  watcher.show(['wheels'], ['/scan', '/image', '/scan']);
  watcher.show([], []);
  assert.deepEqual(heard, ['watch /scan', 'watch wheels /image /scan', 'watch']);
});

test('a page behind other tabs shows nothing until it comes back', () => {
  const node = new Node();
  node.watcher.show(['wheels'], ['/scan']);
  node.isSeen = false;
  node.watcher.show(['wheels'], ['/scan']);
  node.watcher.show(['wheels'], ['/image']);
  node.isSeen = true;
  node.watcher.show(['wheels'], ['/scan']);
  assert.deepEqual(node.heard, ['watch wheels /scan', 'watch', 'watch wheels /scan']);
});
