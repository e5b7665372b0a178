// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Paths: a line through their poses, in their own frames. */
import { Group } from 'three';
import type { Route, SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import type { LocateFrame } from './grids';
import { Ribbon } from './ribbon';

const WIDTH = 4; // CSS px
const LIFT = 0.012; // m, above maps and trails
const FLOATS = 3;

interface Shown {
  robot: string;
  frame: string;
  count: number; // points
  points: Float32Array;
  ribbon: Ribbon;
  isFaded: boolean;
}

export class Routes {
  readonly object = new Group();
  private readonly shown = new Map<string, Shown>();
  private colour = '#000';
  private faded = '#000';

  /** `faded`: of paths that nobody follows any more. */
  setColours(colour: string, faded: string): void {
    [this.colour, this.faded] = [colour, faded];
    this.shown.forEach((each) => this.paint(each));
  }

  /** The goal of a robot has ended, in whatever way: its paths fade, until the next one comes. */
  fade(robot: string): void {
    for (const each of this.shown.values()) {
      if (each.robot === robot) {
        each.isFaded = true;
        this.paint(each);
      }
    }
  }

  take({ topic, robot }: SensorInfo, { head, floats }: Sample<Route>): void {
    const count = Math.floor(floats.length / FLOATS);
    let each = this.shown.get(topic);
    if (each === undefined || each.points.length < FLOATS * count) {
      this.drop(topic);
      each = this.newRoute(robot, count);
      this.shown.set(topic, each);
    }
    if (each.isFaded) {
      each.isFaded = false;
      this.paint(each);
    }
    each.frame = head.origin.frame;
    each.count = count;
    each.points.set(floats.subarray(0, FLOATS * count));
    for (let i = 2; i < FLOATS * count; i += FLOATS) {
      each.points[i]! += LIFT;
    }
    each.ribbon.draw(count, 0);
  }

  /** Draw no others than these. */
  retain(topics: ReadonlySet<string>): void {
    [...this.shown.keys()].filter((topic) => !topics.has(topic)).forEach((topic) => this.drop(topic));
  }

  place(locate: LocateFrame): void {
    for (const { robot, frame, count, ribbon } of this.shown.values()) {
      const pose = locate(frame, robot);
      ribbon.object.visible = pose !== null && count > 1;
      if (pose !== null) {
        ribbon.object.matrix.copy(pose);
        ribbon.object.matrixWorldNeedsUpdate = true;
      }
    }
  }

  /** The points of each path that is drawn. */
  numbers(): Record<string, number> {
    return Object.fromEntries([...this.shown].map(([topic, { count }]) => [topic, count]));
  }

  private newRoute(robot: string, count: number): Shown {
    const points = new Float32Array(FLOATS * 2 ** Math.ceil(Math.log2(Math.max(64, count))));
    const ribbon = new Ribbon(points, WIDTH, 0, () => {});
    ribbon.setColour(this.colour);
    ribbon.object.matrixAutoUpdate = false;
    this.object.add(ribbon.object);
    return { robot, frame: '', count, points, ribbon, isFaded: false };
  }

  private paint({ ribbon, isFaded }: Shown): void {
    ribbon.setColour(isFaded ? this.faded : this.colour);
  }

  private drop(topic: string): void {
    const each = this.shown.get(topic);
    each?.ribbon.object.removeFromParent();
    each?.ribbon.dispose();
    this.shown.delete(topic);
  }
}
