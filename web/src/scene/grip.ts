// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A hand on a robot: a drag with Ctrl (or ⌘) pulls the link under the pointer, one with Shift puts the
 * robot elsewhere.
 */
import { Color, Plane, Quaternion, Vector3 } from 'three';
import type { Camera, Matrix4, Object3D, Ray } from 'three';
import type { Vector } from '../protocol';
import type { Hit } from './picking';
import { Segments } from './segments';
import type { Palette } from './theme';

/** What a hand does; all in `world`. */
export interface Hands {
  /** N at the origin of the link, N m; both 0: let go. */
  push(robot: string, link: string, force: Vector, torque: Vector): void;
  /** Put the robot there, upright: its base, m, and yaw, rad. Settles when it is there. */
  place(robot: string, position: Vector, yaw: number): Promise<void>;
}

/** What a hand has to know of the scene; the poses are in its fixed frame. */
export interface Grasp {
  hit(clientX: number, clientY: number): Hit | null;
  ray(clientX: number, clientY: number): Ray;
  link(robot: string, link: string): Object3D | null;
  base(robot: string): Matrix4 | null;
  world(): Matrix4 | null;
  mass(robot: string): number; // kg
  changed(): void;
}

const PERIOD = 33; // ms between two words to the node
const STIFFNESS = 30; // N/m for each kg: a robot follows within half a second
const DAMPING = 2 * Math.sqrt(STIFFNESS); // N s/m for each kg: without swinging
const STRONGEST = 12; // N for each kg: more than friction, and a bit more than weight
const PROMPT = 40; // ms between two drawn places, to which spring and damping are made
const STANDS_AFTER = 250; // ms without another pose
const UPRIGHT = 0.9; // of the base's z axis; less: it lies on its side
const WIDTH = 3; // CSS px

/** How a point moves that is looked at now and then. */
export interface Motion {
  at: number; // ms, when it was first seen there
  point: Vector3;
  velocity: Vector3; // m/s
  interval: number; // ms between two places
}

/**
 * How it moves, now that it is seen at `point`.
 *
 * Poses change when a state is drawn, seldom on a slow machine: between two looks it mostly has not
 * moved, and then a bit more. So its speed is that between two places, and holds until the next one.
 */
export function follow(last: Motion | null, point: Vector3, now: number): Motion {
  if (last === null) {
    return { at: now, point, velocity: new Vector3(), interval: PROMPT };
  }
  const since = now - last.at;
  if (point.equals(last.point)) {
    return since < STANDS_AFTER ? last : { ...last, velocity: new Vector3() };
  }
  const velocity = point.clone().sub(last.point).divideScalar(Math.max(1, since) / 1000);
  const interval = last.interval + 0.3 * (Math.min(since, STANDS_AFTER) - last.interval);
  return { at: now, point, velocity, interval };
}

/**
 * The force of a spring with damping on a point that moves, to where the pointer wants it, N.
 *
 * What is seen late must be pulled softly, or it swings more and more: stiffness goes with the square
 * of how often places are seen, damping with it.
 */
export function pull(mass: number, { point, velocity, interval }: Motion, to: Vector3): Vector3 {
  const softer = Math.min(1, PROMPT / interval);
  return to
    .clone()
    .sub(point)
    .multiplyScalar(STIFFNESS * softer ** 2 * mass)
    .addScaledVector(velocity, -DAMPING * softer * mass)
    .clampLength(0, STRONGEST * mass);
}

/**
 * The torque of a force that pulls at the end of an arm, N m.
 *
 * A body turns more easily than it moves: seen late, it were spun up instead of turned.
 */
export function twist(arm: Vector3, force: Vector3, { interval }: Motion): Vector3 {
  return arm
    .clone()
    .cross(force)
    .multiplyScalar(Math.min(1, PROMPT / interval) ** 4);
}

interface Held {
  kind: 'push' | 'place';
  robot: string;
  link: string;
  pointer: number;
  grabbed: Vector3; // in the link
  plane: Plane; // in which the pointer moves it
  target: Vector3;
  start: Vector3; // where it was grabbed
  base: Matrix4; // of the robot then
  motion: Motion | null; // of where it was grabbed
}

