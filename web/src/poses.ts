// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Poses of frames in one another, from a state. */
import { POSE_FLOATS, type Layout, type Quaternion, type Vector } from './protocol';
import type { State } from './state';

export interface Pose {
  position: Vector; // m
  orientation: Quaternion; // x, y, z, w
}

const HERE: Pose = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };

/** The pose of the frame at an index of the layout, in its parent. */
function poseAt(state: State, index: number): Pose {
  const [x, y, z, qx, qy, qz, qw] = state.poses.subarray(index * POSE_FLOATS);
  return { position: [x, y, z], orientation: [qx, qy, qz, qw] };
}

/** The pose of a frame in another one; null when nothing connects the two. */
export function poseIn(state: State, frame: string, target: string): Pose | null {
  const one = inRoot(state, frame);
  const other = inRoot(state, target);
  return one.root === other.root ? compose(inverse(other.pose), one.pose) : null;
}

/** Roll, pitch and yaw (rad) about fixed axes, as in a URDF. */
export function rollPitchYaw([x, y, z, w]: Quaternion): Vector {
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

/** The root frames of a layout, in the order in which they are named. */
export function rootsOf(layout: Layout): string[] {
  const children = new Set(layout.frames.map(({ name }) => name));
  return [...new Set(layout.frames.map(({ parent }) => parent))].filter(
    (parent) => !children.has(parent),
  );
}

function inRoot(state: State, frame: string): { root: string; pose: Pose } {
  const { frames } = state.layout;
  let root = frame;
  let pose = HERE;
  // Parents stand before children, so one walk to the front of the list meets them all.
  for (let index = frames.length - 1; index >= 0; index -= 1) {
    if (frames[index].name === root) {
      pose = compose(poseAt(state, index), pose);
      root = frames[index].parent;
    }
  }
  return { root, pose };
}

/** First `inner`, then `outer`: the pose of what has the pose `inner` in the frame of `outer`. */
export function compose(outer: Pose, inner: Pose): Pose {
  const [x, y, z] = rotate(outer.orientation, inner.position);
  const [px, py, pz] = outer.position;
  return {
    position: [px + x, py + y, pz + z],
    orientation: product(outer.orientation, inner.orientation),
  };
}

export function inverse({ position, orientation }: Pose): Pose {
  const [x, y, z, w] = orientation;
  const back: Quaternion = [-x, -y, -z, w];
  const [px, py, pz] = rotate(back, position);
  return { position: [-px, -py, -pz], orientation: back };
}

function product(a: Quaternion, b: Quaternion): Quaternion {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

function rotate(q: Quaternion, [x, y, z]: Vector): Vector {
  const back: Quaternion = [-q[0], -q[1], -q[2], q[3]];
  const [rx, ry, rz] = product(product(q, [x, y, z, 0]), back);
  return [rx, ry, rz];
}
