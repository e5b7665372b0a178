// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Clicks, as distinct from drags: which link of which robot is under them. */
import { Raycaster, Vector2 } from 'three';
import type { Camera, Object3D, Ray, Vector3 } from 'three';
import type { Placing } from './placing';
import type { RobotView } from './robot';

const STILL = 5; // CSS pixels; a pointer that moves further drags
const SHORT = 500; // ms

export interface Picked {
  robot: string;
  link: string | null;
}

/** What is under a point of the page. */
export interface Hit extends Picked {
  point: Vector3; // in the frame of the scene
}

export class Picking {
  private readonly caster = new Raycaster();
  private down: { x: number; y: number; time: number; id: number } | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly camera: Camera,
    private readonly views: () => Iterable<[string, RobotView]>,
    private readonly picked: (what: Picked | null) => void,
    private readonly placing: Placing,
  ) {
    canvas.addEventListener('pointerdown', (event) => this.onDown(event));
    canvas.addEventListener('pointerup', (event) => this.onUp(event));
  }

  private onDown(event: PointerEvent): void {
    const { clientX: x, clientY: y, timeStamp: time, pointerId: id } = event;
    this.down = event.button === 0 && event.isPrimary ? { x, y, time, id } : null;
  }

  private onUp({ clientX, clientY, timeStamp, pointerId }: PointerEvent): void {
    const { down } = this;
    this.down = null;
    if (down?.id !== pointerId || timeStamp - down.time > SHORT) {
      return;
    }
    if (Math.hypot(clientX - down.x, clientY - down.y) <= STILL) {
      if (this.placing.isActive) {
        this.placing.point(clientX, clientY);
        this.placing.onChosen();
      } else {
        this.picked(this.at(clientX, clientY));
      }
    }
  }

  /** The ray from the eye through a point of the page. */
  rayAt(clientX: number, clientY: number): Ray {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const x = ((clientX - left) / width) * 2 - 1;
    const y = 1 - ((clientY - top) / height) * 2;
    this.camera.updateMatrixWorld(); // it may have been turned since the last frame
    this.caster.setFromCamera(new Vector2(x, y), this.camera);
    return this.caster.ray;
  }

  /** Where the nearest of some things, or a link, is under a point of the page; null: nowhere. */
  surfaceAt(clientX: number, clientY: number, things: readonly Object3D[]): Vector3 | null {
    const link = this.at(clientX, clientY);
    const ray = this.rayAt(clientX, clientY);
    this.caster.far = Infinity;
    const points = this.caster.intersectObjects([...things], false).map(({ point }) => point);
    const all = link === null ? points : [...points, link.point];
    const far = (point: Vector3): number => point.distanceToSquared(ray.origin);
    return all.sort((a, b) => far(a) - far(b))[0] ?? null;
  }

  /** The nearest link under a point of the page. */
  at(clientX: number, clientY: number): Hit | null {
    this.rayAt(clientX, clientY);
    let nearest = Infinity;
    let found: Hit | null = null;
    for (const [robot, view] of this.views()) {
      const [hit] = view.object.visible ? this.caster.intersectObjects(view.visuals(), false) : [];
      if (hit !== undefined && hit.distance < nearest) {
        nearest = hit.distance;
        found = { robot, link: view.linkOf(hit.object), point: hit.point };
      }
    }
    return found;
  }
}
