// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Where everything is, relative to the fixed frame.
 *
 * There are two sources: TF, and in a simulation the truth. They meet in the robots: where the
 * truth is known, a robot stands where it truly is in `world`, its links as its joints are; and
 * the root of its TF tree (`odom`) is where the two agreed when the robot came, so that the drift
 * since then can be seen. Without truth, all is as TF has it.
 *
 * What is neither in the fixed frame's tree nor tied to it by a truth has no place.
 */
import { Matrix4 } from 'three';
import type { FrameTree } from './tree';

/** The frame of the truth. */
export const WORLD = 'world';
const NEAR = { distance: 1, angle: 0.35 }; // m, rad: a map of the world that is not quite where it is
const JUMP = { distance: 0.5, angle: 0.35 }; // what localisation corrects at once or in the long run

/** Whether a frame is that of a map, by its name (REP 105). */
export function isMap(frame: string): boolean {
  return frame === 'map' || frame.endsWith('/map');
}

/** A robot, as far as places go. */
export interface Body {
  base: string; // the frame whose pose the truth is
  truth: Matrix4 | null; // of the base, in `world`
  links: ReadonlyMap<string, Matrix4>; // frame of each link -> its pose in the base
}

/** A pose, and the frame it is in: the root of a TF tree, or `world`. */
interface Place {
  reference: string;
  pose: Matrix4;
}

export class Placement {
  private places = new Map<string, Place>();
  private bases = new Map<Body, Place>();
  private fixed: Place | null = null; // its pose is the inverse: from its reference to it

  /**
   * `anchors`: root of a TF tree -> its pose in world; `corrections`: … -> what localisation said then.
   */
  constructor(
    readonly anchors = new Map<string, Matrix4>(),
    private readonly corrections = new Map<string, Matrix4>(),
  ) {}

  /** Where everything was at another time, by what is known since then of odometry and truth. */
  at(tree: FrameTree, bodies: readonly Body[], fixedFrame: string): Placement {
    const other = new Placement(this.anchors, this.corrections);
    other.update(tree, bodies, fixedFrame);
    return other;
  }

  /** Forget where odometry and truth agreed; at a reset. */
  clear(): void {
    this.anchors.clear();
    this.corrections.clear();
  }

  /** … of one TF tree, by its root. */
  forget(root: string): void {
    this.anchors.delete(root);
  }

  /** Place all frames and bodies. */
  update(tree: FrameTree, bodies: readonly Body[], fixedFrame: string): void {
    this.places = new Map([[WORLD, { reference: WORLD, pose: new Matrix4() }]]);
    this.bases = new Map();
    const roots = this.placeRoots(tree, bodies);
    const links = new Map<string, Place>();
    for (const body of bodies) {
      this.placeBody(tree, body, roots, links);
    }
    for (const frame of tree.names) {
      this.placeFrame(tree, frame, roots, links);
    }
    const fixed = this.places.get(fixedFrame);
    this.fixed = fixed ? { ...fixed, pose: fixed.pose.clone().invert() } : null;
  }

  /** The pose of a frame in the fixed frame; null if the two are not connected. */
  poseOf(frame: string): Matrix4 | null {
    return this.inFixed(this.places.get(frame));
  }

  /** The pose of a frame in another one; null if the two are not connected. */
  poseIn(frame: string, target: string): Matrix4 | null {
    const [one, other] = [this.places.get(frame), this.places.get(target)];
    const areConnected = one !== undefined && one.reference === other?.reference;
    return areConnected ? other.pose.clone().invert().multiply(one.pose) : null;
  }

  /** The pose of a robot's base in the fixed frame. */
  poseOfBody(body: Body): Matrix4 | null {
    return this.inFixed(this.bases.get(body));
  }

  private inFixed(place: Place | undefined): Matrix4 | null {
    if (place === undefined || this.fixed === null) {
      return null;
    }
    if (place.reference !== this.fixed.reference) {
      return null;
    }
    return this.fixed.pose.clone().multiply(place.pose);
  }

  /** Where the roots of the TF trees are: in `world` if anything ties them to it. */
  private placeRoots(tree: FrameTree, bodies: readonly Body[]): Map<string, Place> {
    const roots = new Map<string, Place>();
    if (tree.has(WORLD)) {
      const pose = tree.inRoot(WORLD);
      if (pose !== null) {
        roots.set(tree.rootOf(WORLD), { reference: WORLD, pose: pose.invert() });
      }
    }
    for (const { base, truth } of bodies) {
      const root = tree.rootOf(base);
      if (roots.has(root) || !tree.has(base)) {
        continue;
      }
      this.forgetCorrected(tree, root, base);
      const anchor = this.anchors.get(root) ?? snapped(root, anchorOf(truth, tree.inRoot(base)));
      if (anchor !== null) {
        this.anchors.set(root, anchor);
        roots.set(root, { reference: WORLD, pose: anchor });
      }
    }
    return roots;
  }

