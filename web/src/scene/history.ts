// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The states of the last seconds: where a sensor was when it measured. */
import type { State } from '../state';

const MOST = 180; // states: 3 s of 60 a second
const SKEW = 1; // s; stamps that are older than all states by more are of another clock

export class StateHistory {
  private states: State[] = [];

  get length(): number {
    return this.states.length;
  }

  get latest(): State | null {
    return this.states.at(-1) ?? null;
  }

  add(state: State): void {
    const { latest } = this;
    if (latest !== null && (state.time < latest.time || state.layout.id !== latest.layout.id)) {
      this.clear(); // time has jumped back, or other frames are in it
    }
    this.states.push(state);
    if (this.states.length > MOST) {
      this.states.shift();
    }
  }

  clear(): void {
    this.states = [];
  }

  /** The state whose time is nearest; the latest, where the stamp is of another clock. */
  nearest(stamp: number): State | null {
    const { states } = this;
    if (states.length === 0 || stamp < states[0]!.time - SKEW) {
      return this.latest;
    }
    let after = states.findIndex(({ time }) => time >= stamp);
    if (after < 0) {
      return this.latest;
    }
    const before = Math.max(0, after - 1);
    if (stamp - states[before]!.time < states[after]!.time - stamp) {
      after = before;
    }
    return states[after] ?? null;
  }

  /** Whether no later state can be nearer. */
  isSettled(stamp: number): boolean {
    const { latest } = this;
    return latest !== null && latest.time >= stamp && stamp >= this.states[0]!.time - SKEW;
  }
}
