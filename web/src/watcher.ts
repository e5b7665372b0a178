// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Tells the node what this page shows of what is collected on demand, while it can be seen. */
import type { Part, Watch } from './protocol';

const NOTHING = '[[],[]]';

export class Watcher {
  private told = NOTHING; // what the node knows of this connection

  /**
   * `send`: returns whether the message could be sent; `isSeen`: whether the page can be seen at
   * all, and is not behind other tabs.
   */
  constructor(
    private readonly send: (message: Watch) => boolean,
    private readonly isSeen: () => boolean = () => true,
  ) {}

  /** A connection has ended: of the next one, the node will know nothing. */
  forget(): void {
    this.told = NOTHING;
  }

  /** This is shown now. To be called often: only what has changed is told. */
  show(shown: Iterable<Part>, sensors: Iterable<string> = []): void {
    const parts = this.isSeen() ? sorted(shown) : [];
    const topics = this.isSeen() ? sorted(sensors) : [];
    const now = JSON.stringify([parts, topics]);
    if (now !== this.told && this.send({ type: 'watch', parts, topics })) {
      this.told = now;
    }
  }
}

function sorted<T extends string>(shown: Iterable<T>): T[] {
  return [...new Set(shown)].sort();
}
