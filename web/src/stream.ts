// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The binary frames as they come: decoded, counted, and gaps between the states seen. */
import { decodeSample, type Sample } from './samples';
import { BadState, decodeState, type State } from './state';
import type { Store } from './store';

export class StateStream {
  /** How many states came, how many the node left out, how many frames were of no use here. */
  readonly counts = { states: 0, skipped: 0, stale: 0, bad: 0, sensed: 0 };
  latest: State | null = null;
  arrivedAt = Number.NaN; // ms, as performance.now()
  private isFresh = false;

  constructor(private readonly store: Store) {
    store.watch(['layout'], () => {
      this.latest = null;
      this.isFresh = false;
    });
  }

  /** Read a sample of a sensor; null where it is none. */
  takeSample(buffer: ArrayBuffer): Sample | null {
    const sample = this.attempt(() => decodeSample(buffer));
    this.counts.sensed += sample === null ? 0 : 1;
    this.isFresh ||= sample !== null; // it is shown with the latest state, if that is the same
    return sample;
  }

  /** Read a state; null where it is not for what we know now. */
  take(buffer: ArrayBuffer): State | null {
    const state = this.decode(buffer);
    if (state === null) {
      return null;
    }
    if (this.latest !== null) {
      this.counts.skipped += Math.max(0, state.sequence - this.latest.sequence - 1);
    }
    this.counts.states += 1;
    this.arrivedAt = performance.now();
    this.latest = state;
    this.isFresh = true;
    return state;
  }

  /** What is shown has changed, with no state. */
  touch(): void {
    this.isFresh = this.latest !== null;
  }

  /** The latest state, once after each state and each sample. */
  fresh(): State | null {
    const state = this.isFresh ? this.latest : null;
    this.isFresh = false;
    return state;
  }

  private decode(buffer: ArrayBuffer): State | null {
    const { layout } = this.store;
    return this.attempt(() => {
      const state = layout === null ? null : decodeState(buffer, layout);
      this.counts.stale += state === null ? 1 : 0;
      return state;
    });
  }

  /** Decode a frame; null, and a notice, where it is none. */
  attempt<T>(decode: () => T): T | null {
    try {
      return decode();
    } catch (error) {
      if (!(error instanceof BadState)) {
        throw error;
      }
      this.counts.bad += 1;
      this.store.note('error', `The node sent ${error.message}.`);
      return null;
    }
  }
}
