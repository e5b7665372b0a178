// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A pose in the plane by one gesture, as in RViz: pressed where it is to be, dragged to where it is to
 * look, given when let go. A click without a drag gives no direction of its own.
 */

export interface Point {
  x: number; // m
  y: number;
}

export interface Place extends Point {
  yaw: number; // rad
}

const STILL = 8; // CSS px; a pointer that moves less has not been dragged

interface Pressed {
  pointer: number;
  clientX: number;
  clientY: number;
  at: Point;
  yaw: number | null; // null: it was not dragged yet
}

export class PoseGesture {
  private pressed: Pressed | null = null;

  /** `yawAt`: where to look in a place that was only clicked, rad. */
  constructor(private readonly yawAt: (at: Point) => number) {}

  get isHeld(): boolean {
    return this.pressed !== null;
  }

  /** The pose as it would be given now; null: nothing is held. */
  get place(): Place | null {
    const { pressed } = this;
    return pressed && { ...pressed.at, yaw: pressed.yaw ?? this.yawAt(pressed.at) };
  }

  /** `at`: the point of the ground there; null: there is none. Returns whether it is held now. */
  press(pointer: number, clientX: number, clientY: number, at: Point | null): boolean {
    this.pressed = at && { pointer, clientX, clientY, at, yaw: null };
    return at !== null;
  }

  /** Returns whether it was this pointer that is held. Above the horizon the direction stays. */
  move(pointer: number, clientX: number, clientY: number, to: Point | null): boolean {
    const { pressed } = this;
    if (pressed?.pointer !== pointer) {
      return false;
    }
    const far = Math.hypot(clientX - pressed.clientX, clientY - pressed.clientY);
    if (to !== null && (far >= STILL || pressed.yaw !== null)) {
      pressed.yaw = Math.atan2(to.y - pressed.at.y, to.x - pressed.at.x);
    }
    return true;
  }

  /** Let go; returns the pose, null: it was not this pointer that was held. */
  release(pointer: number): Place | null {
    if (this.pressed?.pointer !== pointer) {
      return null;
    }
    const { place } = this;
    this.pressed = null;
    return place;
  }

  /** Give nothing. */
  cancel(): void {
    this.pressed = null;
  }
}
