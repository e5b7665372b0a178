// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The trails of a robot: ground truth and odometry. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Line,
  LineBasicMaterial,
  Matrix4,
  Sphere,
} from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { RobotState } from '../state';
import { ODOMETRY_COLOUR, TRUTH_COLOUR } from './theme';
import { Trail } from './trail';
import { readPose } from './tree';

const WIDTH = 3; // CSS pixels
const SPARSE = { coarse: 1024, fine: 1024, spacing: 0.04 }; // where the processor draws
const LIFT = 0.004; // m, so that a trail on the ground is seen
const BIAS = -800; // of depth, so that the ground does not take half of a flat line's width
const JUMP = 0.5; // m at once, beyond what speed explains: it was put there
const FASTEST = 10; // m/s

/** A trail, drawn. */
class TrailLine {
  readonly trail: Trail;
  readonly object: LineSegments2 | Line;
  private readonly buffer: InstancedInterleavedBuffer | BufferAttribute;

  /**
   * `lift` in m. Where the processor draws, the line is one pixel wide, of fewer points: a wide
   * one of 13,000 pieces cost 0.5 s of its time a frame.
   */
  constructor(colour: string, private readonly lift: number, isSoftware: boolean) {
    this.trail = new Trail(isSoftware ? SPARSE : {});
    const { points } = this.trail;
    this.buffer = isSoftware
      ? new BufferAttribute(points, 3)
      : new InstancedInterleavedBuffer(points, 3, 1);
    this.buffer.setUsage(DynamicDrawUsage);
    this.buffer.onUpload(() => this.trail.markDrawn());
    this.object =
      this.buffer instanceof BufferAttribute
        ? thinLine(this.buffer, colour)
        : wideLine(this.buffer, colour);
    this.object.geometry.boundingSphere = new Sphere();
    this.object.frustumCulled = false; // its extent is not followed
    this.object.raycast = () => {};
    this.draw();
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
    this.object.geometry.dispose();
    [this.object.material].flat().forEach((material) => material.dispose());
  }

  private draw(): void {
    const { count, firstChanged } = this.trail;
    const { geometry } = this.object;
    if (geometry instanceof LineSegmentsGeometry) {
      geometry.instanceCount = Math.max(0, count - 1);
    } else {
      geometry.setDrawRange(0, count);
    }
    this.object.visible = count > 1;
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(3 * firstChanged, 3 * (count - firstChanged));
    this.buffer.needsUpdate = true;
  }
}

function wideLine(buffer: InstancedInterleavedBuffer, colour: string): LineSegments2 {
  // Each point is the end of one segment and the start of the next: the two overlap.
  const geometry = new LineSegmentsGeometry();
  geometry.setAttribute('instanceStart', new InterleavedBufferAttribute(buffer, 3, 0));
  geometry.setAttribute('instanceEnd', new InterleavedBufferAttribute(buffer, 3, 3));
  const material = new LineMaterial({ color: new Color(colour).getHex(), linewidth: WIDTH });
  material.polygonOffset = true;
  material.polygonOffsetUnits = BIAS;
  return new LineSegments2(geometry, material);
}

function thinLine(points: BufferAttribute, colour: string): Line {
  const geometry = new BufferGeometry().setAttribute('position', points);
  return new Line(geometry, new LineBasicMaterial({ color: colour }));
}

/**
 * Both trails of one robot.
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
    this.truth = new TrailLine(TRUTH_COLOUR, LIFT, isSoftware);
    this.odometry = new TrailLine(ODOMETRY_COLOUR, 2 * LIFT, isSoftware);
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
      const [x, y, z] = state.truth;
      this.truth.add(x, y, z);
      this.last = { x, y, z, time };
    }
    if (odometry !== null) {
      const [x, y, z] = state.odometry;
      this.odometry.add(x, y, z);
    }
    return hasJumped;
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

  private hasJumped([x, y, z]: Float32Array, time: number): boolean {
    if (this.last === null) {
      return false;
    }
    const distance = Math.hypot(x - this.last.x, y - this.last.y, z - this.last.z);
    return distance > JUMP + FASTEST * Math.abs(time - this.last.time);
  }
}
