// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A line between two points that are measured, with its length. */
import { Color, Group, Vector3 } from 'three';
import type { Label } from './labels';
import { Segments } from './segments';
import type { Palette } from './theme';

const CROSS = 0.03; // m

export class Ruler {
  readonly object = new Group();
  private readonly line = new Segments(3);
  private readonly colour = new Color();
  private ends: readonly [Vector3, Vector3] | null = null;
  private text = '';

  constructor() {
    this.object.add(this.line.object);
    this.draw();
  }

  setPalette({ highlight }: Palette): void {
    this.colour.set(highlight);
    this.draw();
  }

  /** Show the way from one point to another, in the frame of the scene; null: none. */
  set(from: Vector3 | null, to: Vector3 | null, text: string): void {
    this.ends = from !== null && to !== null ? [from.clone(), to.clone()] : null;
    this.text = text;
    this.draw();
  }

  labels(): Label[] {
    if (this.ends === null || this.text === '') {
      return [];
    }
    const at = this.ends[0].clone().lerp(this.ends[1], 0.5);
    return [{ key: '\nruler', text: this.text, at, isStrong: true }];
  }

  private draw(): void {
    this.line.clear();
    if (this.ends !== null) {
      this.line.add(...this.ends, this.colour);
      for (const end of this.ends) {
        for (const axis of [[CROSS, 0, 0], [0, CROSS, 0], [0, 0, CROSS]]) {
          const half = new Vector3().fromArray(axis);
          this.line.add(end.clone().sub(half), end.clone().add(half), this.colour);
        }
      }
    }
    this.line.commit();
  }
}
