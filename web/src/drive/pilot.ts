// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The one who decides what is sent to a driven robot, and when.
 *
 * Hands (keys, joystick, gamepad) say what they want; while one of them does, a `drive` goes out
 * at once on each change, at most 60 times a second. The socket repeats the last one, so that the node
 * knows that somebody is there. When the last hand lets go, a `stop` goes out at once.
 */
import type { Drive, PressStop, Stop } from '../protocol';
import { mix, toVelocity, type Demand, type Limits, type Velocity } from './mixing';

const LEAST_GAP = 1000 / 60; // ms between two `drive`

/** What a pilot needs of the world outside. */
export interface PilotPort {
  send(message: Drive | Stop | PressStop): boolean; // false: the connection is not open
  rest(): void; // the last `drive` is repeated no more
  now(): number; // ms
  after(milliseconds: number, call: () => void): () => void; // returns what takes it back
}

export class Pilot {
  limits: Limits = { linear: 0.5, angular: 1.0 };
  /** Whether the wheels of the robot can take it sideways: mecanum and omni wheels. */
  goesSideways = false;
  /** Called when what is asked of the robot changes. */
  onChange: (velocity: Velocity | null) => void = () => {};
  /** Called when a hand wants to drive what another page drives. */
  onRefused: () => void = () => {};
  /** Called when STOP could not be sent. */
  onUnsent: () => void = () => {};

  private robot: string | null = null;
  private readonly hands = new Map<string, Demand>();
  private readonly blocked = new Set<string>(); // hands that must let go before they count again
  private sentAt = -Infinity;
  private taken = false; // another page drives our robot
  private cancel: (() => void) | null = null;

  constructor(private readonly port: PilotPort) {}

  /** Whether a hand drives now. */
  get driving(): boolean {
    return this.robot !== null && this.hands.size > 0;
  }

  /** What the hands ask of the robot; null when none does. */
  get velocity(): Velocity | null {
    return this.driving ? toVelocity(mix([...this.hands.values()]), this.limits) : null;
  }

  /** Drive another robot from now on; the one driven until now stops. */
  setRobot(robot: string | null): void {
    if (robot !== this.robot) {
      this.release();
      this.robot = robot;
    }
  }

  setLimits(limits: Limits): void {
    this.limits = limits;
    if (this.driving) {
      this.changed();
    }
  }

  /** What a hand wants; null when it lets go. */
  set(hand: string, demand: Demand | null): void {
    if (demand === null) {
      this.blocked.delete(hand);
      if (this.hands.delete(hand)) {
        this.changed();
      }
    } else if (this.blocked.has(hand)) {
      return;
    } else if (this.taken) {
      this.blocked.add(hand);
      this.onRefused();
    } else if (!same(this.hands.get(hand), demand)) {
      this.hands.set(hand, demand);
      this.changed();
    }
  }

  /** Every hand lets go: focus, the tab or the pointer was lost. Does nothing when none holds. */
  release(): void {
    const driving = this.driving;
    this.letGo();
    if (driving) {
      this.sendStop();
      this.onChange(null);
    }
  }

  /**
   * STOP: every robot is held at rest, whoever drives, until somebody releases it. A hand that holds
   * must let go to drive again.
   */
  stop(): void {
    this.letGo();
    if (!this.port.send({ type: 'press_stop', robot: null })) {
      this.onUnsent();
    }
    this.onChange(null);
  }

  /**
   * Another page stopped us, the connection went, or we were not heard: nothing is sent; hands must
   * let go. Returns whether one held.
   */
  halt(): boolean {
    const driving = this.driving;
    this.letGo();
    if (driving) {
      this.port.rest();
      this.onChange(null);
    }
    return driving;
  }

  /** Whether another page drives our robot: then no hand of this one does. */
  setTaken(taken: boolean): void {
    this.taken = taken;
    if (taken) {
      this.halt();
    }
  }

  private letGo(): void {
    for (const hand of this.hands.keys()) {
      this.blocked.add(hand);
    }
    this.hands.clear();
    this.cancel?.();
    this.cancel = null;
  }

  private changed(): void {
    if (this.robot === null) {
      return;
    }
    if (this.hands.size === 0) {
      this.letGo();
      this.sendStop();
      this.onChange(null);
      return;
    }
    this.onChange(this.velocity);
    const wait = this.sentAt + LEAST_GAP - this.port.now();
    if (wait <= 0) {
      this.sendDrive();
    } else {
      this.cancel ??= this.port.after(wait, () => this.sendDrive());
    }
  }

  private sendDrive(): void {
    const velocity = this.velocity;
    if (this.robot === null || velocity === null) {
      return;
    }
    this.cancel?.();
    this.cancel = null;
    this.sentAt = this.port.now();
    if (!this.port.send({ type: 'drive', robot: this.robot, ...velocity })) {
      this.halt();
    }
  }

  private sendStop(): void {
    this.port.send({ type: 'stop', robot: this.robot });
  }
}

function same(one: Demand | undefined, other: Demand): boolean {
  return (
    one !== undefined &&
    one.forward === other.forward &&
    one.turn === other.turn &&
    one.left === other.left
  );
}

