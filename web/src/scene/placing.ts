// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A place on the ground: pointed at in the picture, and marked there. */
import { Box3, Matrix4, Vector3 } from 'three';
import type { Vector } from '../protocol';
import { RobotMark } from './robot_mark';

/** A place for a robot, in `world`: m, rad. */
export interface MarkedPlace {
  x: number;
  y: number;
  yaw: number;
  radius: number;
  isFree: boolean;
}

const COLOURS = { free: '#1a9a50', taken: '#d6362c' };

export class Placing {
  readonly mark = new RobotMark();
  /** Where `world` is in the scene; null: nowhere. */
  world: Matrix4 | null = null;
  /** A place was clicked. */
  onChosen: () => void = () => {};
  private place: MarkedPlace | null = null;
  private wanted: ((clientX: number, clientY: number) => void) | null = null;

  /** `groundAt`: the point of the ground, m in `world`, under a point of the page; null: none. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly groundAt: (clientX: number, clientY: number) => Vector | null,
  ) {
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons === 0) {
        this.point(event.clientX, event.clientY);
      }
    });
  }

  /** Whether a place is being pointed at. */
  get isActive(): boolean {
    return this.wanted !== null;
  }

  /** Give every place that the pointer is over, until null is asked. */
  ask(wanted: ((x: number, y: number) => void) | null): void {
    this.askAt(
      wanted &&
        ((clientX, clientY) => {
          const point = this.groundAt(clientX, clientY);
          if (point !== null) {
            wanted(point[0], point[1]);
          }
        }),
    );
  }

  /** … and every point of the page. */
  askAt(wanted: ((clientX: number, clientY: number) => void) | null): void {
    this.wanted = wanted;
    this.canvas.classList.toggle('placing', wanted !== null);
  }

  /** A point of the page was pointed at, or clicked. */
  point(clientX: number, clientY: number): void {
    this.wanted?.(clientX, clientY);
  }

  /** Mark a place; null: none. */
  show(place: MarkedPlace | null): void {
    if (place !== null && JSON.stringify(place) !== JSON.stringify(this.place)) {
      const half = place.radius / Math.SQRT2;
      this.mark.setLook({
        colour: place.isFree ? COLOURS.free : COLOURS.taken,
        hasRing: true,
        hasFront: true,
        isChosen: true,
      });
      this.mark.measure(new Box3(new Vector3(-half, -half, 0), new Vector3(half, half, 0)));
    }
    this.place = place;
    this.settle();
  }

  /** Put the mark where the place is now in the scene. */
  settle(): void {
    const { place, world } = this;
    const local = place && new Matrix4().makeRotationZ(place.yaw).setPosition(place.x, place.y, 0);
    this.mark.place(local && world && local.premultiply(world));
  }
}
