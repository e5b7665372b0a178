// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A robot in the scene: its view, its trails, and which frames of TF are its links. */
import { Matrix4, Vector3 } from 'three';
import type { Box3 } from 'three';
import type { Model } from '../protocol';
import type { RobotState } from '../state';
import { axisLength } from './axes';
import { prefixOf, type Body, type Placement } from './placement';
import { RobotView, type RobotEvents } from './robot';
import { RobotMark } from './robot_mark';
import { Trails } from './trails';
import { readPose, type FrameTree } from './tree';

export class RobotEntry {
  readonly id: string;
  readonly view: RobotView;
  readonly trails: Trails;
  /** Its largest extent, m. */
  size = 0;
  /** How long axes of its frames are, m. */
  axisLength = 0;
  body: Body | null = null;
  /** What stands before the names of its links in TF. */
  prefix = '';
  readonly mark = new RobotMark();
  private box: Box3 | null = null; // in its base
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
    const prefix = (this.prefix = prefixOf(tree, this.id, this.view.base));
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
    this.mark.place(pose);
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
    const lengths = this.view.linkLengths;
    const reach = lengths.reduce((sum, length) => sum + length, 0); // where nothing is drawn
    this.axisLength = axisLength(lengths, this.size || reach);
    this.box = this.view.localBounds();
    this.mark.measure(this.box);
  }

  /** The link that a frame is, if it is one of this robot's. */
  linkOf(frame: string): string | null {
    const link = frame.startsWith(this.prefix) ? frame.slice(this.prefix.length) : '';
    return link in this.view.object.links ? link : null;
  }

  /** The radius of the circle that it takes on the ground, m, about its base. */
  get radius(): number {
    const { box } = this;
    const corners = box === null ? [] : [box.min, box.max];
    return Math.hypot(
      Math.max(0, ...corners.map(({ x }) => Math.abs(x))),
      Math.max(0, ...corners.map(({ y }) => Math.abs(y))),
    );
  }

  /** Its middle, and its sides as an eye sees them, m in the scene. */
  middles(eye: Vector3): Vector3[] {
    const { box, mark, radius } = this;
    if (box === null || !mark.object.visible) {
      return [];
    }
    const middle = box.getCenter(new Vector3()).applyMatrix4(mark.object.matrix);
    const aside = middle.clone().sub(eye).cross(new Vector3(0, 0, 1)).setLength(0.7 * radius);
    return [middle, middle.clone().add(aside), middle.clone().sub(aside)];
  }

  /** Where its name is written: above it, m in the scene; null: it is not to be seen. */
  get top(): Vector3 | null {
    const { box, mark, size } = this;
    if (box === null || !mark.object.visible) {
      return null;
    }
    const top = box.getCenter(new Vector3()).setZ(box.max.z + 0.06 * size);
    return top.applyMatrix4(mark.object.matrix);
  }

  dispose(): void {
    this.view.dispose();
    this.mark.dispose();
    this.trails.dispose();
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
