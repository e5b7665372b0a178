// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The robots of the scene by their ids, and what is asked of all of them. */
import { Box3, Vector3 } from 'three';
import type { Footprint } from '../spawn/free_place';
import type { RobotEntry } from './entry';
import type { RobotView } from './robot';

const NEAR = 12; // m; robots further away are not brought into view with the first

export class Robots extends Map<string, RobotEntry> {
  private readonly radii = new Map<string, number>(); // of robots that were here, m

  /** Take a robot away, with its trails. */
  remove(robot: string): void {
    this.radiusOf(robot);
    this.get(robot)?.dispose();
    this.delete(robot);
  }

  /**
   * Light up the link of a robot, null: of any, that a frame is; null: none. Returns it, and the
   * robot; null: the frame is no link.
   */
  choose(
    robot: string | null, frame: string | null, colour: string,
  ): { entry: RobotEntry; link: string } | null {
    let chosen: { entry: RobotEntry; link: string } | null = null;
    for (const [id, entry] of this) {
      const isOwn = robot === null || id === robot;
      const link = frame === null || !isOwn ? null : entry.linkOf(frame);
      entry.view.choose(link, colour);
      chosen = link === null ? chosen : { entry, link };
    }
    return chosen;
  }

  /** The frame that is a link of a robot. */
  frameOf(robot: string, link: string): string {
    return `${this.get(robot)?.prefix ?? ''}${link}`;
  }

  /** The robots by their names. */
  views(): Map<string, RobotView> {
    return new Map([...this].map(([id, { view }]) => [id, view]));
  }

  /** The size of the largest robot, m; 1 where there is none. */
  get largest(): number {
    return Math.max(0, ...[...this.values()].map((entry) => entry.size)) || 1;
  }

  /** How many points the trails have, by robot. */
  trailSizes(): Record<string, [truth: number, odometry: number]> {
    const sizes = [...this].map(([id, { trails }]) => [id, trails.counts] as const);
    return Object.fromEntries(sizes);
  }

  /** Those that stand in `world`, from above, m. */
  footprints(): Footprint[] {
    return [...this].flatMap(([id, { body, radius }]) => {
      const pose = body?.truth;
      if (!pose) {
        return [];
      }
      const { x, y } = new Vector3().setFromMatrixPosition(pose);
      return [{ id, x, y, yaw: Math.atan2(pose.elements[1], pose.elements[0]), radius }];
    });
  }

  /** The radius of the circle that a robot takes, or took before it went, on the ground, m. */
  radiusOf(robot: string): number | null {
    const radius = this.get(robot)?.radius ?? 0;
    if (radius > 0) {
      this.radii.set(robot, radius);
    }
    return this.radii.get(robot) ?? null;
  }

  /** The extent of a robot that is to be seen, m. */
  boundsOf(robot: string): Box3 | null {
    const view = this.get(robot)?.view;
    const bounds = view?.object.visible === true ? view.bounds() : null;
    return bounds === null || bounds.isEmpty() ? null : bounds;
  }

  /** The extent of the robots that are near the first one, m. */
  bounds(): Box3 {
    const box = new Box3();
    for (const view of this.views().values()) {
      const bounds = view.object.visible ? view.bounds() : new Box3();
      const isNear = box.isEmpty() || bounds.distanceToPoint(box.getCenter(new Vector3())) < NEAR;
      if (isNear) {
        box.union(bounds);
      }
    }
    return box;
  }
}
