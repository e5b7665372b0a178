// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What was: the samples of the last minutes, in memory that does not grow. */

/** Columns of equal length, the time (s) first; null stands for what is not known. */
export type Table = [number[], ...(number | null)[][]];

/**
 * A ring of samples, each a time and a value a column.
 *
 * A sample closer than `span / capacity` to the one before is left out, so that the ring always
 * reaches back `span` seconds, however fast samples come.
 */
export class History {
  private readonly times: Float64Array;
  private readonly values: Float32Array;
  private count = 0;
  private next = 0;

  constructor(
    readonly columns: number,
    readonly span: number,
    readonly capacity: number,
  ) {
    this.times = new Float64Array(capacity);
    this.values = new Float32Array(capacity * columns);
  }

  get length(): number {
    return this.count;
  }

  /** Time of the latest sample, s; not a number when there is none. */
  get latest(): number {
    return this.count === 0 ? Number.NaN : this.times[this.index(this.count - 1)];
  }

  /** Keep a sample. Time that goes back forgets all that was. */
  push(time: number, values: ArrayLike<number>): void {
    if (time < this.latest) {
      this.clear();
    }
    // A hundredth of slack: samples at just that distance must not beat against it.
    if (this.count > 0 && time - this.latest < (0.99 * this.span) / this.capacity) {
      return;
    }
    this.times[this.next] = time;
    for (let column = 0; column < this.columns; column += 1) {
      this.values[this.next * this.columns + column] = values[column];
    }
    this.next = (this.next + 1) % this.capacity;
    this.count = Math.min(this.count + 1, this.capacity);
  }

  clear(): void {
    this.count = 0;
    this.next = 0;
  }

  /** The samples from `from` (s) on. */
  since(from: number): Table {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[this.index(middle)] < from) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    const length = this.count - low;
    const table: Table = [new Array<number>(length)];
    for (let column = 0; column < this.columns; column += 1) {
      table.push(new Array<number | null>(length));
    }
    for (let row = 0; row < length; row += 1) {
      const at = this.index(low + row);
      table[0][row] = this.times[at];
      for (let column = 0; column < this.columns; column += 1) {
        const value = this.values[at * this.columns + column];
        table[column + 1][row] = Number.isNaN(value) ? null : value;
      }
    }
    return table;
  }

  private index(age: number): number {
    return (this.next - this.count + age + this.capacity) % this.capacity;
  }
}
