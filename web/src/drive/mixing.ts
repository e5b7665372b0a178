// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * From what hands do to a velocity of the robot: pure, so that a test can try every case.
 *
 * A demand is a share of the limits: ahead and to the left are positive (REP 103), each in -1..1.
 */

export interface Demand {
  forward: number; // -1..1, ahead
  turn: number; // -1..1, to the left
}

export interface Limits {
  linear: number; // m/s
  angular: number; // rad/s
}

export interface Velocity {
  linear: number; // m/s ahead
  angular: number; // rad/s to the left
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

/** Whether a key drives. */
export function isDriveKey(code: string): boolean {
  return KEYS.has(code);
}

/** The demand of the keys that are down. Opposite keys cancel; W and the up arrow are one. */
export function fromKeys(down: Iterable<string>): Demand {
  return mix([...down].map((code) => KEYS.get(code) ?? STILL));
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
  for (const demand of demands) {
    forward += demand.forward;
    turn += demand.turn;
  }
  return { forward: clamp(forward), turn: clamp(turn) };
}

/** What a demand means to the robot. */
export function toVelocity(demand: Demand, limits: Limits): Velocity {
  return { linear: demand.forward * limits.linear, angular: demand.turn * limits.angular };
}

function clamp(share: number): number {
  return Math.min(1, Math.max(-1, share));
}

/** Minus zero is a zero: it would be printed as "-0.00". */
function zeroed(value: number): number {
  return value === 0 ? 0 : value;
}
