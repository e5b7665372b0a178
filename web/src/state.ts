// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The binary frames of protocol.ts, decoded without a copy: the numbers stay where they came. */
import {
  COMMAND_FLOATS,
  HEADER_BYTES,
  JOINT_FLOATS,
  MOTION_FLOATS,
  POSE_FLOATS,
  STATE_KIND,
  WHEEL_FLOATS,
  type Layout,
  type Vector,
} from './protocol';

/** All that moves, at one time. The arrays are views of the frame; NaN is what is not known. */
export interface State {
  layout: Layout;
  sequence: number; // grows by one a state, and from 2^32 - 1 to 0
  time: number; // s
  poses: Float32Array; // x y z (m) qx qy qz qw of each frame of the layout, in its parent
  robots: RobotState[]; // in the order of the layout
}

/** One robot of a state. */
export interface RobotState {
  id: string;
  positions: Float32Array; // of each joint of the layout, rad or m
  velocities: Float32Array; // rad/s or m/s
  commanded: Float32Array; // the velocity that its controller wants of each, rad/s or m/s
  odometry: Float32Array; // x y z qx qy qz qw, linear x (m/s), angular z (rad/s), linear y
  truth: Float32Array; // the same, in `world`
  command: Float32Array; // linear x (m/s), angular z (rad/s), linear y (m/s)
  wheels: Float32Array; // of each: contact (0, 1), normal force (N), slip along, across (m/s)
}

/** What the wheels of a state hold, for each: see protocol.ts. */
export type WheelNumbers = [contact: number, force: number, along: number, across: number];

/** Three numbers, such as a point, of those that stand in threes; not a number where it ends. */
export function vectorAt(numbers: Float32Array, index: number): Vector {
  const at = 3 * index;
  return [numbers[at] ?? NaN, numbers[at + 1] ?? NaN, numbers[at + 2] ?? NaN];
}

/** A frame that is not of the protocol: a fault of one of the two sides, not of the wire. */
export class BadState extends Error {
  override readonly name = 'BadState';
}

/** How many bytes a state of a layout has. */
export function stateBytes(layout: Layout): number {
  let floats = POSE_FLOATS * layout.frames.length;
  for (const { joints, wheels } of layout.robots) {
    floats += JOINT_FLOATS * joints.length + 2 * MOTION_FLOATS + COMMAND_FLOATS;
    floats += WHEEL_FLOATS * wheels.length;
  }
  return HEADER_BYTES + 4 * floats;
}

/**
 * Read a binary frame.
 *
 * Returns null for a state of another layout than this: it was on its way when the layout changed.
 * Throws {@link BadState} where kind or length are not those of a state.
 */
export function decodeState(buffer: ArrayBuffer, layout: Layout): State | null {
  if (buffer.byteLength < HEADER_BYTES) {
    throw new BadState(`a frame of ${buffer.byteLength} bytes, less than its header`);
  }
  const header = new DataView(buffer, 0, HEADER_BYTES);
  if (header.getUint8(0) !== STATE_KIND) {
    throw new BadState(`a frame of kind ${header.getUint8(0)}, not ${STATE_KIND}`);
  }
  if (header.getUint16(2, true) !== layout.id) {
    return null;
  }
  const wanted = stateBytes(layout);
  if (buffer.byteLength !== wanted) {
    throw new BadState(
      `a state of ${buffer.byteLength} bytes; layout ${layout.id} asks for ${wanted}`,
    );
  }
  const floats = new Float32Array(buffer, HEADER_BYTES);
  let at = 0;
  const take = (count: number): Float32Array => floats.subarray(at, (at += count));
  return {
    layout,
    sequence: header.getUint32(4, true),
    time: header.getFloat64(8, true),
    poses: take(POSE_FLOATS * layout.frames.length),
    robots: layout.robots.map(({ id, joints, wheels }) => ({
      id,
      positions: take(joints.length),
      velocities: take(joints.length),
      commanded: take(joints.length),
      odometry: take(MOTION_FLOATS),
      truth: take(MOTION_FLOATS),
      command: take(COMMAND_FLOATS),
      wheels: take(WHEEL_FLOATS * wheels.length),
    })),
  };
}

/** Whether the pose that begins at `offset` is known: all seven numbers are finite. */
export function isKnownPose(values: Float32Array, offset = 0): boolean {
  for (let i = offset; i < offset + POSE_FLOATS; i++) {
    if (!Number.isFinite(values[i])) {
      return false;
    }
  }
  return true;
}
