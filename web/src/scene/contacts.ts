// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How each wheel stands on the ground: a disc for its load, an arrow for its slip. */
import {
  CircleGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Vector3,
} from 'three';
import { WHEEL_FLOATS } from '../protocol';
import type { RobotState, WheelNumbers } from '../state';
import type { RobotView } from './robot';
import { Segments } from './segments';
import type { Palette } from './theme';

const MOST = 256; // wheels in all
const METRES_PER_SPEED = 0.5; // of an arrow, m for each m/s of slip
const SHORTEST = 0.01; // m/s; less is no slip
const LONGEST = 0.6; // m
const HEAD = 0.05; // m

/** Where a wheel stands, m, in the frame of the scene; unit vectors. */
interface Footing {
  point: Vector3;
  forward: Vector3; // where it rolls when its joint turns forward
  sideways: Vector3; // along its axis
  up: Vector3;
  radius: number;
}

export class Contacts {
  readonly object = new Group();
  private readonly discs = new InstancedMesh(
    new CircleGeometry(1, 32),
    new MeshBasicMaterial({ transparent: true, opacity: 0.55, depthWrite: false }),
    MOST,
  );
  private readonly arrows = new Segments(3);
  private readonly slipColour = new Color();
  private readonly radii = new WeakMap<RobotView, Map<string, number>>();

  constructor() {
    this.discs.instanceMatrix.setUsage(DynamicDrawUsage);
    this.discs.frustumCulled = false;
    this.discs.raycast = () => {};
    this.object.add(this.discs, this.arrows.object);
    this.begin();
  }

  setPalette(palette: Palette): void {
    this.discs.material.color.set(palette.contact);
    this.slipColour.set(palette.slip);
  }

  /** Forget the sizes of a robot's wheels: a mesh has come. */
  forget(view: RobotView): void {
    this.radii.delete(view);
  }

  begin(): void {
    this.discs.count = 0;
    this.arrows.clear();
  }

  /** Draw the wheels of a robot that has its place. */
  add(view: RobotView, joints: readonly string[], state: RobotState): void {
    const values = (wheel: number): Float32Array =>
      state.wheels.subarray(WHEEL_FLOATS * wheel, WHEEL_FLOATS * (wheel + 1));
    const loads = joints.map((_, wheel) => values(wheel)[1]!).filter((load) => load > 0);
    const mean = loads.reduce((sum, load) => sum + load, 0) / Math.max(1, loads.length);
    joints.forEach((joint, wheel) => {
      const [contact, load, along, across] = values(wheel) as unknown as WheelNumbers;
      const footing = contact > 0 ? this.footingOf(view, joint) : null;
      if (footing !== null && this.discs.count < MOST) {
        this.drawDisc(footing, load / mean);
        this.drawArrow(footing, along, across);
      }
    });
  }

  commit(): void {
    this.discs.instanceMatrix.needsUpdate = true;
    this.discs.visible = this.discs.count > 0;
    this.arrows.commit();
  }

  private footingOf(view: RobotView, name: string): Footing | null {
    const joint = view.joint(name);
    const radius = this.radiusOf(view, name);
    if (joint === undefined || radius === 0) {
      return null;
    }
    const { matrixWorld } = joint;
    const sideways = joint.axis.clone().transformDirection(matrixWorld);
    const up = new Vector3().setFromMatrixColumn(view.object.matrixWorld, 2).normalize();
    up.addScaledVector(sideways, -up.dot(sideways));
    if (up.lengthSq() < 1e-6) {
      return null; // it lies on its side
    }
    up.normalize();
    const point = new Vector3().setFromMatrixPosition(matrixWorld).addScaledVector(up, -radius);
    return { point, up, sideways, forward: sideways.clone().cross(up), radius };
  }

  /** A disc whose area is the load, beside that of the other wheels. */
  private drawDisc({ point, forward, sideways, up, radius }: Footing, share: number): void {
    const size = 0.45 * radius * Math.sqrt(Math.min(share, 4));
    const place = new Matrix4().makeBasis(
      forward.clone().multiplyScalar(size),
      sideways.clone().multiplyScalar(size),
      up,
    );
    place.setPosition(point.x, point.y, point.z);
    this.discs.setMatrixAt(this.discs.count++, place);
  }

  private drawArrow({ point, forward, sideways }: Footing, along: number, across: number): void {
    const speed = Math.hypot(along, across);
    if (!(speed > SHORTEST)) {
      return;
    }
    const length = Math.min(METRES_PER_SPEED * speed, LONGEST);
    const ahead = new Vector3().addScaledVector(forward, along).addScaledVector(sideways, across);
    ahead.divideScalar(speed);
    const aside = new Vector3().addScaledVector(forward, -across).addScaledVector(sideways, along);
    aside.divideScalar(speed);
    const tip = point.clone().addScaledVector(ahead, length);
    this.arrows.add(point, tip, this.slipColour);
    const head = Math.min(HEAD, length / 2);
    for (const side of [-0.6 * head, 0.6 * head]) {
      const barb = tip.clone().addScaledVector(ahead, -head).addScaledVector(aside, side);
      this.arrows.add(tip, barb, this.slipColour);
    }
  }

  private radiusOf(view: RobotView, joint: string): number {
    const known = this.radii.get(view) ?? new Map<string, number>();
    this.radii.set(view, known);
    const radius = known.get(joint) ?? view.wheelRadius(joint);
    known.set(joint, radius);
    return radius;
  }
}
