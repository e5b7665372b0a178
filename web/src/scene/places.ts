// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Where frames are in one another, in numbers, of a state: by the arithmetic of the scene and in
 * its fixed frame, with WebGL or without.
 */
import { Euler, Matrix4, Quaternion, Vector3 } from 'three';
import type { Layout, Vector } from '../protocol';
import type { State } from '../state';
import type { Store } from '../store';
import { automaticFrame, namesOfFrames, Placement, prefixOf, WORLD, type Body } from './placement';
import { FrameTree, readPose } from './tree';

/** A pose as people read it. */
export interface PoseNumbers {
  position: Vector; // m
  angles: Vector; // roll, pitch, yaw about fixed axes, as in a URDF, rad
  quaternion: [x: number, y: number, z: number, w: number];
}

export class Places {
  private readonly placement: Placement;
  private tree = new FrameTree({ frames: [] });
  private layout: Layout | null = null;
  private bodies: readonly Body[] = [];

  /** `anchors`: where odometry and truth agreed, by the root of the TF tree; shared with the scene. */
  constructor(
    private readonly store: Store,
    anchors: Map<string, Matrix4>,
  ) {
    this.placement = new Placement(anchors);
  }

  /** Take over a state. */
  update(state: State): void {
    if (state.layout !== this.layout) {
      this.layout = state.layout;
      this.tree = new FrameTree(state.layout);
    }
    this.tree.read(state.poses);
    this.bodies = state.robots.flatMap(({ id, truth }) => {
      const root = this.store.models.get(id)?.root;
      if (root === undefined) {
        return [];
      }
      const base = prefixOf(this.tree, id, root) + root;
      // A robot that its URDF fixes to the world is where TF has it.
      const pose = root === WORLD ? null : readPose(truth, 0, new Matrix4());
      return [{ base, truth: pose, links: new Map([[base, new Matrix4()]]) }];
    });
    this.placement.update(this.tree, this.bodies, this.fixedFrame);
  }

  /** The frame that stands still: the chosen one, or else that which suits. */
  get fixedFrame(): string {
    return this.store.fixedFrame ?? this.automatic;
  }

  /** The frame that suits. */
  get automatic(): string {
    return automaticFrame(this.tree, this.bodies);
  }

  /** The frames that can stand still. */
  get frames(): readonly string[] {
    return namesOfFrames(this.tree, this.bodies);
  }

  parentOf(frame: string): string | null {
    return this.tree.parentOf(frame);
  }

  /** The pose of a frame in another one; null where nothing connects them. */
  poseIn(frame: string, target: string): PoseNumbers | null {
    const pose = this.placement.poseIn(frame, target);
    return pose === null ? null : numbersOf(pose);
  }
}

function numbersOf(pose: Matrix4): PoseNumbers {
  const [position, rotation] = [new Vector3(), new Quaternion()];
  pose.decompose(position, rotation, new Vector3());
  const { x, y, z } = new Euler().setFromQuaternion(rotation, 'ZYX');
  return { position: position.toArray(), angles: [x, y, z], quaternion: rotation.toArray() };
}
