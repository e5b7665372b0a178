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
 * Both parts lie behind one another in `points`, coarse before fine, as a line is drawn.
 */
import { vectorAt } from '../state';

const AXES = 3;

export interface TrailOptions {
  coarse?: number; // points at most, even
  fine?: number;
  spacing?: number; // m
}

export class Trail {
  /** x, y, z of each point, m; the first `count` are valid. */
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

  constructor({ coarse = 4096, fine = 4096, spacing = 0.02 }: TrailOptions = {}) {
    this.coarseCapacity = coarse;
    this.fineCapacity = fine;
    this.spacing = spacing;
    this.coarseSpacing = spacing;
    this.points = new Float32Array(AXES * (coarse + fine));
  }

  /** How many points there are. */
  get count(): number {
    return this.coarse + this.fine;
  }

  /** Begin anew. */
  clear(): void {
    this.coarse = this.fine = this.firstChanged = 0;
    this.coarseSpacing = this.spacing;
  }

  /** Say that all changes have been taken over. */
  markDrawn(): void {
    this.firstChanged = this.count;
  }

  /** Go on to a point, m. Returns whether it was kept, and not too near to the last one. */
  add(x: number, y: number, z: number): boolean {
    if (this.count > 0 && this.distanceTo(this.count - 1, x, y, z) < this.spacing) {
      return false;
    }
    if (this.fine === this.fineCapacity) {
      this.ageFinePart();
    }
    this.points.set([x, y, z], AXES * this.count);
    this.fine++;
    return true;
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
