// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How old is what the page shows, and from when on it is stale; in s of wall time. */
import type { Ages } from './protocol';

const STALE = 0.5; // s
const PERIOD = 0.35; // s: the node tells ages more often than that, if nothing is wrong
const SLOWEST = 3; // s: a topic of a longer period is not taken for a slow one, but for a dead one

export type Kind = 'command' | 'odometry' | 'truth' | 'joint_states';

export class Freshness {
  private ages: Ages | null = null;
  private cameAt = 0; // s
  private readonly last = new Map<string, number>();
  private readonly peaks = new Map<string, number>(); // greatest age of the last period

  /** The node has told ages, at `now`; null: a new connection, nothing is known. */
  take(ages: Ages | null, now: number): void {
    this.ages = ages;
    this.cameAt = now;
    if (ages === null) {
      this.last.clear();
      this.peaks.clear();
      return;
    }
    this.learn('clock', ages.clock);
    for (const robot of ages.robots) {
      for (const kind of ['odometry', 'truth', 'joint_states'] as const) {
        this.learn(`${robot.robot} ${kind}`, robot[kind]);
      }
    }
  }

  /** The age of what the node says, whatever moves; 0: it says enough, null: it has not begun. */
  silence(now: number): number | null {
    return this.ages === null ? null : Math.max(0, now - this.cameAt - PERIOD);
  }

  /** The age of the latest /clock; null: nobody publishes it. */
  clock(now: number): number | null {
    return this.grown(this.ages?.clock ?? null, now);
  }

  of(robot: string, kind: Kind, now: number): number | null {
    const found = this.ages?.robots.find((each) => each.robot === robot);
    return this.grown(found?.[kind] ?? null, now);
  }

  /** The age of the numbers of a robot if they are too old, in comparison with their own period. */
  staleness(robot: string, kind: Kind, now: number): number | null {
    return this.tooOld(this.of(robot, kind, now), `${robot} ${kind}`);
  }

  /** The age of everything if that is too old: of what the node says, or of simulated time. */
  stalenessOfAll(now: number): number | null {
    const silence = this.silence(now) ?? 0;
    const ages = [silence > STALE - PERIOD ? silence + PERIOD : null, this.tooOld(this.clock(now), 'clock')];
    const known = ages.filter((age) => age !== null);
    return known.length === 0 ? null : Math.max(...known);
  }

  private grown(age: number | null, now: number): number | null {
    return age === null ? null : age + (this.silence(now) ?? 0);
  }

  private tooOld(age: number | null, key: string): number | null {
    const peak = this.peaks.get(key) ?? 0;
    const limit = Math.max(STALE, 1.5 * peak + 0.1 * Math.sign(peak));
    return age !== null && age > limit ? age : null;
  }

  /** Ages grow until a message comes: the greatest one before it is about the topic's period. */
  private learn(key: string, age: number | null): void {
    const last = this.last.get(key);
    if (age === null) {
      this.last.delete(key);
      this.peaks.delete(key);
      return;
    }
    if (last !== undefined && age < last && last < SLOWEST) {
      this.peaks.set(key, last);
    }
    this.last.set(key, age);
  }
}

/** "3 s", "1 min". */
export function ageText(age: number): string {
  return age < 99.5 ? `${Math.max(1, Math.round(age))} s` : `${Math.round(age / 60)} min`;
}
