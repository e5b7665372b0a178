// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pilot, type PilotPort } from '../src/drive/pilot';
import type { Drive, Stop } from '../src/protocol';

const AHEAD = { forward: 1, turn: 0 };
const LEFT = { forward: 0, turn: 1 };

/** A world outside whose time is ours. */
class Outside implements PilotPort {
  time = 0;
  open = true;
  sent: { at: number; message: Drive | Stop }[] = [];
  rests = 0;
  private calls: { at: number; call: () => void }[] = [];

  send(message: Drive | Stop): boolean {
    if (this.open) {
      this.sent.push({ at: this.time, message });
    }
    return this.open;
  }

  rest(): void {
    this.rests += 1;
  }

  now(): number {
    return this.time;
  }

  after(milliseconds: number, call: () => void): () => void {
    const entry = { at: this.time + milliseconds, call };
    this.calls.push(entry);
    return () => {
      this.calls = this.calls.filter((other) => other !== entry);
    };
  }

  pass(milliseconds: number): void {
    const end = this.time + milliseconds;
    for (;;) {
      const [first] = this.calls.sort((one, other) => one.at - other.at);
      if (first === undefined || first.at > end) {
        break;
      }
      this.calls.shift();
      this.time = first.at;
      first.call();
    }
    this.time = end;
  }

  get last(): Drive | Stop | undefined {
    return this.sent.at(-1)?.message;
  }

  get waiting(): number {
    return this.calls.length;
  }
}

function piloting(): { outside: Outside; pilot: Pilot } {
  const outside = new Outside();
  const pilot = new Pilot(outside);
  pilot.setRobot('/');
  return { outside, pilot };
}

test('a hand drives at once, in the units of the robot', () => {
  const { outside, pilot } = piloting();
  pilot.setLimits({ linear: 0.4, angular: 2 });
  pilot.set('keys', AHEAD);
  assert.deepEqual(outside.last, { type: 'drive', robot: '/', linear: 0.4, angular: 0 });
  assert.equal(outside.sent[0]!.at, 0);
});

test('a robot that can goes sideways, with the limit of its speed', () => {
  const { outside, pilot } = piloting();
  pilot.setLimits({ linear: 0.4, angular: 2 });
  pilot.set('keys', { forward: 0, turn: 0, left: -1 });
  assert.deepEqual(outside.last, {
    type: 'drive', robot: '/', linear: 0, angular: 0, sideways: -0.4,
  });
  pilot.set('keys', { forward: 0, turn: 0, left: 1 });
  outside.pass(100);
  assert.equal((outside.last as Drive).sideways, 0.4);
});

test('changes go out at once, at most 60 times a second, and the last one always', () => {
  const { outside, pilot } = piloting();
  for (let step = 1; step <= 100; step += 1) {
    pilot.set('stick', { forward: step / 100, turn: 0 });
    outside.pass(1);
  }
  outside.pass(20);
  const drives = outside.sent.filter((sent) => sent.message.type === 'drive');
  assert.ok(drives.length <= 9, `${drives.length} in 120 ms`);
  assert.deepEqual(outside.last, { type: 'drive', robot: '/', linear: 0.5, angular: 0 });
});

test('letting go stops at once, and nothing follows', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  outside.pass(5);
  pilot.set('keys', null);
  assert.deepEqual(outside.last, { type: 'stop', robot: '/' });
  assert.equal(outside.sent.at(-1)?.at, 5);
  const count = outside.sent.length;
  outside.pass(2000);
  assert.equal(outside.sent.length, count);
  assert.equal(outside.waiting, 0);
});

test('two hands add up; the robot stops when the last lets go', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  pilot.set('stick', LEFT);
  outside.pass(20);
  assert.deepEqual(outside.last, { type: 'drive', robot: '/', linear: 0.5, angular: 1 });
  pilot.set('keys', null);
  outside.pass(20);
  assert.deepEqual(outside.last, { type: 'drive', robot: '/', linear: 0, angular: 1 });
  pilot.set('stick', null);
  assert.equal(outside.last?.type, 'stop');
});

