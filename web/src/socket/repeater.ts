// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Repeats the last `drive`, so that the node knows that somebody is there, whatever the page does.
 *
 * A page that draws without a GPU can be busy for half a second at a time, longer than the node waits
 * for the next `drive`. It must not be repeated for ever, though: of a page that has not said a word
 * for a second nobody knows whether the key is still down. Then no `drive` goes out any more until the
 * page, which is told so as soon as it is there again, has let go.
 */
import type { ClientMessage } from '../protocol';

const REPEAT = 1000 / 30; // ms
const PATIENCE = 1000; // ms without a word of the page

/** What is needed of the world outside. */
export interface RepeaterPort {
  send(text: string): void;
  /** The page is there again after so many s; what it drove was left meanwhile. */
  left(seconds: number): void;
  now(): number; // ms
  after(milliseconds: number, call: () => void): () => void; // returns what takes it back
}

export class Repeater {
  private text: string | null = null;
  private heardAt = -Infinity;
  private leaving: 'no' | 'untold' | 'told' = 'no'; // what the page knows of a `drive` that was left
  private cancel: (() => void) | null = null;

  constructor(private readonly port: RepeaterPort) {}

  /** The page says something: send it; a `drive` is repeated until the next one, or a stop. */
  send(text: string): void {
    this.hear();
    const { type } = JSON.parse(text) as ClientMessage;
    if (type === 'drive') {
      if (this.leaving !== 'no') {
        return; // the page has not let go yet
      }
      this.text = text;
      this.schedule();
    } else if (type === 'stop' || type === 'press_stop') {
      this.rest();
    }
    this.port.send(text);
  }

  /** The page is there. */
  hear(): void {
    const now = this.port.now();
    const silence = (now - this.heardAt) / 1000;
    this.heardAt = now;
    if (this.leaving === 'untold') {
      this.leaving = 'told';
      this.port.left(silence);
    }
  }

  /** The page lets go: repeat nothing more. */
  rest(): void {
    this.leaving = 'no';
    this.leave();
  }

  private leave(): void {
    this.text = null;
    this.cancel?.();
    this.cancel = null;
  }

  private schedule(): void {
    this.cancel?.();
    this.cancel = this.port.after(REPEAT, () => this.repeat());
  }

  private repeat(): void {
    if (this.text === null) {
      return;
    }
    if (this.port.now() - this.heardAt > PATIENCE) {
      this.leave();
      this.leaving = 'untold';
      return;
    }
    this.port.send(this.text);
    this.schedule();
  }
}
