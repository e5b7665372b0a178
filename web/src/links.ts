// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What a URDF says of one link: its inertia, its collision shapes, and the joint that it hangs on. */
import type { Vector } from './protocol';

export interface LinkFacts {
  name: string;
  mass: number | null; // kg
  /** Centre of mass in the link, and its axes: m, roll pitch yaw in rad. */
  centre: { xyz: Vector; rpy: Vector };
  inertia: Inertia | null;
  collisions: string[]; // "box 0.5 × 0.3 × 0.1 m"
  joint: JointFacts | null; // null: of the root
}

/** About the centre of mass, kg m². */
export interface Inertia {
  /** ixx, iyy, izz, ixy, ixz, iyz in the axes of {@link LinkFacts.centre}. */
  tensor: [number, number, number, number, number, number];
  principal: Vector;
  /** Unit vectors of the principal axes, in the same axes. */
  axes: [Vector, Vector, Vector];
  /** Half of the axes of a solid ellipsoid of the same mass and inertia, m; null: there is none. */
  ellipsoid: Vector | null;
}

export interface JointFacts {
  name: string;
  kind: string;
  parent: string;
  axis: Vector;
  lower: number | null; // rad or m; null: no limit
  upper: number | null;
  velocity: number | null; // rad/s or m/s
  effort: number | null; // N m or N
}

/** What a URDF says of a link; null: it has no such link. */
export function linkFacts(urdf: string, name: string): LinkFacts | null {
  const robot = new DOMParser().parseFromString(urdf, 'text/xml').documentElement;
  const link = childrenOf(robot, 'link').find((each) => each.getAttribute('name') === name);
  if (link === undefined) {
    return null;
  }
  const inertial = childrenOf(link, 'inertial')[0];
  const mass = number(inertial && childrenOf(inertial, 'mass')[0], 'value');
  return {
    name,
    mass,
    centre: originOf(inertial),
    inertia: inertiaOf(inertial && childrenOf(inertial, 'inertia')[0], mass),
    collisions: childrenOf(link, 'collision').map(shapeOf),
    joint: jointOf(robot, name),
  };
}

function jointOf(robot: Element, link: string): JointFacts | null {
  const joint = childrenOf(robot, 'joint').find(
    (each) => childrenOf(each, 'child')[0]?.getAttribute('link') === link,
  );
  if (joint === undefined) {
    return null;
  }
  const kind = joint.getAttribute('type') ?? '';
  const limit = childrenOf(joint, 'limit')[0];
  const isBounded = kind === 'revolute' || kind === 'prismatic';
  return {
    name: joint.getAttribute('name') ?? '',
    kind,
    parent: childrenOf(joint, 'parent')[0]?.getAttribute('link') ?? '',
    axis: vector(childrenOf(joint, 'axis')[0]?.getAttribute('xyz'), [1, 0, 0]),
    lower: isBounded ? (number(limit, 'lower') ?? 0) : null,
    upper: isBounded ? (number(limit, 'upper') ?? 0) : null,
    velocity: number(limit, 'velocity'),
    effort: number(limit, 'effort'),
  };
}

function inertiaOf(element: Element | undefined, mass: number | null): Inertia | null {
  if (element === undefined) {
    return null;
  }
  const entry = (name: string): number => number(element, name) ?? 0;
  const tensor: Inertia['tensor'] = [
    entry('ixx'), entry('iyy'), entry('izz'), entry('ixy'), entry('ixz'), entry('iyz'),
  ];
  const { values, vectors } = principalAxes(tensor);
  return { tensor, principal: values, axes: vectors, ellipsoid: ellipsoidOf(values, mass) };
}

/**
 * Half of the axes of a solid ellipsoid by its moments: I_x = m (b² + c²) / 5, and so on. Null: no
 * mass is spread so that it has these moments.
 */
