// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Times and what was known then, in order, the latest so many. */

const LEAST = 256;
const MORE = 1.1; // than are expected: rates vary

type Floats = Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
type MakeFloats = Float32ArrayConstructor | Float64ArrayConstructor;

export class Ring {
  private times: Float64Array<ArrayBuffer>;
  private values: Floats;
  private count = 0;
  private next = 0;

  /**
   * `most`: how many samples it holds. Until then it takes the memory of so many seconds as `span`
   * says, as soon as it is known at which rate they come; of all, if that is Infinity. `columns`: the
   * values of a sample.
   */
  constructor(
    private readonly most: number,
    private readonly span: number,
    readonly columns = 1,
    private readonly make: MakeFloats = Float64Array,
  ) {
    const room = Math.min(LEAST, most);
    [this.times, this.values] = [new Float64Array(room), new make(room * columns)];
  }

  get length(): number {
    return this.count;
  }

  /** How many samples there is memory for. */
  get room(): number {
    return this.times.length;
  }

  /** Time of the oldest sample; NaN when there is none. */
  get first(): number {
    return this.count === 0 ? Number.NaN : this.time(0);
  }

  /** Time of the latest sample; NaN when there is none. */
  get latest(): number {
    return this.count === 0 ? Number.NaN : this.time(this.count - 1);
  }

  push(time: number, ...values: readonly number[]): void {
    if (this.count === this.room && this.count < this.most) {
      this.grow();
    }
    this.times[this.next] = time;
    for (let column = 0; column < this.columns; column += 1) {
      this.values[this.next * this.columns + column] = values[column] ?? Number.NaN;
    }
    this.next = (this.next + 1) % this.room;
    this.count = Math.min(this.count + 1, this.room);
  }

  clear(): void {
    this.count = 0;
    this.next = 0;
  }

  dropBefore(time: number): void {
    while (this.count > 0 && this.time(0) < time) {
      this.count -= 1;
    }
  }

  /** The latest value of a column at a time or before; NaN when there is none. */
  at(time: number, column = 0): number {
    const after = this.after(time);
    return after === 0 ? Number.NaN : this.value(after - 1, column);
  }

  /** The values of a column between two times, with the one before and the one behind. */
  visit(from: number, to: number, call: (time: number, value: number) => void, column = 0): void {
    const end = Math.min(this.count, this.after(to) + 1);
    for (let age = Math.max(0, this.after(from) - 1); age < end; age += 1) {
      call(this.time(age), this.value(age, column));
    }
  }

  /** A copy that does not change any more. */
  copy(): Ring {
    const copy = new Ring(this.most, this.span, this.columns, this.make);
    copy.times = this.times.slice();
    copy.values = this.values.slice();
    copy.count = this.count;
    copy.next = this.next;
    return copy;
  }

  private after(time: number): number {
    return countUntil(time, this.count, (age) => this.time(age));
  }

  private time(age: number): number {
    return this.times[this.index(age)] ?? Number.NaN;
  }

  private value(age: number, column: number): number {
    return this.values[this.index(age) * this.columns + column] ?? Number.NaN;
  }

  private index(age: number): number {
    return (this.next - this.count + age + this.room) % this.room;
  }

  /** It is full: have room for all of the span at the rate so far, and for twice as many at least. */
  private grow(): void {
    const expected = Math.ceil((MORE * this.span * this.count) / (this.latest - this.first));
    const room = Math.min(this.most, Math.max(2 * this.count, expected));
    const begin = this.index(0);
    const move = (from: Floats, to: Floats, columns: number): void => {
      to.set(from.subarray(begin * columns));
      to.set(from.subarray(0, begin * columns), from.length - begin * columns);
    };
    const [times, values] = [new Float64Array(room), new this.make(room * this.columns)];
    move(this.times, times, 1);
    move(this.values, values, this.columns);
    [this.times, this.values] = [times, values];
    this.next = this.count;
  }
}

/** How many of so many times in order are at this one or before. */
function countUntil(time: number, count: number, timeOf: (index: number) => number): number {
  let low = 0;
  let high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (timeOf(middle) <= time) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}
