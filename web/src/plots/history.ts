// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What was: the samples of the last minutes, in memory that does not grow. */
import { Ring } from './ring';
import type { Series } from './series';

/**
 * Samples, each a time and a value a column.
 *
 * A sample closer than `span / capacity` to the one before is left out, so that those that are kept
 * always reach back `span` seconds, however fast samples come.
 */
export class History {
  constructor(
    readonly columns: number,
    private readonly span: number,
    private readonly capacity: number,
    private readonly ring = new Ring(capacity, Infinity, columns, Float32Array),
  ) {}

  get length(): number {
    return this.ring.length;
  }

  /** Time of the latest sample, s; not a number when there is none. */
  get latest(): number {
    return this.ring.latest;
  }

  /** Keep a sample. Time that goes back forgets all that was. */
  push(time: number, values: readonly number[]): void {
    if (time < this.latest) {
      this.clear();
    }
    // A hundredth of slack: samples at just that distance must not beat against it.
    if (!(time - this.latest < (0.99 * this.span) / this.capacity)) {
      this.ring.push(time, ...values);
    }
  }

  clear(): void {
    this.ring.clear();
  }

  /** One of the columns, as it is and as it will be. */
  column(column: number): Series {
    const { ring } = this;
    return {
      get first() {
        return ring.first;
      },
      get latest() {
        return ring.latest;
      },
      at: (time) => ring.at(time, column),
      visit: (from, to, _step, call) => ring.visit(from, to, call, column),
    };
  }

  /** The latest value of a column at a time (s) or before; NaN when there is none. */
  at(time: number, column: number): number {
    return this.ring.at(time, column);
  }

  /** A copy that does not change any more. */
  copy(): History {
    return new History(this.columns, this.span, this.capacity, this.ring.copy());
  }
}
