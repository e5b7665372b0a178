// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A robot in the scene: its view, its trails, and which frames of TF are its links. */
import { Matrix4, Vector3 } from 'three';
import type { Model } from '../protocol';
import type { RobotState } from '../state';
import type { Body, Placement } from './placement';
import { RobotView, type RobotEvents } from './robot';
import { Trails } from './trails';
import { readPose, type FrameTree } from './tree';

export class RobotEntry {
  readonly id: string;
  readonly view: RobotView;
  readonly trails: Trails;
  /** Its largest extent, m. */
  size = 0;
  body: Body | null = null;
  private state: RobotState | null = null;

  /** `isShaded`: shadows fall on it; `before`: what this one replaces, whose trails go on. */
  constructor(model: Model, isShaded: boolean, events: RobotEvents, before?: RobotEntry) {
    this.id = model.robot;
    this.view = new RobotView(model, isShaded, events);
    this.trails = before?.trails ?? new Trails(!isShaded);
    this.measure();
  }

  /** Apply a state; `joints` in the order of the layout. */
  read(tree: FrameTree, joints: readonly string[], state: RobotState | null): void {
    this.state = state;
    const prefix = this.prefixIn(tree);
    if (state !== null) {
      this.view.setJoints(joints, state.positions);
    }
    this.readUnknownJoints(tree, prefix, new Map(joints.map((name, at) => [name, at])));
    const links = new Map<string, Matrix4>();
    this.view.linkPoses().forEach((pose, link) => links.set(prefix + link, pose));
    const truth = state && readPose(state.truth, 0, new Matrix4());
    this.body = { base: prefix + this.view.base, truth, links };
  }

  /** Put it where it is; `world`: where that is. */
  place(placement: Placement, world: Matrix4 | null, withTrails: boolean): void {
    const pose = this.body && placement.poseOfBody(this.body);
    this.view.place(pose);
    const odometry = this.state && readPose(this.state.odometry, 0, new Matrix4());
    const frame = this.trails.anchorInWorld
      ? world
      : pose && odometry && pose.clone().multiply(odometry.invert());
    this.trails.place(frame, withTrails);
  }

  /** Find its size anew. */
  measure(): void {
    const { x, y, z } = this.view.bounds().getSize(new Vector3());
    this.size = Number.isFinite(x) ? Math.max(x, y, z) : 0;
  }

  dispose(): void {
    this.view.dispose();
    this.trails.dispose();
  }

  /** Links are frames of the same name, in a namespace often behind "<namespace>/". */
  private prefixIn(tree: FrameTree): string {
    const namespace = this.id.replace(/^\//, '');
    const own = namespace && `${namespace}/`;
    const isPlain = !tree.has(own + this.view.base) && tree.has(this.view.base);
    return isPlain ? '' : own;
  }

  /** Place the links of joints without published positions as in TF. */
  private readUnknownJoints(
    tree: FrameTree, prefix: string, places: ReadonlyMap<string, number>,
  ): void {
    for (const { link, parent, joint } of this.view.movingLinks) {
      const position = this.state?.positions[places.get(joint) ?? -1];
      const local = tree.localOf(prefix + link);
      const isTold = position !== undefined && Number.isFinite(position);
      if (!isTold && local !== null && tree.parentOf(prefix + link) === prefix + parent) {
        this.view.setLinkPose(link, local);
      }
    }
  }
}
