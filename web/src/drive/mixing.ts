// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * From what hands do to a velocity of the robot: pure, so that a test can try every case.
 *
 * A demand is a share of the limits: ahead and to the left are positive (REP 103), each in -1..1.
 * Sideways go only robots whose wheels can; what does not want to leaves `left` out.
 */

export interface Demand {
  forward: number; // -1..1, ahead
  turn: number; // -1..1, to the left
  left?: number; // -1..1, sideways to the left; none: 0
}

export interface Limits {
  linear: number; // m/s
  angular: number; // rad/s
}

export interface Velocity {
  linear: number; // m/s ahead
  angular: number; // rad/s to the left
  sideways?: number; // m/s to the left; none: 0
}

export const STILL: Demand = { forward: 0, turn: 0 };

/** Physical keys, by `event.code`: where W is on a US keyboard, whatever is printed on it. */
const KEYS: ReadonlyMap<string, Demand> = new Map([
  ['KeyW', { forward: 1, turn: 0 }],
  ['ArrowUp', { forward: 1, turn: 0 }],
  ['KeyS', { forward: -1, turn: 0 }],
  ['ArrowDown', { forward: -1, turn: 0 }],
  ['KeyA', { forward: 0, turn: 1 }],
  ['ArrowLeft', { forward: 0, turn: 1 }],
  ['KeyD', { forward: 0, turn: -1 }],
  ['ArrowRight', { forward: 0, turn: -1 }],
]);

/** Of robots that can go sideways. */
const SIDEWAYS_KEYS: ReadonlyMap<string, Demand> = new Map([
  ['KeyQ', { forward: 0, turn: 0, left: 1 }],
  ['KeyE', { forward: 0, turn: 0, left: -1 }],
]);

/** Whether a key drives, a robot that `goesSideways` or not. */
export function isDriveKey(code: string, goesSideways: boolean): boolean {
  return KEYS.has(code) || (goesSideways && SIDEWAYS_KEYS.has(code));
}

/** The demand of the keys that are down. Opposite keys cancel; W and the up arrow are one. */
export function fromKeys(down: Iterable<string>): Demand {
  return mix([...down].map((code) => KEYS.get(code) ?? SIDEWAYS_KEYS.get(code) ?? STILL));
}

/**
 * The demand of a stick pushed `right` and `down` (screen axes), as shares of its throw.
 *
 * Within `dead` of the centre the stick rests; from there the demand grows from 0, so that there
 * is no step at the edge. Beyond the throw only the direction counts.
 */
export function fromStick(right: number, down: number, dead: number): Demand {
  const length = Math.hypot(right, down);
  if (!Number.isFinite(length) || length <= dead) {
    return STILL;
  }
  const share = (Math.min(length, 1) - dead) / (1 - dead) / length;
  return { forward: zeroed(-down * share), turn: zeroed(-right * share) };
}

/** Several hands at once: their sum, within the limits. */
export function mix(demands: readonly Demand[]): Demand {
  let forward = 0;
  let turn = 0;
  let left = 0;
  for (const demand of demands) {
    forward += demand.forward;
    turn += demand.turn;
    left += demand.left ?? 0;
  }
  const sum = { forward: clamp(forward), turn: clamp(turn) };
  return left === 0 ? sum : { ...sum, left: clamp(left) };
}

/** What a demand means to the robot. */
export function toVelocity(demand: Demand, limits: Limits): Velocity {
  const { forward, turn, left = 0 } = demand;
  const velocity = { linear: forward * limits.linear, angular: turn * limits.angular };
  return left === 0 ? velocity : { ...velocity, sideways: left * limits.linear };
}

function clamp(share: number): number {
  return Math.min(1, Math.max(-1, share));
}

/** Minus zero is a zero: it would be printed as "-0.00". */
function zeroed(value: number): number {
  return value === 0 ? 0 : value;
}
