// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What is made of numbers as they come: how fast they change, without their noise, how far from others. */
import type { Field, Step } from './field';

type Sample = readonly [time: number, value: number];

/** Takes a number of a time (s), and gives what is known then of what is made. */
type Making = (time: number, value: number) => readonly Sample[];

const MOST_WAITING = 1 << 16; // numbers for which the others have not come
const SOME = 1024; // that have gone, before room is made
const JUMP = 1; // s back that are a new beginning, as of a Track

/** Have the numbers of fields come as `follow` does, and `take` get what a field's steps make of them. */
export function make(
  { steps = [] }: Field,
  take: (time: number, value: number) => void,
  followOther: (other: Field, take: (time: number, value: number) => void) => void,
): (time: number, value: number) => void {
  return steps.reduceRight<(time: number, value: number) => void>((next, step) => {
    const hand = (made: readonly Sample[]): void => made.forEach((sample) => next(...sample));
    if (step.by === 'minus') {
      const difference = new Difference();
      followOther(step.other, (time, value) => hand(difference.takeOther(time, value)));
      return (time, value) => hand(difference.take(time, value));
    }
    const making = makingOf(step);
    return (time, value) => hand(making(time, value));
  }, take);
}

function makingOf(step: Exclude<Step, { by: 'minus' }>): Making {
  return step.by === 'd' ? derivative() : lowpass(step.seconds);
}

/** Per second, from one number to the next. */
function derivative(): Making {
  let [at, was] = [Number.NaN, Number.NaN];
  return (time, value) => {
    const [passed, more] = [time - at, value - was];
    if (passed === 0) {
      was = Number.isNaN(was) ? value : was; // of two numbers of one time the first counts
      return [];
    }
    const isFirst = Number.isNaN(at);
    [at, was] = [time, value];
    return isFirst || passed < 0 ? [] : [[time, more / passed]];
  };
}

/** Of first order: y += (1 - exp(-dt / seconds)) (x - y). */
function lowpass(seconds: number): Making {
  let [at, smooth] = [Number.NaN, Number.NaN];
  return (time, value) => {
    const share = time >= at && !Number.isNaN(smooth) ? 1 - Math.exp((at - time) / seconds) : 1;
    smooth = share === 1 ? value : smooth + share * (value - smooth);
    at = time;
    return [[time, smooth]];
  };
}

/** Numbers less others, which are taken on straight lines between two of theirs. */
class Difference {
  private readonly mine = new Waiting();
  private readonly others = new Waiting();

  take(time: number, value: number): Sample[] {
    this.mine.push(time, value);
    return this.settle();
  }

  takeOther(time: number, value: number): Sample[] {
    this.others.push(time, value);
    return this.settle();
  }

  /** Those of mine between two of the others; the rest waits. */
  private settle(): Sample[] {
    const made: Sample[] = [];
    for (let sample = this.mine.at(0); sample !== undefined; sample = this.mine.at(0)) {
      const [time, value] = sample;
      while ((this.others.at(1)?.[0] ?? Infinity) <= time) {
        this.others.drop();
      }
      const [before, after] = [this.others.at(0), this.others.at(1)];
      if (before === undefined || (after === undefined && before[0] < time)) {
        break;
      }
      this.mine.drop();
      if (before[0] <= time) {
        const share = after === undefined ? 0 : (time - before[0]) / (after[0] - before[0]);
        made.push([time, value - before[1] - (after === undefined ? 0 : share * (after[1] - before[1]))]);
      }
    }
    return made;
  }
}

/** Numbers in the order of their times. */
class Waiting {
  private samples: Sample[] = [];
  private begin = 0;

  at(index: number): Sample | undefined {
    return this.samples[this.begin + index];
  }

  push(time: number, value: number): void {
    const last = this.samples.at(-1)?.[0] ?? time;
    if (time < last - JUMP) {
      [this.samples, this.begin] = [[], 0];
    }
    this.samples.push([Math.max(time, time < last - JUMP ? time : last), value]);
    if (this.samples.length - this.begin > MOST_WAITING) {
      this.drop();
    }
  }

  drop(): void {
    this.begin += 1;
    if (this.begin > SOME && 2 * this.begin > this.samples.length) {
      [this.samples, this.begin] = [this.samples.slice(this.begin), 0];
    }
  }
}