test('a lost focus stops, and a key that is still down does not drive on', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  pilot.release();
  assert.deepEqual(outside.last, { type: 'stop', robot: '/' });
  pilot.set('keys', LEFT);
  outside.pass(100);
  assert.equal(pilot.driving, false);
  assert.equal(outside.sent.length, 2);
  pilot.set('keys', null);
  pilot.set('keys', AHEAD);
  assert.equal(outside.sent.at(-1)?.message.type, 'drive');
});

test('a lost focus says nothing to a robot that nobody drives', () => {
  const { outside, pilot } = piloting();
  pilot.release();
  assert.deepEqual(outside.sent, []);
});

test('the big stop is for every robot, driven by whomever, at any time', () => {
  const { outside, pilot } = piloting();
  pilot.stop();
  assert.deepEqual(outside.last, { type: 'press_stop', robot: null });
  pilot.set('keys', AHEAD);
  pilot.stop();
  assert.deepEqual(outside.last, { type: 'press_stop', robot: null });
  assert.equal(pilot.driving, false);
  assert.equal(outside.waiting, 0);
});

test('a closed connection lets go', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  outside.pass(100);
  outside.open = false;
  pilot.set('keys', LEFT);
  assert.equal(pilot.driving, false);
  outside.open = true;
  outside.pass(1000);
  assert.equal(outside.sent.length, 1);
});

test('when somebody else stops our robot, a held key does not drive on', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  outside.pass(1000);
  assert.equal(pilot.halt(), true);
  assert.equal(pilot.halt(), false, 'there is none to let go any more');
  const count = outside.sent.length;
  outside.pass(1000);
  assert.equal(pilot.driving, false);
  assert.equal(outside.rests, 1, 'the last drive is repeated no more');
  assert.equal(outside.sent.length, count, 'a stop is not answered by a stop');
  pilot.set('keys', LEFT);
  assert.equal(pilot.driving, false, 'held from before');
  pilot.set('keys', null);
  pilot.set('keys', LEFT);
  assert.equal(outside.last?.type, 'drive');
});

test('what another page drives is not driven from here, and it is said once', () => {
  const { outside, pilot } = piloting();
  let refusals = 0;
  pilot.onRefused = () => {
    refusals += 1;
  };
  pilot.setTaken(true);
  pilot.set('stick', AHEAD);
  pilot.set('stick', LEFT);
  outside.pass(1000);
  assert.deepEqual(outside.sent, []);
  assert.equal(refusals, 1);
  pilot.setTaken(false);
  pilot.set('stick', AHEAD);
  assert.deepEqual(outside.sent, [], 'held from before');
  pilot.set('stick', null);
  pilot.set('stick', AHEAD);
  assert.equal(outside.last?.type, 'drive');
});

test('when another page takes the wheel, ours lets go without a stop', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  pilot.setTaken(true);
  outside.pass(1000);
  assert.equal(outside.sent.length, 1);
  assert.equal(pilot.driving, false);
});

test('driving another robot stops the one before', () => {
  const { outside, pilot } = piloting();
  pilot.set('keys', AHEAD);
  pilot.setRobot('/robot1');
  assert.deepEqual(outside.last, { type: 'stop', robot: '/' });
  assert.equal(pilot.driving, false);
});

test('without a robot nothing is sent', () => {
  const outside = new Outside();
  const pilot = new Pilot(outside);
  pilot.set('keys', AHEAD);
  outside.pass(1000);
  assert.deepEqual(outside.sent, []);
});

test('what is asked is told: velocities, then null', () => {
  const { pilot } = piloting();
  const told: unknown[] = [];
  pilot.onChange = (velocity) => told.push(velocity);
  pilot.set('keys', AHEAD);
  pilot.set('keys', AHEAD);
  pilot.set('keys', null);
  assert.deepEqual(told, [{ linear: 0.5, angular: 0 }, null]);
});
