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
  length: number; // of its axes, m
}

const SHARE = { link: 0.45, least: 0.035, most: 0.28 }; // of a link's length, of the robot's size
const SAME_PLACE = 0.01; // of the robot's size

/**
 * How long the axes of a robot's frames are, m: less than half of what lies between two of them, so
 * that an arm's can be told from one another.
 *
 * `lengths`: of the links, from joint to joint; `size`: of the robot.
 */
export function axisLength(lengths: readonly number[], size: number): number {
  const apart = lengths.filter((length) => length > SAME_PLACE * size).sort((one, two) => one - two);
  const middle = apart[Math.floor(apart.length / 2)] ?? size;
  return Math.min(Math.max(SHARE.link * middle, SHARE.least * size), SHARE.most * size);
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
    palette.axes.forEach((colour, axis) => this.colours[axis]!.set(colour));
    this.treeColour.set(palette.tree);
  }

  /** Draw frames. */
  draw(frames: readonly PlacedFrame[]): void {
    this.axes.clear();
    this.tree.clear();
    for (const { pose, parent, length } of frames) {
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
export function labelsOf(frames: readonly PlacedFrame[], strong: string): Label[] {
  return frames.map(({ name, pose }) => ({
    key: name,
    text: name,
    at: new Vector3().setFromMatrixPosition(pose),
    isStrong: name === strong,
  }));
}
