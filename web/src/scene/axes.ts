// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Frames as axes, red x, green y, blue z, each tied to its parent; seen through everything. */
import { Color, Group, Vector3 } from 'three';
import type { Matrix4 } from 'three';
import type { Label } from './labels';
import { Segments } from './segments';
import type { Palette } from './theme';

/** A frame that has a place. */
export interface PlacedFrame {
  name: string;
  pose: Matrix4; // in the frame of the scene
  parent: Matrix4 | null;
}

export class Axes {
  readonly object = new Group();
  private readonly axes = new Segments(3);
  private readonly tree = new Segments(1.5, 0.75);
  private readonly colours = [new Color(), new Color(), new Color()];
  private readonly treeColour = new Color();
  private readonly from = new Vector3();
  private readonly to = new Vector3();

  constructor() {
    this.object.add(this.tree.object, this.axes.object);
  }

  setPalette(palette: Palette): void {
    palette.axes.forEach((colour, axis) => this.colours[axis].set(colour));
    this.treeColour.set(palette.tree);
  }

  /** Draw frames; axes are `length` m long. */
  draw(frames: readonly PlacedFrame[], length: number): void {
    this.axes.clear();
    this.tree.clear();
    for (const { pose, parent } of frames) {
      this.from.setFromMatrixPosition(pose);
      this.colours.forEach((colour, axis) => {
        this.to.setFromMatrixColumn(pose, axis).multiplyScalar(length).add(this.from);
        this.axes.add(this.from, this.to, colour);
      });
      if (parent !== null) {
        this.to.setFromMatrixPosition(parent);
        this.tree.add(this.from, this.to, this.treeColour);
      }
    }
    this.axes.commit();
    this.tree.commit();
  }
}

/** The names of frames, to be written where they are. */
export function labelsOf(frames: readonly PlacedFrame[], fixedFrame: string): Label[] {
  return frames.map(({ name, pose }) => ({
    text: name,
    at: new Vector3().setFromMatrixPosition(pose),
    isStrong: name === fixedFrame,
  }));
}