function ellipsoidOf([x, y, z]: Vector, mass: number | null): Vector | null {
  if (mass === null || mass <= 0) {
    return null;
  }
  const squares = [y + z - x, x + z - y, x + y - z].map((sum) => (2.5 * sum) / mass);
  const tolerance = -1e-9 * Math.max(...squares.map(Math.abs), 0);
  if (squares.some((square) => square < tolerance) || squares.every((square) => square === 0)) {
    return null;
  }
  return squares.map((square) => Math.sqrt(Math.max(0, square))) as Vector;
}

/** Eigenvalues and unit eigenvectors of a symmetric matrix, by Jacobi's rotations. */
export function principalAxes(
  [xx, yy, zz, xy, xz, yz]: Inertia['tensor'],
): { values: Vector; vectors: [Vector, Vector, Vector] } {
  const a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const at = (m: number[][], i: number, j: number): number => m[i]?.[j] ?? 0;
  const put = (m: number[][], i: number, j: number, value: number): void => {
    (m[i] as number[])[j] = value;
  };
  for (let sweep = 0; sweep < SWEEPS; sweep += 1) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]] as const) {
      if (at(a, p, q) === 0) {
        continue;
      }
      const angle = 0.5 * Math.atan2(2 * at(a, p, q), at(a, q, q) - at(a, p, p));
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let k = 0; k < 3; k += 1) {
        const [kp, kq] = [at(a, k, p), at(a, k, q)];
        put(a, k, p, c * kp - s * kq);
        put(a, k, q, s * kp + c * kq);
      }
      for (let k = 0; k < 3; k += 1) {
        const [pk, qk] = [at(a, p, k), at(a, q, k)];
        put(a, p, k, c * pk - s * qk);
        put(a, q, k, s * pk + c * qk);
        const [vp, vq] = [at(v, k, p), at(v, k, q)];
        put(v, k, p, c * vp - s * vq);
        put(v, k, q, s * vp + c * vq);
      }
    }
  }
  const column = (index: number): Vector => [at(v, 0, index), at(v, 1, index), at(v, 2, index)];
  return {
    values: [at(a, 0, 0), at(a, 1, 1), at(a, 2, 2)],
    vectors: [column(0), column(1), column(2)],
  };
}

const SWEEPS = 12; // each squares what is left beside the diagonal

/** A shape in words, with its size in m. */
function shapeOf(collision: Element): string {
  const shape = childrenOf(collision, 'geometry')[0]?.firstElementChild ?? null;
  const sizes = (names: readonly string[]): string =>
    names.map((name) => `${name} ${shape?.getAttribute(name) ?? '?'} m`).join(', ');
  switch (shape?.localName) {
    case 'box':
      return `box ${(shape.getAttribute('size') ?? '?').trim().split(/\s+/).join(' × ')} m`;
    case 'sphere':
      return `sphere, ${sizes(['radius'])}`;
    case 'cylinder':
    case 'capsule':
      return `${shape.localName}, ${sizes(['radius', 'length'])}`;
    case 'mesh':
      return `mesh ${(shape.getAttribute('filename') ?? '').split('/').at(-1) ?? ''}`;
    default:
      return shape?.localName ?? 'nothing';
  }
}

function originOf(element: Element | undefined): { xyz: Vector; rpy: Vector } {
  const origin = element && childrenOf(element, 'origin')[0];
  return {
    xyz: vector(origin?.getAttribute('xyz'), [0, 0, 0]),
    rpy: vector(origin?.getAttribute('rpy'), [0, 0, 0]),
  };
}

function childrenOf(element: Element, name: string): Element[] {
  return [...element.children].filter(({ localName }) => localName === name);
}

function number(element: Element | undefined, name: string): number | null {
  const text = element?.getAttribute(name) ?? null;
  const value = text === null || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

function vector(text: string | null | undefined, otherwise: Vector): Vector {
  const [x = NaN, y = NaN, z = NaN] = (text ?? '').trim().split(/\s+/).map(Number);
  return [x, y, z].every(Number.isFinite) ? [x, y, z] : otherwise;
}
