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

  /** `anchors`: root of a TF tree -> its pose in world. */
  constructor(private readonly anchors = new Map<string, Matrix4>()) {}

  /** Where everything was at another time, by what is known since then of odometry and truth. */
  at(tree: FrameTree, bodies: readonly Body[], fixedFrame: string): Placement {
    const other = new Placement(this.anchors);
    other.update(tree, bodies, fixedFrame);
    return other;
  }

  /** Forget where odometry and truth agreed; at a reset. */
  clear(): void {
    this.anchors.clear();
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
      const anchor = this.anchors.get(root) ?? anchorOf(truth, tree.inRoot(base));
      if (anchor !== null) {
        this.anchors.set(root, anchor);
        roots.set(root, { reference: WORLD, pose: anchor });
      }
    }
    return roots;
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
