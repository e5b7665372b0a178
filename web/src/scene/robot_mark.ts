// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What marks a robot on its ground: a ring of its colour, and an arrow at its front. */
import {
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
} from 'three';
import type { Box3, Matrix4 } from 'three';

const LIFT = 0.006; // m above what the robot stands on, over its trails
const RING = { plain: 0.05, chosen: 0.1 }; // shares of the radius
const ARROW = 0.26;
const GAP = 1.06; // from the robot to its ring, as a factor
const SEGMENTS = 56;

/** How a robot is marked. */
export interface MarkLook {
  colour: string;
  hasRing: boolean; // it is one of several
  hasFront: boolean; // it drives
  isChosen: boolean;
}

export class RobotMark {
  readonly object = new Group();
  private readonly material = new MeshBasicMaterial({
    depthWrite: false, transparent: true, opacity: 0.92, polygonOffset: true, polygonOffsetUnits: -40,
  });
  private readonly ring = new Mesh(new BufferGeometry(), this.material);
  /** Seen through the robot, which is often before it. */
  private readonly frontMaterial = new MeshBasicMaterial({
    depthTest: false, depthWrite: false, transparent: true, opacity: 0.85,
  });
  private readonly front = new Mesh(new BufferGeometry(), this.frontMaterial);
  private box: Box3 | null = null;
  private look: MarkLook = { colour: '#000', hasRing: false, hasFront: false, isChosen: false };

  constructor() {
    this.object.matrixAutoUpdate = false;
    this.object.add(this.ring, this.front);
    for (const mesh of [this.ring, this.front]) {
      mesh.raycast = () => {};
      mesh.renderOrder = 3; // on the ground, over its shadows
      mesh.visible = false;
    }
    this.front.renderOrder = 4;
  }

  /** `box`: the robot's extent in its base, m; null: nothing of it is drawn. */
  measure(box: Box3 | null): void {
    this.box = box;
    this.build();
  }

  setLook(look: MarkLook): void {
    this.look = look;
    this.material.color.set(look.colour);
    this.frontMaterial.color.set(look.colour);
    this.build();
  }

  /** Put it where the robot's base is; null: nowhere. */
  place(pose: Matrix4 | null): void {
    this.object.visible = pose !== null;
    if (pose !== null) {
      this.object.matrix.copy(pose);
      this.object.matrixWorldNeedsUpdate = true;
    }
  }

  dispose(): void {
    this.object.removeFromParent();
    this.ring.geometry.dispose();
    this.front.geometry.dispose();
    this.material.dispose();
    this.frontMaterial.dispose();
  }

  private build(): void {
    const { box, look } = this;
    this.ring.visible = look.hasRing && box !== null;
    this.front.visible = look.hasFront && box !== null;
    this.ring.geometry.dispose();
    this.front.geometry.dispose();
    if (box === null) {
      return;
    }
    const radius = (GAP * Math.hypot(box.max.x - box.min.x, box.max.y - box.min.y)) / 2;
    const [x, y] = [(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2];
    const width = radius * (look.isChosen ? RING.chosen : RING.plain);
    this.ring.geometry = new RingGeometry(radius, radius + width, SEGMENTS);
    this.front.geometry = arrow(radius * ARROW);
    const z = box.min.z + LIFT;
    this.ring.position.set(x, y, z);
    const ahead = look.hasRing ? x + radius + width : box.max.x + 0.3 * ARROW * radius;
    this.front.position.set(ahead, y, z);
  }
}

/** A flat arrowhead ahead of the origin, m. */
function arrow(size: number): BufferGeometry {
  const points = [0, -size, 0, 1.3 * size, 0, 0, 0.35 * size, 0, 0, 0, size, 0];
  const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  return geometry;
}
