// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The WebSocket to the node: opens it, and opens it again when it closed. */
import { PROTOCOL } from './protocol';
import type { ClientMessage, Reply, Request, ServerMessage } from './protocol';
import { WorkerSocket } from './socket/worker_socket';

const FIRST_WAIT = 250; // ms until the first new attempt
const LONGEST_WAIT = 4000; // ms
const GROWTH = 1.7;
const REPLY_LIMIT = 20; // s; loading a controller may take a while

export type Link =
  | { state: 'connecting' }
  | { state: 'open' }
  | { state: 'waiting'; attempt: number; reason: string }; // until the next attempt

/** A request before it has its number. */
export type Asked = Request extends infer R ? (R extends Request ? Omit<R, 'id'> : never) : never;

/** What is used of a WebSocket, which a worker holds. */
export interface Socket {
  readonly isOpen: boolean;
  onOpen: () => void;
  onClose: (reason: string) => void;
  onMessage: (data: string | ArrayBuffer) => void;
  /** The page was busy for so many s, and its `drive` was left: none is sent until {@link rest}. */
  onLeft: (seconds: number) => void;
  /** A text frame; a `drive` is repeated until the next one, a `stop`, or {@link rest}. */
  send(text: string): void;
  rest(): void;
  here(): void; // the page is not busy: to be called again and again while it drives
}

/** What a connection needs of the world outside. */
export interface ConnectionPort {
  open(url: string, protocol: string): Socket;
  after(milliseconds: number, call: () => void): () => void; // returns what takes it back
}

const BROWSER: ConnectionPort = {
  open: (url, protocol) => new WorkerSocket(url, protocol),
  after: (milliseconds, call) => {
    const timer = setTimeout(call, milliseconds);
    return () => clearTimeout(timer);
  },
};

export class Connection {
  link: Link = { state: 'connecting' };
  onLink: (link: Link) => void = () => {};
  onMessage: (message: ServerMessage) => void = () => {};
  onBinary: (buffer: ArrayBuffer) => void = () => {};
  /** The page was busy for so many s, so that the robot that it drove was stopped. */
  onLeft: (seconds: number) => void = () => {};

  private socket: Socket | null = null;
  private attempt = 0;
  private nextId = 1;
  private readonly waiting = new Map<number, (reply: Reply) => void>();
  private cancelRetry: (() => void) | null = null;

  constructor(
    private readonly url: string,
    private readonly port: ConnectionPort = BROWSER,
  ) {}

  /** Open now, also while waiting for the next attempt. */
  open(): void {
    this.cancelRetry?.();
    this.cancelRetry = null;
    this.tell({ state: 'connecting' });
    const socket = this.port.open(this.url, PROTOCOL);
    socket.onOpen = () => {
      this.attempt = 0;
      this.tell({ state: 'open' });
    };
    socket.onMessage = (data) => this.receive(data);
    socket.onLeft = (seconds) => {
      this.onLeft(seconds);
      socket.rest(); // also where no hand holds any more
    };
    socket.onClose = (reason) => this.closed(reason);
    this.socket = socket;
  }

  /** Whether the message could be given to the socket. */
  send(message: ClientMessage): boolean {
    if (this.socket?.isOpen !== true) {
      return false;
    }
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** A `drive` that was sent is not repeated any more. */
  rest(): void {
    this.socket?.rest();
  }

  /** The page is not busy; to be called again and again, or what it drives is left. */
  here(): void {
    this.socket?.here();
  }

  /** Ask the node for something. The reply always comes: a lost connection is a reply, too. */
  request(asked: Asked): Promise<Reply> {
    const id = this.nextId;
    this.nextId += 1;
    return new Promise((resolve) => {
      const cancel = this.port.after(REPLY_LIMIT * 1000, () => {
        this.answer(refusal(id, `No answer to "${asked.type}" within ${REPLY_LIMIT} s.`));
      });
      this.waiting.set(id, (reply) => {
        cancel();
        resolve(reply);
      });
      if (!this.send({ ...asked, id })) {
        this.answer(refusal(id, 'There is no connection to the node.'));
      }
    });
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') {
      this.onBinary(data);
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    if (message.type !== 'reply' || !this.answer(message)) {
      this.onMessage(message);
    }
  }

  private answer(reply: Reply): boolean {
    const resolve = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    resolve?.(reply);
    return resolve !== undefined;
  }

  private closed(reason: string): void {
    this.socket = null;
    for (const id of [...this.waiting.keys()]) {
      this.answer(refusal(id, 'The connection to the node was lost.'));
    }
    const wait = Math.min(FIRST_WAIT * GROWTH ** this.attempt, LONGEST_WAIT);
    this.attempt += 1;
    this.cancelRetry = this.port.after(wait, () => this.open());
    this.tell({ state: 'waiting', attempt: this.attempt, reason });
  }

  private tell(link: Link): void {
    this.link = link;
    this.onLink(link);
  }
}

function refusal(id: number, message: string): Reply {
  return { type: 'reply', id, ok: false, message, data: null, again: null };
}

/**
 * Where the node of this page listens: beside the page, which a proxy may have at a path. A token in the
 * page's address goes with it.
 */
export function socketUrl({ href, search }: Pick<Location, 'href' | 'search'>): string {
  return new URL(`ws${search}`, href).href.replace(/^http/, 'ws');
}