export class Grip {
  /** The line from where it was grabbed to where it is pulled. */
  private readonly line = new Segments(WIDTH);
  private readonly colour = new Color();
  private held: Held | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;
  private isPlacing = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly camera: Camera,
    private readonly grasp: Grasp,
    private readonly hands: () => Hands | null,
  ) {
    // Before the camera's own listeners.
    canvas.addEventListener('pointerdown', (event) => this.onDown(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.onMove(event), { capture: true });
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(name, (event) => this.onUp(event), { capture: true });
    }
  }

  get object(): Object3D {
    return this.line.object;
  }

  setPalette({ highlight }: Palette): void {
    this.colour.set(highlight);
  }

  /** Draw where it pulls; called with each frame. */
  draw(): void {
    this.line.clear();
    const point = this.held === null ? null : this.point(this.held);
    if (this.held !== null && point !== null) {
      this.line.add(point, this.held.target, this.colour);
    }
    this.line.commit();
  }

  private onDown(event: PointerEvent): void {
    const kind = event.ctrlKey || event.metaKey ? 'push' : event.shiftKey ? 'place' : null;
    if (kind === null || event.button !== 0 || !event.isPrimary || this.hands() === null) {
      return;
    }
    const hit = this.grasp.hit(event.clientX, event.clientY);
    const base = hit === null ? null : this.grasp.base(hit.robot);
    const link = hit?.link == null ? null : this.grasp.link(hit.robot, hit.link);
    if (hit?.link == null || base === null || link === null) {
      return;
    }
    event.stopImmediatePropagation();
    event.preventDefault();
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    const normal = this.camera.getWorldDirection(new Vector3()).negate();
    const { robot, point } = hit;
    this.held = {
      kind,
      robot,
      link: hit.link,
      pointer: event.pointerId,
      grabbed: link.worldToLocal(point.clone()),
      plane: new Plane().setFromNormalAndCoplanarPoint(
        kind === 'push' ? normal : new Vector3(0, 0, 1),
        point,
      ),
      target: point.clone(),
      start: point.clone(),
      base: base.clone(),
      motion: null,
    };
    this.timer = setInterval(() => this.act(), PERIOD);
    this.grasp.changed();
  }

  private onMove(event: PointerEvent): void {
    if (this.held?.pointer !== event.pointerId) {
      return;
    }
    event.stopImmediatePropagation();
    const ray = this.grasp.ray(event.clientX, event.clientY);
    ray.intersectPlane(this.held.plane, this.held.target);
    this.grasp.changed();
  }

  private onUp(event: PointerEvent): void {
    const { held } = this;
    if (held?.pointer !== event.pointerId) {
      return;
    }
    event.stopImmediatePropagation();
    clearInterval(this.timer);
    this.held = null;
    if (held.kind === 'push') {
      this.hands()?.push(held.robot, held.link, [0, 0, 0], [0, 0, 0]);
    } else {
      void this.place(held);
    }
    this.grasp.changed();
  }

  /** Where the grabbed point is now, in the fixed frame. */
  private point(held: Held): Vector3 | null {
    const link = this.grasp.link(held.robot, held.link);
    return link === null ? null : link.localToWorld(held.grabbed.clone());
  }

  private act(): void {
    const { held } = this;
    if (held?.kind === 'push') {
      this.push(held);
    } else if (held !== null && !this.isPlacing) {
      void this.place(held);
    }
    this.grasp.changed();
  }

  private push(held: Held): void {
    const [point, world] = [this.point(held), this.grasp.world()];
    const link = this.grasp.link(held.robot, held.link);
    if (point === null || world === null || link === null) {
      return;
    }
    held.motion = follow(held.motion, point, performance.now());
    const force = pull(this.grasp.mass(held.robot), held.motion, held.target);
    const arm = point.clone().sub(new Vector3().setFromMatrixPosition(link.matrixWorld));
    const torque = twist(arm, force, held.motion);
    const toWorld = new Quaternion().setFromRotationMatrix(world).invert();
    for (const each of [force, torque]) {
      each.applyQuaternion(toWorld);
    }
    this.hands()?.push(held.robot, held.link, force.toArray(), torque.toArray());
  }

  private async place(held: Held): Promise<void> {
    const [hands, world] = [this.hands(), this.grasp.world()];
    const shift = held.target.clone().sub(held.start);
    if (hands === null || world === null || shift.lengthSq() < 1e-8) {
      return;
    }
    const pose = held.base.clone().setPosition(
      new Vector3().setFromMatrixPosition(held.base).add(shift),
    );
    pose.premultiply(world.clone().invert());
    const { position, yaw } = upright(pose);
    this.isPlacing = true;
    try {
      await hands.place(held.robot, position, yaw);
    } finally {
      this.isPlacing = false;
    }
  }
}

/** A pose without roll and pitch, its yaw kept; a robot that lay on its side stands above the ground. */
export function upright(pose: Matrix4): { position: Vector; yaw: number } {
  const { elements } = pose;
  const [x, y, z] = new Vector3().setFromMatrixPosition(pose).toArray();
  const yaw = Math.atan2(elements[1], elements[0]);
  return { position: [x, y, elements[10] < UPRIGHT ? Math.max(z, 0) + 0.02 : z], yaw };
}
