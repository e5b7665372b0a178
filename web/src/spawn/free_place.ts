// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Where on the ground another robot has room: beside one, not in what stands there; m, in `world`. */
import type { Quaternion, Shape, Vector } from '../protocol';

/** A robot, seen from above. */
export interface Footprint {
  id: string;
  x: number;
  y: number;
  yaw: number; // rad
  radius: number;
}

export interface Point {
  x: number;
  y: number;
}

const FLAT = 0.02; // m: what is lower is driven over
const TALL = 2; // m: what begins above is driven under
const GAP = 0.3; // m between two robots
const STEP = 0.25; // m from one ring of places to the next
const FAR = 12; // m
const TURNS = [90, -90, 180, 0, 135, -135, 45, -45]; // degrees from the robot's front, best first
const THIN = 0.05; // m, of the way to a place: no wall may be on it

/** A rectangle on the ground. */
interface Block {
  x: number;
  y: number;
  yaw: number;
  halfX: number;
  halfY: number;
}

/** Whether a robot has room at a point. */
export function isFree(
  at: Point, radius: number, robots: readonly Footprint[], shapes: readonly Shape[],
): boolean {
  const isClear = robots.every((each) => Math.hypot(each.x - at.x, each.y - at.y) >= each.radius + radius);
  return isClear && blocksOf(shapes).every((block) => distanceTo(block, at) >= radius);
}

/**
 * The place for a robot that is nearest to the first of the robots, with nothing between the two, or
 * where there is no robot to the origin; null: none within 12 m.
 */
export function freePlace(
  radius: number, robots: readonly Footprint[], shapes: readonly Shape[],
): Point | null {
  const blocks = blocksOf(shapes);
  const begin = robots[0] ?? { x: 0, y: 0, yaw: 0, radius: 0 };
  const fits = (at: Point): boolean =>
    robots.every((each) => Math.hypot(each.x - at.x, each.y - at.y) >= each.radius + radius) &&
    blocks.every((block) => distanceTo(block, at) >= radius) &&
    (robots.length === 0 || isOpen(begin, at, blocks));
  if (robots.length === 0 && fits(begin)) {
    return { x: 0, y: 0 };
  }
  for (let far = begin.radius + radius + GAP; far < FAR; far += STEP) {
    for (const turn of TURNS) {
      const angle = begin.yaw + (turn * Math.PI) / 180;
      const at = {
        x: rounded(begin.x + far * Math.cos(angle)),
        y: rounded(begin.y + far * Math.sin(angle)),
      };
      if (fits(at)) {
        return at;
      }
    }
  }
  return null;
}

/** Whether nothing stands on the straight way between two points. */
function isOpen(from: Point, to: Point, blocks: readonly Block[]): boolean {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  const count = Math.ceil(length / THIN);
  return Array.from({ length: count }, (_, at) => (at + 1) / count).every((share) => {
    const point = { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y) };
    return blocks.every((block) => distanceTo(block, point) >= THIN);
  });
}

/** How far a point is from a rectangle; 0 within. */
function distanceTo({ x, y, yaw, halfX, halfY }: Block, at: Point): number {
  const [right, up] = [at.x - x, at.y - y];
  const along = Math.abs(right * Math.cos(yaw) + up * Math.sin(yaw));
  const across = Math.abs(up * Math.cos(yaw) - right * Math.sin(yaw));
  return Math.hypot(Math.max(0, along - halfX), Math.max(0, across - halfY));
}

/** What the shapes take of the ground. */
function blocksOf(shapes: readonly Shape[]): Block[] {
  return shapes.flatMap((shape) => {
    if (shape.kind === 'plane') {
      return []; // a ground, or a piece of one
    }
    const [low, high] = extentOf(shape);
    const half: Vector = [(high[0] - low[0]) / 2, (high[1] - low[1]) / 2, (high[2] - low[2]) / 2];
    const middle: Vector = [(high[0] + low[0]) / 2, (high[1] + low[1]) / 2, (high[2] + low[2]) / 2];
    const [x, y, z] = rotated(shape.orientation, middle);
    const axes = ([[half[0], 0, 0], [0, half[1], 0], [0, 0, half[2]]] as Vector[]).map((axis) =>
      rotated(shape.orientation, axis),
    );
    const reach = (axis: number): number =>
      axes.reduce((sum, each) => sum + Math.abs(each[axis] ?? 0), 0);
    const height = shape.position[2] + z;
    if (height + reach(2) < FLAT || height - reach(2) > TALL) {
      return [];
    }
    const [qx, qy, qz, qw] = shape.orientation;
    const isUpright = Math.hypot(qx, qy) < 1e-3;
    return [
      {
        x: shape.position[0] + x,
        y: shape.position[1] + y,
        yaw: isUpright ? 2 * Math.atan2(qz, qw) : 0,
        halfX: isUpright ? half[0] : reach(0),
        halfY: isUpright ? half[1] : reach(1),
      },
    ];
  });
}

/** The least and the greatest corner of a shape about its own origin. */
function extentOf({ kind, size, points }: Shape): [low: Vector, high: Vector] {
  if (kind !== 'triangles') {
    return [[-size[0] / 2, -size[1] / 2, -size[2] / 2], [size[0] / 2, size[1] / 2, size[2] / 2]];
  }
  const axis = (at: number): number[] => points.filter((_, index) => index % 3 === at);
  const bound = (pick: (one: number, other: number) => number): Vector => {
    const of = (at: number): number => axis(at).reduce((one, other) => pick(one, other), axis(at)[0] ?? 0);
    return [of(0), of(1), of(2)];
  };
  return [bound(Math.min), bound(Math.max)];
}

function rotated([qx, qy, qz, qw]: Quaternion, [x, y, z]: Vector): Vector {
  // v + 2 q × (q × v + w v)
  const [tx, ty, tz] = [qy * z - qz * y + qw * x, qz * x - qx * z + qw * y, qx * y - qy * x + qw * z];
  return [x + 2 * (qy * tz - qz * ty), y + 2 * (qz * tx - qx * tz), z + 2 * (qx * ty - qy * tx)];
}

function rounded(value: number): number {
  return Math.round(value * 100) / 100;
}