  /**
   * Forget where a map lies once localisation has corrected itself, such as by an initial pose: what
   * the two agreed on before was wrong.
   */
  private forgetCorrected(tree: FrameTree, root: string, base: string): void {
    const correction = isMap(root) ? tree.localOf(tree.belowRoot(base)) : null;
    if (correction === null) {
      return;
    }
    const before = this.corrections.get(root);
    if (before === undefined || !isWithin(before.clone().invert().multiply(correction), JUMP)) {
      this.anchors.delete(root);
      this.corrections.set(root, correction.clone());
    }
  }

  private placeBody(
    tree: FrameTree,
    body: Body,
    roots: ReadonlyMap<string, Place>,
    links: Map<string, Place>,
  ): void {
    const root = tree.rootOf(body.base);
    const { reference, pose } = roots.get(root) ?? { reference: root, pose: new Matrix4() };
    const inRoot = tree.inRoot(body.base);
    const base: Place | null =
      body.truth !== null
        ? { reference: WORLD, pose: body.truth }
        : inRoot && { reference, pose: pose.clone().multiply(inRoot) };
    if (base === null) {
      return;
    }
    this.bases.set(body, base);
    if (!tree.has(body.base)) {
      this.places.set(body.base, base);
    }
    for (const [frame, inBase] of body.links) {
      links.set(frame, { ...base, pose: base.pose.clone().multiply(inBase) });
    }
  }

  private placeFrame(
    tree: FrameTree,
    frame: string,
    roots: ReadonlyMap<string, Place>,
    links: ReadonlyMap<string, Place>,
  ): void {
    const parent = tree.parentOf(frame);
    const root = roots.get(tree.rootOf(frame)) ?? {
      reference: tree.rootOf(frame),
      pose: new Matrix4(),
    };
    const link = links.get(frame);
    if (link !== undefined || parent === null) {
      this.places.set(frame, link ?? root);
      return;
    }
    const above = this.places.get(parent);
    const local = tree.localOf(frame);
    if (above !== undefined && local !== null) {
      const pose = above.pose.clone().multiply(local);
      this.places.set(frame, { reference: above.reference, pose });
    }
  }
}

/** Where the root of a TF tree is in `world` if truth and TF agree on the base now. */
function anchorOf(truth: Matrix4 | null, inRoot: Matrix4 | null): Matrix4 | null {
  return truth && inRoot && truth.clone().multiply(inRoot.invert());
}

/**
 * A map that lies about where `world` does is one of the world, and its robot not quite localised: the
 * two are the same. Another one, such as of SLAM, begins where its robot did.
 */
function snapped(root: string, anchor: Matrix4 | null): Matrix4 | null {
  return anchor !== null && isMap(root) && isWithin(anchor, NEAR) ? new Matrix4() : anchor;
}

function isWithin(pose: Matrix4, { distance, angle }: typeof NEAR): boolean {
  const { elements } = pose;
  const cosine = (elements[0] + elements[5] + elements[10] - 1) / 2;
  return Math.hypot(elements[12], elements[13], elements[14]) <= distance && cosine >= Math.cos(angle);
}

/** All frames that can stand still: those of TF, bases without one, and `world` where there is truth. */
export function namesOfFrames(tree: FrameTree, bodies: readonly Body[]): string[] {
  const names = new Set([...tree.names, ...bodies.map(({ base }) => base)]);
  names.delete(WORLD);
  const hasWorld = tree.has(WORLD) || hasTruth(bodies);
  return hasWorld ? [WORLD, ...names] : [...names];
}

/** The fixed frame that suits: `world` where there is truth, else the root of the first robot's TF. */
export function automaticFrame(tree: FrameTree, bodies: readonly Body[]): string {
  if (hasTruth(bodies)) {
    return WORLD;
  }
  const [first] = tree.names;
  const base = bodies[0]?.base;
  return base !== undefined ? tree.rootOf(base) : (first ?? WORLD);
}

function hasTruth(bodies: readonly Body[]): boolean {
  return bodies.some(({ truth }) => truth !== null);
}

/** Links are frames of the same name, in a namespace often behind "<namespace>/"; that, or ''. */
export function prefixOf(tree: FrameTree, robot: string, base: string): string {
  const namespace = robot.replace(/^\//, '');
  const own = namespace && `${namespace}/`;
  const isPlain = !tree.has(own + base) && tree.has(base);
  return isPlain ? '' : own;
}
