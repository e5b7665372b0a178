// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The TF tree of a layout, with the poses of a state: each frame in the root of its tree. */
import { Matrix4, Quaternion, Vector3 } from 'three';
import { POSE_FLOATS, type Layout } from '../protocol';
import { isKnownPose } from '../state';

const position = new Vector3();
const rotation = new Quaternion();
const ONES = new Vector3(1, 1, 1);

/** The transform in seven numbers, x y z (m) qx qy qz qw, or null where it is not known. */
export function readPose(values: Float32Array, offset: number, into: Matrix4): Matrix4 | null {
  if (!isKnownPose(values, offset)) {
    return null;
  }
  position.fromArray(values, offset);
  rotation.fromArray(values, offset + 3).normalize();
  return into.compose(position, rotation, ONES);
}

export class FrameTree {
  /** All frames, parents before children. */
  readonly names: ReadonlySet<string>;
  private readonly parents = new Map<string, string>();
  private readonly locals = new Map<string, Matrix4 | null>(); // in the parent
  private readonly places = new Map<string, number>(); // of the frame's pose in a state

  constructor(layout: Pick<Layout, 'frames'>) {
    const names = new Set<string>();
    layout.frames.forEach(({ name, parent }, index) => {
      names.add(parent).add(name);
      this.parents.set(name, parent);
      this.places.set(name, POSE_FLOATS * index);
    });
    this.names = names;
  }

  /** Take over the poses of a state of this layout. */
  read(poses: Float32Array): void {
    for (const [name, offset] of this.places) {
      this.locals.set(name, readPose(poses, offset, this.locals.get(name) ?? new Matrix4()));
    }
  }

  has(name: string): boolean {
    return this.names.has(name);
  }

  /** The parent of a frame; null for a root. */
  parentOf(name: string): string | null {
    return this.parents.get(name) ?? null;
  }

  /** The pose of a frame in its parent; null for a root, and where it is not known. */
  localOf(name: string): Matrix4 | null {
    return this.locals.get(name) ?? null;
  }

  /** The root of a frame's tree. */
  rootOf(name: string): string {
    let root = name;
    for (let parent = this.parentOf(root); parent !== null; parent = this.parentOf(root)) {
      root = parent;
    }
    return root;
  }

  /** The frame below the root on the way to a frame; the frame itself where it is a root. */
  belowRoot(name: string): string {
    let below = name;
    for (let parent = this.parentOf(name); parent !== null; parent = this.parentOf(parent)) {
      below = this.parentOf(parent) === null ? below : parent;
    }
    return below;
  }

  /** The pose of a frame in `rootOf(name)`; null where one on the way is not known. */
  inRoot(name: string): Matrix4 | null {
    const pose = new Matrix4();
    for (let frame = name; this.parentOf(frame) !== null; frame = this.parentOf(frame) as string) {
      const local = this.localOf(frame);
      if (local === null) {
        return null;
      }
      pose.premultiply(local);
    }
    return pose;
  }
}
