// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Connection, socketUrl, type ConnectionPort, type Socket } from '../src/connection';

/** A socket whose other end is the test. */
class FakeSocket implements Socket {
  isOpen = false;
  sent: string[] = [];
  onOpen: Socket['onOpen'] = () => {};
  onClose: Socket['onClose'] = () => {};
  onMessage: Socket['onMessage'] = () => {};
  onLeft: Socket['onLeft'] = () => {};
  rests = 0;

  send(text: string): void {
    this.sent.push(text);
  }

  rest(): void {
    this.rests += 1;
  }

  here(): void {}

  close(): void {
    this.isOpen = false;
    this.onClose('');
  }

  accept(): void {
    this.isOpen = true;
    this.onOpen();
  }

  say(data: unknown): void {
    this.onMessage(data instanceof ArrayBuffer ? data : JSON.stringify(data));
  }
}

class Outside implements ConnectionPort {
  sockets: FakeSocket[] = [];
  timers: { milliseconds: number; call: () => void }[] = [];
  protocols: string[] = [];

  open(_url: string, protocol: string): Socket {
    this.protocols.push(protocol);
    this.sockets.push(new FakeSocket());
    return this.socket;
  }

  after(milliseconds: number, call: () => void): () => void {
    const entry = { milliseconds, call };
    this.timers.push(entry);
    return () => {
      this.timers = this.timers.filter((other) => other !== entry);
    };
  }

  /** Let the only timer run out; returns how long it was, ms. */
  ring(): number {
    assert.equal(this.timers.length, 1);
    const { milliseconds, call } = this.timers.splice(0)[0]!;
    call();
    return milliseconds;
  }

  get socket(): FakeSocket {
    return this.sockets.at(-1)!;
  }
}

function opened(): { outside: Outside; connection: Connection; words: string[] } {
  const outside = new Outside();
  const connection = new Connection('ws://here/ws', outside);
  const words: string[] = [];
  connection.onLink = (link) => words.push(link.state);
  connection.open();
  outside.socket.accept();
  return { outside, connection, words };
}

test('it speaks the protocol of this page and says how it stands', () => {
  const { outside, words } = opened();
  assert.deepEqual(outside.protocols, ['amr.v1']);
  assert.deepEqual(words, ['connecting', 'open']);
});

test('a lost connection is opened again, each time a little later, and at most 4 s later', () => {
  const { outside, words } = opened();
  const waits: number[] = [];
  for (let attempt = 0; attempt < 12; attempt += 1) {
    outside.socket.close();
    waits.push(outside.ring());
  }
  assert.equal(waits[0], 250);
  assert.ok(waits.every((wait, index) => index === 0 || wait >= waits[index - 1]!));
  assert.equal(waits.at(-1), 4000);
  assert.equal(words.at(-1), 'connecting');
  outside.socket.accept();
  outside.socket.close();
  assert.equal(outside.ring(), 250, 'what worked starts anew');
});

test('messages and states come apart', () => {
  const { outside, connection } = opened();
  const heard: string[] = [];
  connection.onMessage = (message) => heard.push(message.type);
  connection.onBinary = (buffer) => heard.push(`${buffer.byteLength} bytes`);
  outside.socket.say({ type: 'notice', level: 'info', text: 'x' });
  outside.socket.say(new ArrayBuffer(16));
  assert.deepEqual(heard, ['notice', '16 bytes']);
});

test('a reply finds its request', async () => {
  const { outside, connection } = opened();
  const one = connection.request({ type: 'play', simulator: '/sim' });
  const two = connection.request({ type: 'step', simulator: '/sim', steps: 5 });
  const ids = outside.socket.sent.map((text) => (JSON.parse(text) as { id: number }).id);
  outside.socket.say({ type: 'reply', id: ids[1], ok: true, message: 'two', data: null, again: null });
  outside.socket.say({ type: 'reply', id: ids[0], ok: false, message: 'one', data: null, again: null });
  assert.equal((await one).message, 'one');
  assert.equal((await two).message, 'two');
  assert.equal(outside.timers.length, 0);
});

test('a reply nobody waits for is a message', () => {
  const { outside, connection } = opened();
  const heard: string[] = [];
  connection.onMessage = (message) => heard.push(message.type);
  outside.socket.say({ type: 'reply', id: 0, ok: false, message: 'page 2 drives', data: null, again: null });
  assert.deepEqual(heard, ['reply']);
});

test('a lost connection answers every request, with a no', async () => {
  const { outside, connection } = opened();
  const reply = connection.request({ type: 'play', simulator: '/sim' });
  outside.socket.close();
  assert.deepEqual([(await reply).ok, (await reply).message], [
    false,
    'The connection to the node was lost.',
  ]);
});

test('a node that does not answer is told of', async () => {
  const { outside, connection } = opened();
  const reply = connection.request({ type: 'play', simulator: '/sim' });
  assert.equal(outside.ring(), 20000);
  assert.match((await reply).message, /No answer to "play" within 20 s/);
});

test('nothing goes into a connection that is not open', async () => {
  const outside = new Outside();
  const connection = new Connection('ws://here/ws', outside);
  assert.equal(connection.send({ type: 'stop', robot: null }), false);
  const reply = await connection.request({ type: 'pause', simulator: '/sim' });
  assert.equal(reply.ok, false);
});

test('the token of the page goes with the socket', () => {
  const socketOf = (href: string): string => socketUrl(new URL(href));
  assert.equal(socketOf('http://127.0.0.1:8080/?token=a1#plots=x'), 'ws://127.0.0.1:8080/ws?token=a1');
  assert.equal(socketOf('https://127.0.0.1:8080/'), 'wss://127.0.0.1:8080/ws');
  assert.equal(socketOf('https://hub/user/me/proxy/8080/'), 'wss://hub/user/me/proxy/8080/ws');
});

test('a page that was busy hears of it, and its socket that it has let go', () => {
  const { outside, connection } = opened();
  outside.socket.accept();
  const heard: number[] = [];
  connection.onLeft = (seconds) => {
    heard.push(seconds);
    assert.equal(outside.socket.rests, 0, 'the hands let go first');
  };
  outside.socket.onLeft(2.5);
  assert.deepEqual(heard, [2.5]);
  assert.equal(outside.socket.rests, 1);
});
