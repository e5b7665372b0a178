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
    ({ type, parts, topics = [], messages = [], fields = {} }) => {
      if (this.isThere) {
        const plotted = Object.entries(fields).map(([topic, paths]) => `${topic}:${paths.join()}`);
        this.heard.push([type, ...parts, ...topics, ...messages, ...plotted].join(' '));
      }
      return this.isThere;
    },
    () => this.isSeen,
  );
}

test('a page that shows nothing special says nothing', () => {
  const { watcher, heard } = new Node();
  watcher.show({ parts: [] });
  watcher.show({ parts: [] });
  assert.deepEqual(heard, []);
});

test('what is shown is told once, however many show it, and that it is shown no more', () => {
  const { watcher, heard } = new Node();
  watcher.show({ parts: ['wheels'] });
  watcher.show({ parts: ['wheels', 'wheels'] });
  watcher.show({ parts: [] });
  watcher.show({ parts: [] });
  assert.deepEqual(heard, ['watch wheels', 'watch']);
});

test('a new connection is told anew, as soon as there is one', () => {
  const node = new Node();
  node.watcher.show({ parts: ['wheels'] });
  node.isThere = false;
  node.watcher.forget();
  node.watcher.show({ parts: ['wheels'] });
  node.isThere = true;
  node.watcher.show({ parts: ['wheels'] });
  assert.deepEqual(node.heard, ['watch wheels', 'watch wheels']);
});

test('a new connection is told nothing when nothing is shown by then', () => {
  const { watcher, heard } = new Node();
  watcher.show({ parts: ['wheels'] });
  watcher.forget();
  watcher.show({ parts: [] });
  assert.deepEqual(heard, ['watch wheels']);
});

test('sensors are told beside parts', () => {
  const { watcher, heard } = new Node();
  watcher.show({ parts: [], topics: ['/scan'] });
  watcher.show({ parts: ['wheels'], topics: ['/scan', '/image', '/scan'] });
  watcher.show({ parts: [], topics: [] });
  assert.deepEqual(heard, ['watch /scan', 'watch wheels /image /scan', 'watch']);
});

test('a page behind other tabs shows nothing until it comes back', () => {
  const node = new Node();
  node.watcher.show({ parts: ['wheels'], topics: ['/scan'] });
  node.isSeen = false;
  node.watcher.show({ parts: ['wheels'], topics: ['/scan'] });
  node.watcher.show({ parts: ['wheels'], topics: ['/image'] });
  node.isSeen = true;
  node.watcher.show({ parts: ['wheels'], topics: ['/scan'] });
  assert.deepEqual(node.heard, ['watch wheels /scan', 'watch', 'watch wheels /scan']);
});

test('plots go on behind other tabs, whole messages do not', () => {
  const node = new Node();
  const shown = { parts: [], messages: ['/odom'], fields: { '/odom': ['b', 'a', 'b'] } };
  node.watcher.show(shown);
  node.watcher.show({ ...shown, fields: { '/odom': ['a', 'b'] } });
  node.isSeen = false;
  node.watcher.show(shown);
  assert.deepEqual(node.heard, ['watch /odom /odom:a,b', 'watch /odom:a,b']);
});
