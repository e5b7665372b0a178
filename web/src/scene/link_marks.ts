// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * What the chosen link is to physics, seen through everything: its inertia as a solid ellipsoid, its
 * centre of mass, the axis of its joint, and how far that goes.
 */
import {
  BufferGeometry,
  DoubleSide,
  EllipseCurve,
  Euler,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Object3D,
  Quaternion,
  RingGeometry,
  SphereGeometry,
  Vector3,
} from 'three';
import type { JointFacts, LinkFacts } from '../links';
import type { RobotView } from './robot';
import type { Palette } from './theme';

const ELLIPSOID = { across: 32, along: 20, opacity: 0.3 };
const CENTRE = 0.06; // of the axis' length, the radius of the centre of mass
const ARC = { inner: 0.55, outer: 0.8, segments: 48, opacity: 0.35 }; // of the axis' length
const THIN = 1e-3; // m, of an ellipsoid that is flat

export class LinkMarks {
  readonly object = new Group();
  private readonly body = new Group(); // in the link
  private readonly range = new Group(); // in the joint, as it is at 0
  private readonly solid = new MeshBasicMaterial({
    transparent: true, opacity: ELLIPSOID.opacity, depthWrite: false,
  });
  private readonly sector = new MeshBasicMaterial({
    transparent: true, opacity: ARC.opacity, depthWrite: false, side: DoubleSide,
  });
  private readonly point = new MeshBasicMaterial();
  private readonly lines = new LineBasicMaterial();
  private shown: { view: RobotView; facts: LinkFacts } | null = null;

  constructor() {
    this.body.matrixAutoUpdate = this.range.matrixAutoUpdate = false;
    this.object.add(this.body, this.range);
    this.object.visible = false;
  }

  setPalette(palette: Palette): void {
    this.solid.color.set(palette.highlight);
    this.sector.color.set(palette.labelFixed);
    this.lines.color.set(palette.labelFixed);
    this.point.color.set(palette.labelFixed);
  }

  /** Mark a link of a robot, by axes of `length` m; null: none. */
  show(view: RobotView | null, facts: LinkFacts | null, length: number): void {
    this.clear();
    this.shown = view !== null && facts !== null ? { view, facts } : null;
    if (facts !== null && view !== null) {
      this.addInertia(facts, length);
      if (facts.joint !== null && facts.joint.kind !== 'fixed') {
        this.addJoint(facts.joint, length);
      }
    }
    this.place();
  }

  /** Put the marks where the link is now. */
  place(): void {
    const link = this.shown?.view.object.links[this.shown.facts.name];
    this.object.visible = link !== undefined && this.shown?.view.object.visible === true;
    if (this.shown === null || link === undefined) {
      return;
    }
    this.body.matrix.copy(link.matrixWorld);
    this.range.matrix.copy(link.matrixWorld);
    const { joint } = this.shown.facts;
    if (joint !== null) {
      const position = this.shown.view.joint(joint.name)?.angle ?? 0;
      const axis = new Vector3(...joint.axis).normalize();
      const back = joint.kind === 'prismatic'
        ? new Matrix4().makeTranslation(axis.multiplyScalar(-position))
        : new Matrix4().makeRotationAxis(axis, -position);
      this.range.matrix.multiply(back);
    }
    this.object.updateMatrixWorld(true);
  }

  private clear(): void {
    for (const group of [this.body, this.range]) {
      group.children.forEach(disposeGeometry);
      group.clear();
    }
  }

  private addInertia({ mass, centre, inertia }: LinkFacts, length: number): void {
    if (mass === null) {
      return;
    }
    const place = new Group();
    place.position.set(...centre.xyz);
    place.setRotationFromEuler(new Euler(...centre.rpy, 'ZYX'));
    place.add(new Mesh(new SphereGeometry(CENTRE * length, 16, 12), this.point));
    if (inertia?.ellipsoid) {
      const [x, y, z] = inertia.ellipsoid.map((half) => Math.max(half, THIN)) as [number, number, number];
      const [first, second] = inertia.axes.map((axis) => new Vector3(...axis)) as [Vector3, Vector3, Vector3];
      const third = first.clone().cross(second); // right-handed, whatever signs were found
      const turn = new Matrix4().makeBasis(first, second, third);
      const ellipsoid = new Mesh(new SphereGeometry(1, ELLIPSOID.across, ELLIPSOID.along), this.solid);
      ellipsoid.quaternion.copy(new Quaternion().setFromRotationMatrix(turn));
      ellipsoid.scale.set(x, y, z);
      ellipsoid.add(new LineSegments(greatCircles(), this.lines));
      place.add(ellipsoid);
    }
    this.body.add(place);
  }

  private addJoint({ kind, axis, lower, upper }: JointFacts, length: number): void {
    const along = new Vector3(...axis).normalize();
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), along);
    const line = new LineSegments(arrow(length), this.lines);
    line.quaternion.copy(turn);
    this.body.add(line);
    const isBounded = lower !== null && upper !== null;
    if (kind === 'prismatic' && isBounded) {
      const way = new LineSegments(stroke(lower, upper, 0.15 * length), this.lines);
      way.quaternion.copy(turn);
      this.range.add(way);
    } else if (kind !== 'prismatic') {
      const [from, to] = isBounded ? [lower, Math.min(upper, lower + 2 * Math.PI)] : [0, 2 * Math.PI];
      const sector = new Mesh(
        new RingGeometry(
          ARC.inner * length, ARC.outer * length, ARC.segments, 1, from, Math.max(to - from, 1e-3),
        ),
        this.sector,
      );
      sector.quaternion.copy(turn);
      this.range.add(sector);
      const hand = new LineSegments(points([[0, 0, 0], [ARC.outer * length, 0, 0]]), this.lines);
      hand.quaternion.copy(turn);
      this.body.add(hand); // where the joint is now
    }
  }
}

function disposeGeometry(object: Object3D): void {
  object.traverse((each) => {
    if (each instanceof Mesh || each instanceof LineSegments) {
      (each.geometry as BufferGeometry).dispose();
    }
  });
}

function points(corners: readonly (readonly [number, number, number])[]): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(corners.flat(), 3));
}

/** An arrow along z, through the origin. */
function arrow(length: number): BufferGeometry {
  const [tip, side] = [1.3 * length, 0.12 * length];
  return points([
    [0, 0, -0.5 * length], [0, 0, tip],
    [0, 0, tip], [side, 0, tip - 2 * side], [0, 0, tip], [-side, 0, tip - 2 * side],
    [0, 0, tip], [0, side, tip - 2 * side], [0, 0, tip], [0, -side, tip - 2 * side],
  ]);
}

/** From one height to another along z, with a bar at each end. */
function stroke(from: number, to: number, bar: number): BufferGeometry {
  return points([
    [0, 0, from], [0, 0, to],
    [-bar, 0, from], [bar, 0, from], [-bar, 0, to], [bar, 0, to],
  ]);
}

/** Three circles of radius 1 about the origin. */
function greatCircles(): BufferGeometry {
  const circle = new EllipseCurve(0, 0, 1, 1).getPoints(64);
  const pairs = circle.slice(1).flatMap((point, at) => [circle[at] ?? point, point]);
  return points([
    ...pairs.map(({ x, y }) => [x, y, 0] as const),
    ...pairs.map(({ x, y }) => [x, 0, y] as const),
    ...pairs.map(({ x, y }) => [0, x, y] as const),
  ]);
}
