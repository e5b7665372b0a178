// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Tells the node which parts of the states this page shows, beyond those that always come. */
import type { Part, Watch } from './protocol';

export class Watcher {
  private told = ''; // what the node knows of this connection

  /** `send`: returns whether the message could be sent. */
  constructor(private readonly send: (message: Watch) => boolean) {}

  /** A connection has ended: of the next one, the node will know nothing. */
  forget(): void {
    this.told = '';
  }

  /** This is shown now. To be called often: only what has changed is told. */
  show(shown: Iterable<Part>): void {
    const parts = [...new Set(shown)].sort();
    if (parts.join() !== this.told && this.send({ type: 'watch', parts })) {
      this.told = parts.join();
    }
  }
}
