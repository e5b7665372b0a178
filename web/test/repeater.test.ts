// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Repeater, type RepeaterPort } from '../src/socket/repeater';

const DRIVE = JSON.stringify({ type: 'drive', robot: '/', linear: 0.5, angular: 0 });
const STOP = JSON.stringify({ type: 'stop', robot: '/' });
const WATCH = JSON.stringify({ type: 'watch', parts: [] });

/** A world outside whose time is ours. */
class Outside implements RepeaterPort {
  time = 0;
  sent: { at: number; text: string }[] = [];
  silences: number[] = []; // s, of which the page was told
  private due: { at: number; call: () => void } | null = null;

  send(text: string): void {
    this.sent.push({ at: this.time, text });
  }

  left(seconds: number): void {
    this.silences.push(seconds);
  }

  now(): number {
    return this.time;
  }

  after(milliseconds: number, call: () => void): () => void {
    const entry = { at: this.time + milliseconds, call };
    this.due = entry;
    return () => {
      this.due = this.due === entry ? null : this.due;
    };
  }

  pass(milliseconds: number): void {
    const end = this.time + milliseconds;
    while (this.due !== null && this.due.at <= end) {
      const { at, call } = this.due;
      this.due = null;
      this.time = at;
      call();
    }
    this.time = end;
  }
}

function repeating(): { outside: Outside; repeater: Repeater } {
  const outside = new Outside();
  return { outside, repeater: new Repeater(outside) };
}

test('a drive goes out at once, and again well within the time limit of the node', () => {
  const { outside, repeater } = repeating();
  repeater.send(DRIVE);
  outside.pass(900); // the page is busy with drawing
  const times = outside.sent.map(({ at }) => at);
  const gaps = times.slice(1).map((time, index) => time - times[index]!);
  assert.equal(times[0], 0);
  assert.ok(Math.max(...gaps) <= 34, `${Math.max(...gaps)} ms`);
  assert.ok(times.length >= 27);
});

test('a page that says nothing any more does not drive on', () => {
  const { outside, repeater } = repeating();
  repeater.send(DRIVE);
  outside.pass(5000);
  assert.ok((outside.sent.at(-1)?.at ?? 0) <= 1034, `${outside.sent.at(-1)?.at} ms`);
  const count = outside.sent.length;
  repeater.hear();
  outside.pass(5000);
  assert.equal(outside.sent.length, count, 'that it comes back is no word to drive');
});

test('a page that was not heard is told so once it is there, and drives no more until it has let go', () => {
  for (const end of [(it: Repeater) => it.send(STOP), (it: Repeater) => it.rest()]) {
    const { outside, repeater } = repeating();
    repeater.send(DRIVE);
    outside.pass(2500);
    assert.deepEqual(outside.silences, [], 'it could not hear it');
    outside.sent = [];
    repeater.send(DRIVE); // of a hand that it does not know yet to have been let go
    repeater.hear();
    outside.pass(500);
    assert.deepEqual(outside.silences, [2.5]);
    assert.deepEqual(outside.sent, []);
    end(repeater);
    repeater.send(DRIVE);
    outside.pass(100);
    assert.ok(outside.sent.filter(({ text }) => text === DRIVE).length >= 3);
    assert.deepEqual(outside.silences, [2.5]);
  }
});

test('a page that lets go after it was not heard is told so, and can drive', () => {
  const { outside, repeater } = repeating();
  repeater.send(DRIVE);
  outside.pass(1500);
  repeater.send(STOP);
  assert.deepEqual(outside.silences, [1.5]);
  repeater.send(DRIVE);
  assert.deepEqual(outside.sent.slice(-2).map(({ text }) => text), [STOP, DRIVE]);
});

test('a page that is there, but slow, drives on', () => {
  const { outside, repeater } = repeating();
  repeater.send(DRIVE);
  for (let step = 0; step < 10; step += 1) {
    outside.pass(800);
    repeater.hear();
  }
  assert.ok(8000 - (outside.sent.at(-1)?.at ?? 0) <= 34);
});

test('a stop ends it, and so does rest, of which nothing is sent', () => {
  for (const end of [(it: Repeater) => it.send(STOP), (it: Repeater) => it.rest()]) {
    const { outside, repeater } = repeating();
    repeater.send(DRIVE);
    outside.pass(10);
    end(repeater);
    outside.pass(500);
    assert.deepEqual(outside.sent.filter(({ at }) => at > 10), []);
  }
});

test('other messages go out once, and change nothing', () => {
  const { outside, repeater } = repeating();
  repeater.send(WATCH);
  outside.pass(500);
  assert.equal(outside.sent.length, 1);
  repeater.send(DRIVE);
  repeater.send(WATCH);
  outside.pass(110);
  assert.equal(outside.sent.filter(({ text }) => text === WATCH).length, 2);
  assert.equal(outside.sent.filter(({ text }) => text === DRIVE).length, 4);
});
