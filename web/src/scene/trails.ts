// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The trails of a robot: ground truth and odometry. */
import { Group, Matrix4 } from 'three';
import { vectorAt, type RobotState } from '../state';
import { Ribbon } from './ribbon';
import { PALETTES } from './theme';
import { Trail } from './trail';
import { readPose } from './tree';

const WIDTH = 3; // CSS pixels
const SPARSE = { coarse: 1024, fine: 1024, spacing: 0.04 }; // where the processor draws
const DASH = 0.16; // m, from one dash of the odometry to the next: less than a robot is long
const LIFT = 0.004; // m, so that a trail on the ground is seen
const JUMP = 0.5; // m at once, beyond what speed explains: it was put there
const FASTEST = 10; // m/s

/** A trail, drawn. */
class TrailLine {
  readonly trail: Trail;
  private readonly ribbon: Ribbon;

  /** `lift` in m. Where the processor draws there are fewer points. */
  constructor(private readonly lift: number, isDashed: boolean, isSoftware: boolean) {
    this.trail = new Trail(isSoftware ? SPARSE : {});
    const dash = isDashed ? Math.round(DASH / this.trail.spacing) : 0;
    this.ribbon = new Ribbon(this.trail.points, WIDTH, dash, () => this.trail.markDrawn());
    this.draw();
  }

  get object(): Ribbon['object'] {
    return this.ribbon.object;
  }

  setColour(colour: string): void {
    this.ribbon.setColour(colour);
  }

  add(x: number, y: number, z: number): void {
    if (this.trail.add(x, y, z + this.lift)) {
      this.draw();
    }
  }

  clear(): void {
    this.trail.clear();
    this.draw();
  }

  dispose(): void {
    this.ribbon.dispose();
  }

  private draw(): void {
    this.ribbon.draw(this.trail.drawn, this.trail.firstChanged);
  }
}

/**
 * Both trails of one robot: the truth's whole, the odometry's dashed, so that each is seen where they
 * lie on one another, and without colours, too.
 *
 * Odometry begins anywhere; its trail is anchored where the two agreed first, so that what lies
 * between them is the drift: T_world_odom = T_world_base · T_odom_base⁻¹.
 */
export class Trails {
  /** In `world`, or without truth in the frame of the odometry. */
  readonly object = new Group();
  private readonly truth: TrailLine;
  private readonly odometry: TrailLine;
  private anchor: Matrix4 | null = null;
  private last: { x: number; y: number; z: number; time: number } | null = null;

  constructor(isSoftware: boolean) {
    this.truth = new TrailLine(LIFT, false, isSoftware);
    this.odometry = new TrailLine(2 * LIFT, true, isSoftware);
    this.setColours(PALETTES.light.truth, PALETTES.light.odometry);
    this.object.matrixAutoUpdate = false;
    this.odometry.object.matrixAutoUpdate = false;
    this.object.add(this.truth.object, this.odometry.object);
  }

  /**
   * Go on; `time` in s. Returns whether they began anew: the robot was put somewhere else, which
   * is no drift.
   */
  add(state: RobotState, time: number): boolean {
    const truth = readPose(state.truth, 0, new Matrix4());
    const odometry = readPose(state.odometry, 0, new Matrix4());
    const hasJumped = truth !== null && this.hasJumped(state.truth, time);
    if (hasJumped) {
      this.clear();
    }
    if (truth !== null && odometry !== null && this.anchor === null) {
      this.odometry.clear(); // what came before the truth did is in another frame
      this.anchor = truth.clone().multiply(odometry.clone().invert());
      this.odometry.object.matrix.copy(this.anchor);
    }
    if (truth !== null) {
      const [x, y, z] = vectorAt(state.truth, 0);
      this.truth.add(x, y, z);
      this.last = { x, y, z, time };
    }
    if (odometry !== null) {
      this.odometry.add(...vectorAt(state.odometry, 0));
    }
    return hasJumped;
  }

  setColours(truth: string, odometry: string): void {
    this.truth.setColour(truth);
    this.odometry.setColour(odometry);
  }

  /** Where the odometry's frame is in `world`; null: not known, or there is no truth. */
  get anchorInWorld(): Matrix4 | null {
    return this.anchor?.clone() ?? null;
  }

  /** How many points there are: of the truth's trail, and of the odometry's. */
  get counts(): [truth: number, odometry: number] {
    return [this.truth.trail.count, this.odometry.trail.count];
  }

  /** Put `world`, or the odometry's frame, somewhere; null: hide them. */
  place(pose: Matrix4 | null, shown: boolean): void {
    this.object.visible = shown && pose !== null;
    if (pose !== null) {
      this.object.matrix.copy(pose);
      this.object.matrixWorldNeedsUpdate = true;
    }
  }

  clear(): void {
    this.truth.clear();
    this.odometry.clear();
    this.odometry.object.matrix.identity();
    this.anchor = this.last = null;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.truth.dispose();
    this.odometry.dispose();
  }

  private hasJumped(truth: Float32Array, time: number): boolean {
    if (this.last === null) {
      return false;
    }
    const [x, y, z] = vectorAt(truth, 0);
    const distance = Math.hypot(x - this.last.x, y - this.last.y, z - this.last.z);
    return distance > JUMP + FASTEST * Math.abs(time - this.last.time);
  }
}
