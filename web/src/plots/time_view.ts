// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Which time the charts show, all of them the same: the latest, or a time that somebody holds. */

const SHORTEST = 0.02; // s

export interface Extent {
  first: number; // s, of the oldest sample kept; NaN: there is none
  latest: number;
}

export class TimeView {
  private held: readonly [number, number] | null = null;

  /** `window`: s seen; `longest`: s that may be seen. */
  constructor(
    private seconds: number,
    private longest: number,
  ) {}

  /** See all of something that is so many seconds long; more is not to be seen. */
  setWhole(seconds: number): void {
    this.longest = this.seconds = seconds;
    this.held = null;
  }

  get window(): number {
    return this.seconds;
  }

  get isHeld(): boolean {
    return this.held !== null;
  }

  /** From when to when, s: nothing before the first sample, so that no empty time is seen. */
  range({ first, latest }: Extent): [number, number] {
    if (this.held !== null) {
      return [...this.held];
    }
    if (Number.isNaN(latest)) {
      return [0, this.seconds];
    }
    const from = latest - this.seconds;
    const begin = beginOf(first);
    return from < begin ? [begin, begin + this.seconds] : [from, latest];
  }

  /** See so many seconds: the latest, or those that ended with what is held. */
  setWindow(seconds: number): void {
    this.seconds = seconds;
    this.held = this.held && [this.held[1] - seconds, this.held[1]];
  }

  hold(extent: Extent): void {
    this.held ??= this.range(extent);
  }

  follow(): void {
    this.held = null;
  }

  /** Hold a part of what is seen, as shares of it. */
  select(from: number, to: number, extent: Extent): void {
    const [begin, end] = this.range(extent);
    const at = (share: number): number => begin + share * (end - begin);
    this.set(at(Math.min(from, to)), at(Math.max(from, to)), extent);
  }

  /** See so much more (more than 1) or less of the time around a share of what is seen. */
  zoom(share: number, ratio: number, extent: Extent): void {
    const [begin, end] = this.range(extent);
    const around = begin + share * (end - begin);
    this.set(around - ratio * (around - begin), around + ratio * (end - around), extent);
  }

  /** Go on by a share of what is seen; back, where it is negative. */
  pan(share: number, extent: Extent): void {
    const [begin, end] = this.range(extent);
    const by = share * (end - begin);
    this.set(begin + by, end + by, extent);
  }

  private set(from: number, to: number, extent: Extent): void {
    const least = beginOf(extent.first);
    const most = Math.max(extent.latest, least + this.seconds) || this.seconds;
    const length = Math.max(SHORTEST, Math.min(to - from, this.longest, most - least));
    const middle = (from + to) / 2;
    const begin = Math.min(Math.max(middle - length / 2, least), most - length);
    this.held = [begin, begin + length];
  }
}

/** What began with the simulation is shown from 0 on. */
function beginOf(first: number): number {
  return first >= 1 ? first : 0;
}
