// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The last minute of a live session: states and samples, so that scene and pictures go back to them. */
import type { Layout } from './protocol';
import type { Sample } from './samples';
import { decodeState, stateBytes, type State } from './state';

const MINUTE = 60; // s kept
const MOST_STATES = 600;
const MOST_STATE_BYTES = 1 << 22; // of a fleet, fewer states are kept
const SAMPLE_GAP = 0.199; // s, between two samples of a topic
const LARGE_GAP = 0.999; // s, where they are large
const LARGE = 1 << 16; // bytes
const MOST_BYTES = 1 << 24; // of samples

interface Kept {
  time: number; // s, of the latest state when it came
  sample: Sample;
}

/** What shows states and samples, whichever they are. */
interface Shower {
  state: (state: State) => void;
  sample: (sample: Sample) => void;
  over: () => void; // what is, is shown again
}

export class Past {
  private states: States | null = null; // of the layout of the latest
  private readonly samples = new Map<string, Kept[]>(); // by topic
  private readonly newest = new Map<string, Sample>(); // of those that came while the past is shown
  private bytes = 0; // of samples
  private latest: State | null = null;
  private at: number | null = null; // s; null: what is shown is what comes

  constructor(private readonly shower: Shower) {}

  /** What is shown is a time that was. */
  get isShown(): boolean {
    return this.at !== null;
  }

  /** Keep a state. Returns whether it is to be shown: no other time is looked at. */
  takeState(state: State): boolean {
    const { latest } = this;
    if (latest !== null && (state.time < latest.time || state.layout !== latest.layout)) {
      this.forget();
    }
    this.latest = state;
    this.states ??= new States(state.layout);
    this.states.keep(state);
    return !this.isShown;
  }

  /** Keep a sample. Returns whether it is to be shown. */
  takeSample(sample: Sample): boolean {
    const { topic } = sample.head.origin;
    const kept = this.samples.get(topic) ?? [];
    const time = this.latest?.time ?? 0;
    const size = sample.bytes.byteLength;
    if (time - (kept.at(-1)?.time ?? -Infinity) >= (size > LARGE ? LARGE_GAP : SAMPLE_GAP)) {
      this.samples.set(topic, [...kept, { time, sample }]);
      this.bytes += size;
      this.dropSamples(time - MINUTE);
    }
    if (this.isShown) {
      this.newest.set(topic, sample);
    }
    return !this.isShown;
  }

  /** Show what was at a time, s, as far as it is kept; null: what is, and what comes. Returns the time that is shown. */
  lookAt(time: number | null): number | null {
    if (time === null) {
      this.follow();
      return null;
    }
    const state = this.states?.at(time) ?? null;
    if (state === null) {
      return null;
    }
    this.at = state.time;
    this.shower.state(state);
    for (const kept of this.samples.values()) {
      const [newest] = kept.filter((each) => each.time <= time).slice(-1);
      if (newest !== undefined) {
        this.shower.sample(newest.sample);
      }
    }
    return this.at;
  }

  /** Time began anew, or other things are in it. */
  forget(): void {
    this.follow();
    this.states = null;
    this.samples.clear();
    this.bytes = 0;
    this.latest = null;
  }

  private follow(): void {
    if (this.at === null) {
      return;
    }
    this.at = null;
    this.shower.over();
    if (this.latest !== null) {
      this.shower.state(this.latest);
    }
    for (const [topic, kept] of this.samples) {
      const sample = this.newest.get(topic) ?? kept.at(-1)?.sample;
      if (sample !== undefined) {
        this.shower.sample(sample);
      }
    }
    this.newest.clear();
  }

  /** Drop samples of before a time, and the oldest of all as long as there are too many bytes. */
  private dropSamples(time: number): void {
    for (;;) {
      const [topic, kept] = [...this.samples].reduce((one, other) =>
        (other[1][0]?.time ?? Infinity) < (one[1][0]?.time ?? Infinity) ? other : one,
      );
      const [oldest, ...rest] = kept;
      if (oldest === undefined || (oldest.time >= time && this.bytes <= MOST_BYTES)) {
        return;
      }
      this.bytes -= oldest.sample.bytes.byteLength;
      this.samples.set(topic, rest);
    }
  }
}

/** States of one layout, as the frames that they came in: in memory that does not grow. */
class States {
  private readonly size: number;
  private readonly most: number;
  private readonly frames: Uint8Array<ArrayBuffer>;
  private readonly times: Float64Array;
  private count = 0; // that were kept so far

  constructor(private readonly layout: Layout) {
    this.size = stateBytes(layout);
    this.most = Math.min(MOST_STATES, Math.floor(MOST_STATE_BYTES / this.size));
    this.frames = new Uint8Array(this.most * this.size);
    this.times = new Float64Array(this.most);
  }

  /** Keep a state, if the one before is old enough that all together reach back a minute. */
  keep({ time, poses }: State): void {
    const last = this.count === 0 ? -Infinity : this.times[(this.count - 1) % this.most]!;
    if (time - last < (0.99 * MINUTE) / this.most) {
      return;
    }
    const place = this.count % this.most;
    this.times[place] = time;
    this.frames.set(new Uint8Array(poses.buffer), place * this.size);
    this.count += 1;
  }

  /** The latest at a time or before, else the oldest; null: there is none. */
  at(time: number): State | null {
    let place = Math.max(0, this.count - this.most);
    for (let index = place; index < this.count && this.times[index % this.most]! <= time; index += 1) {
      place = index;
    }
    const begin = (place % this.most) * this.size;
    return this.count === 0 ? null : decodeState(this.frames.slice(begin, begin + this.size).buffer, this.layout);
  }
}
