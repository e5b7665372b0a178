// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A WebSocket in a worker, used like a WebSocket. */
import type { Socket } from '../connection';
import type { FromWorker, ToWorker } from './messages';

export class WorkerSocket implements Socket {
  isOpen = false;
  onOpen: Socket['onOpen'] = () => {};
  onClose: Socket['onClose'] = () => {};
  onMessage: Socket['onMessage'] = () => {};
  onLeft: Socket['onLeft'] = () => {};
  private readonly worker: Worker;

  constructor(url: string, protocol: string) {
    this.worker = new Worker('socket.js', { type: 'module', name: 'socket' });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.receive(data);
    this.worker.onerror = () => this.closed('This browser cannot run the worker of the page');
    this.tell({ kind: 'open', url, protocol });
  }

  send(text: string): void {
    this.tell({ kind: 'send', text });
  }

  rest(): void {
    this.tell({ kind: 'rest' });
  }

  here(): void {
    this.tell({ kind: 'here' });
  }

  private tell(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  private receive(message: FromWorker): void {
    switch (message.kind) {
      case 'opened':
        this.isOpen = true;
        return this.onOpen();
      case 'closed':
        return this.closed(message.reason);
      case 'text':
        return this.onMessage(message.text);
      case 'left':
        return this.onLeft(message.seconds);
      case 'frames':
        for (const frame of message.frames) {
          this.onMessage(frame);
        }
        return this.tell({ kind: 'taken' });
    }
  }

  private closed(reason: string): void {
    this.isOpen = false;
    this.worker.onmessage = this.worker.onerror = null;
    this.worker.terminate();
    this.onClose(reason);
  }
}
