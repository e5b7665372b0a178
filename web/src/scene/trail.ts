// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The way that something went, in bounded memory: fine where it was last, coarse before.
 *
 * A point is kept when it is `spacing` away from the last one. When the fine part is full, its
 * older half moves to the coarse part; that one keeps every other point and doubles its spacing
 * when it is full in turn. So the whole way stays in view however long it gets. (8 h at 1 m/s:
 * the last 80 m to 2 cm, the rest to some metres.)
 *
 * Both parts lie behind one another in `points`, coarse before fine, as a line is drawn. After them is where it
 * is now. Where what comes lies farther apart, such as on a busy machine, the way between is the curve through
 * the points: a robot turns no corners.
 */
import type { Vector } from '../protocol';
import { vectorAt } from '../state';

const AXES = 3;
const FAR = 1.5; // spacings, from which on the way between two points is filled
const MOST_BETWEEN = 64; // points that fill it

export interface TrailOptions {
  coarse?: number; // points at most, even
  fine?: number;
  spacing?: number; // m
}

export class Trail {
  /** x, y, z of each point, m; the first `count` are valid, and one more that is `ahead`. */
  readonly points: Float32Array;
  /** The points below this one have not changed since {@link markDrawn}. */
  firstChanged = 0;
  private readonly coarseCapacity: number;
  private readonly fineCapacity: number;
  /** m between two points of the fine part. */
  readonly spacing: number;
  private coarseSpacing: number;
  private coarse = 0;
  private fine = 0;
  private isAhead = false;
  private heading: Vector | null = null; // at the last point but one

  constructor({ coarse = 4096, fine = 4096, spacing = 0.02 }: TrailOptions = {}) {
    this.coarseCapacity = coarse;
    this.fineCapacity = fine;
    this.spacing = spacing;
    this.coarseSpacing = spacing;
    this.points = new Float32Array(AXES * (coarse + fine + 1));
  }

  /** How many points there are. */
  get count(): number {
    return this.coarse + this.fine;
  }

  /** How many points are drawn: with that where it is now, which is none that is kept. */
  get drawn(): number {
    return this.count + Number(this.isAhead);
  }

  /** Begin anew. */
  clear(): void {
    this.isAhead = false;
    this.heading = null;
    this.coarse = this.fine = this.firstChanged = 0;
    this.coarseSpacing = this.spacing;
  }

  /** Say that all changes have been taken over. */
  markDrawn(): void {
    this.firstChanged = this.count;
  }

  /** Go on to a point, m: it is kept, unless it is too near to the last one. Returns whether it is drawn elsewhere. */
  add(x: number, y: number, z: number): boolean {
    const end = this.count - 1;
    if (end >= 0 && this.distanceTo(end, x, y, z) < this.spacing) {
      const moved = !this.isAhead || this.distanceTo(this.count, x, y, z) > this.spacing / 10;
      if (moved) {
        this.points.set([x, y, z], AXES * this.count);
        this.isAhead = true;
      }
      return moved;
    }
    this.isAhead = false;
    this.bend([x, y, z]);
    this.push([x, y, z]);
    return true;
  }

  /** Fill the way to the last point by a curve, now that it is known where it leads. */
  private bend(next: Vector): void {
    if (this.fine < 2) {
      this.heading = null;
      return;
    }
    const [from, to] = [vectorAt(this.points, this.count - 2), vectorAt(this.points, this.count - 1)];
    const [came, goes] = [minus(to, from), minus(next, to)];
    const [far, further] = [Math.hypot(...came), Math.hypot(...goes)];
    if (came[0] * goes[0] + came[1] * goes[1] + came[2] * goes[2] <= 0) {
      this.heading = null; // it turned back: that is a corner
      return;
    }
    // On a circle this is its tangent, however far apart the points are.
    const arrive = unit(plus(times(came, further / far), times(goes, far / further)));
    const leave = this.heading ?? mirrored(arrive, times(came, 1 / far));
    this.heading = arrive;
    const between = Math.min(MOST_BETWEEN, Math.round(far / this.spacing) - 1);
    if (far < FAR * this.spacing) {
      return;
    }
    this.fine -= 1; // the last one is put behind those
    this.firstChanged = Math.min(this.firstChanged, this.count);
    for (let i = 1; i <= between; i++) {
      this.push(hermite(from, times(leave, far), to, times(arrive, far), i / (between + 1)));
    }
    this.push(to);
  }

  private push(point: Vector): void {
    if (this.fine === this.fineCapacity) {
      this.ageFinePart();
    }
    this.points.set(point, AXES * this.count);
    this.fine++;
  }

  /** Move the older half of the fine part to the coarse one. */
  private ageFinePart(): void {
    const begin = this.coarse;
    const half = begin + (this.fine >> 1);
    const end = begin + this.fine;
    for (let i = begin; i < half; i++) {
      this.addCoarse(...vectorAt(this.points, i));
    }
    this.points.copyWithin(AXES * this.coarse, AXES * half, AXES * end);
    this.firstChanged = Math.min(this.firstChanged, this.coarse);
    this.fine = end - half;
  }

  private addCoarse(x: number, y: number, z: number): void {
    const isNear =
      this.coarse > 0 && this.distanceTo(this.coarse - 1, x, y, z) < this.coarseSpacing;
    if (isNear) {
      return;
    }
    if (this.coarse === this.coarseCapacity) {
      this.thinCoarsePart();
    }
    // It never runs into what is still to be moved: not more is written than was read.
    this.points.set([x, y, z], AXES * this.coarse);
    this.firstChanged = Math.min(this.firstChanged, this.coarse);
    this.coarse++;
  }

  /** Drop every other point of the coarse part, but never the first: there it began. */
  private thinCoarsePart(): void {
    const kept = this.coarse >> 1;
    for (let i = 0; i < kept; i++) {
      this.points.copyWithin(AXES * i, AXES * 2 * i, AXES * (2 * i + 1));
    }
    this.coarse = kept;
    this.coarseSpacing *= 2;
    this.firstChanged = 0;
  }

  private distanceTo(index: number, x: number, y: number, z: number): number {
    const [px, py, pz] = vectorAt(this.points, index);
    return Math.hypot(x - px, y - py, z - pz);
  }
}

function plus([x, y, z]: Vector, [u, v, w]: Vector): Vector {
  return [x + u, y + v, z + w];
}

function times([x, y, z]: Vector, by: number): Vector {
  return [x * by, y * by, z * by];
}

function minus(one: Vector, other: Vector): Vector {
  return plus(one, times(other, -1));
}

function unit(vector: Vector): Vector {
  return times(vector, 1 / (Math.hypot(...vector) || 1));
}

/** The direction at the other end of the arc over a chord; `along`: of length 1. */
function mirrored([x, y, z]: Vector, along: Vector): Vector {
  return minus(times(along, 2 * (x * along[0] + y * along[1] + z * along[2])), [x, y, z]);
}

/** A point of the cubic with these ends and these directions at them, at a share of it. */
function hermite(from: Vector, leave: Vector, to: Vector, arrive: Vector, s: number): Vector {
  const [s2, s3] = [s ** 2, s ** 3];
  const ends = plus(times(from, 2 * s3 - 3 * s2 + 1), times(to, 3 * s2 - 2 * s3));
  return plus(ends, plus(times(leave, s3 - 2 * s2 + s), times(arrive, s3 - s2)));
}
