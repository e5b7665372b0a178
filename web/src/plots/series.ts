// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A number over time, as charts read it, and what is kept of one that comes at any rate. */
import { Ring } from './ring';

/** Values over time; NaN is what was not known. */
export interface Series {
  /** Time of the oldest and of the latest value, s; NaN when there is none. */
  readonly first: number;
  readonly latest: number;
  /** The latest value at a time (s), or before it; NaN when there is none. */
  at(time: number): number;
  /**
   * The values between two times (s), in order, with the one before and the one behind. Where more
   * than one comes in `step` seconds, the least and the greatest of these may stand for all.
   */
  visit(from: number, to: number, step: number, call: (time: number, value: number) => void): void;
}

export const SPAN = 300; // s kept of what comes, where nobody says otherwise
const MOST = 1 << 16; // values kept one by one: those of SPAN at up to 218 Hz
const BINS = 4096; // of each the least and the greatest value are kept, all of the span
const MOST_OF_BINS = 1 << 14;
const JUMP = 1; // s back that are a new beginning; less is the disorder of several publishers

/**
 * A number at any rate, in memory that does not grow: the last 65 536 values one by one, and of all
 * of the span the least and the greatest of each of 4096 parts, so that no peak is lost and nothing is slow.
 */
export class Track implements Series {
  /** `span`: s kept. */
  constructor(
    private readonly span = SPAN,
    private readonly each = new Ring(MOST, span),
    private readonly bins = new Ring(MOST_OF_BINS, span),
    private readonly open = new Bin(span / BINS),
  ) {}

  get length(): number {
    return this.each.length;
  }

  /** How many values there is memory for. */
  get room(): number {
    return this.each.room + this.bins.room;
  }

  get first(): number {
    return this.bins.length === 0 ? this.each.first : Math.min(this.bins.first, this.each.first);
  }

  get latest(): number {
    return this.each.latest;
  }

  push(time: number, value: number): void {
    if (time < this.latest - JUMP) {
      this.clear();
    }
    const at = time < this.latest ? this.latest : time;
    this.each.push(at, value);
    this.each.dropBefore(at - this.span);
    if (at >= this.open.end || (Number.isNaN(value) && this.open.isKnown)) {
      this.open.flush(this.bins);
    }
    this.open.take(at, value);
    this.bins.dropBefore(at - this.span);
  }

  clear(): void {
    this.each.clear();
    this.bins.clear();
    this.open.clear();
  }

  at(time: number): number {
    return time < this.each.first ? this.bins.at(time) : this.each.at(time);
  }

  visit(from: number, to: number, step: number, call: (time: number, value: number) => void): void {
    // Before `change` the bins are good enough, or all that there is.
    const change = step >= this.span / BINS ? this.bins.latest : this.each.first;
    if (this.bins.length === 0 || !(from <= change)) {
      return this.each.visit(from, to, call);
    }
    this.bins.visit(from, Math.min(to, change), (time, value) => {
      if (time < change) {
        call(time, value);
      }
    });
    this.each.visit(Math.max(from, change), to, (time, value) => {
      if (time >= change) {
        call(time, value);
      }
    });
  }

  /** A copy that does not change any more. */
  copy(): Track {
    return new Track(this.span, this.each.copy(), this.bins.copy(), this.open.copy());
  }
}

/** The least and the greatest value of a short time. */
class Bin {
  end = -Infinity; // s
  private least = [0, Infinity] as [time: number, value: number];
  private most = [0, -Infinity] as [time: number, value: number];
  private unknown: number | null = null; // s, since when nothing was known

  /** `length`: s. */
  constructor(private readonly length: number) {}

  get isKnown(): boolean {
    return this.least[1] <= this.most[1];
  }

  take(time: number, value: number): void {
    if (!(time < this.end)) {
      this.end = (Math.floor(time / this.length) + 1) * this.length;
    }
    if (Number.isNaN(value)) {
      this.unknown ??= time;
      return;
    }
    if (value < this.least[1]) {
      this.least = [time, value];
    }
    if (value > this.most[1]) {
      this.most = [time, value];
    }
  }

  /** Move what is in it to the ring, in the order of time. */
  flush(ring: Ring): void {
    if (this.unknown !== null) {
      ring.push(this.unknown, Number.NaN);
    }
    const [[earlier, first], [later, second]] =
      this.least[0] <= this.most[0] ? [this.least, this.most] : [this.most, this.least];
    if (this.isKnown) {
      ring.push(earlier, first);
      if (later > earlier) {
        ring.push(later, second);
      }
    }
    this.clear();
  }

  clear(): void {
    this.end = -Infinity;
    this.least = [0, Infinity];
    this.most = [0, -Infinity];
    this.unknown = null;
  }

  copy(): Bin {
    return Object.assign(new Bin(this.length), this);
  }
}
