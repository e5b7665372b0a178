// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Moves the playhead of a recording, and plays it: one request at a time, and the last wish wins. */
import type { Asked } from '../connection';
import type { Playhead } from '../protocol';

export const RATES = [0.1, 0.25, 0.5, 1, 2, 5, 10];
const STEP = 1; // s
const FINE = 0.1; // s

type Ask = (asked: Asked) => Promise<unknown>;

export class Scrubber {
  private wish: number | null = null; // s
  private isAsking = false;

  /** `length`: of the recording, s; `now`: what the node said last. */
  constructor(
    private readonly ask: Ask,
    private readonly length: () => number,
    private readonly now: () => Playhead | null,
  ) {}

  /** Where it will be, s: what was asked for last, else where the node says it is. */
  get place(): number {
    return this.wish ?? this.now()?.place ?? 0;
  }

  move(place: number): void {
    this.wish = Math.min(Math.max(place, 0), this.length());
    if (!this.isAsking) {
      void this.settle();
    }
  }

  playOrPause(): void {
    this.run(this.now()?.playing !== true, this.now()?.rate ?? 1);
  }

  setRate(rate: number): void {
    this.run(this.now()?.playing === true, rate);
  }

  /** What a key asks for; returns whether it is one of these. */
  press(key: string, isFine: boolean): boolean {
    const step = isFine ? FINE : STEP;
    switch (key) {
      case ' ':
        this.playOrPause();
        return true;
      case 'ArrowLeft':
      case 'ArrowRight':
        this.move(this.place + (key === 'ArrowLeft' ? -step : step));
        return true;
      case 'ArrowUp':
      case 'ArrowDown':
        this.setRate(nextRate(this.now()?.rate ?? 1, key === 'ArrowUp'));
        return true;
      case 'Home':
      case 'End':
        this.move(key === 'Home' ? 0 : this.length());
        return true;
      default:
        return false;
    }
  }

  private run(playing: boolean, rate: number): void {
    void this.ask({ type: 'playback', playing, rate });
  }

  private async settle(): Promise<void> {
    this.isAsking = true;
    let asked: number | null = null;
    while (this.wish !== null && this.wish !== asked) {
      asked = this.wish;
      await this.ask({ type: 'seek', place: asked });
    }
    this.wish = null;
    this.isAsking = false;
  }
}

/** The next faster or slower one of the rates; the fastest and the slowest stay. */
function nextRate(rate: number, isFaster: boolean): number {
  const others = RATES.filter((each) => (isFaster ? each > rate : each < rate));
  return (isFaster ? others[0] : others.at(-1)) ?? rate;
}
