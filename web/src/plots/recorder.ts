// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Keeps what the plots show: of each robot, the last minutes of every state that came. */
import { jointsOf, robotOf, SOURCES, velocityOf, wheelsOf } from '../readings';
import type { RobotState, State } from '../state';
import { History } from './history';

export const SPAN = 300; // s kept
const RATE = 60; // samples a second kept
const UNKNOWN = { velocity: Number.NaN, commanded: Number.NaN };
export const FACTOR_COLUMN = 2 * SOURCES.length;
const FIRST_WHEEL_COLUMN = FACTOR_COLUMN + 1;

export interface Record {
  wheels: string[];
  history: History;
}

/** Where a velocity stands in a sample: linear at 2 i, angular behind it. */
export function velocityColumn(source: number, which: 'linear' | 'angular'): number {
  return 2 * source + (which === 'linear' ? 0 : 1);
}

/** Where the speed of a wheel stands: measured, and behind it what was commanded. */
export function wheelColumn(wheel: number, which: 'measured' | 'commanded'): number {
  return FIRST_WHEEL_COLUMN + 2 * wheel + (which === 'measured' ? 0 : 1);
}

export class Recorder {
  private readonly records = new Map<string, Record>();

  /** `turning`: the joints of a robot that are taken for wheels where no simulator names them. */
  constructor(private readonly turning: (robot: string) => readonly string[]) {}

  /** Keep a state. `factor`: the real-time factor now, null if unknown. */
  record(state: State, factor: number | null): void {
    for (const { id } of state.layout.robots) {
      const robot = robotOf(state, id);
      if (robot !== null) {
        this.recordRobot(state, robot, factor ?? Number.NaN);
      }
    }
  }

  /** What is kept of a robot. */
  of(robot: string | undefined): Record | null {
    return robot === undefined ? null : (this.records.get(robot) ?? null);
  }

  /** Time began anew. */
  clear(): void {
    this.records.clear();
  }

  /** Forget robots that are gone. */
  keep(robots: readonly string[]): void {
    for (const id of [...this.records.keys()]) {
      if (!robots.includes(id)) {
        this.records.delete(id);
      }
    }
  }

  /** How many samples are kept, of all robots. */
  get length(): number {
    let sum = 0;
    for (const { history } of this.records.values()) {
      sum += history.length;
    }
    return sum;
  }

  private recordRobot(state: State, robot: RobotState, factor: number): void {
    const names = this.wheelsOf(state, robot);
    const joints = new Map(jointsOf(state, robot).map((joint) => [joint.name, joint]));
    const speeds = names.flatMap((name) => {
      const { velocity, commanded } = joints.get(name) ?? UNKNOWN;
      return [velocity, commanded];
    });
    const velocities = SOURCES.flatMap((source) => {
      const { linear, angular } = velocityOf(robot, source);
      return [linear, angular];
    });
    const values = [...velocities, factor, ...speeds];
    let record = this.records.get(robot.id);
    if (record === undefined || record.wheels.join() !== names.join()) {
      record = { wheels: names, history: new History(values.length, SPAN, SPAN * RATE) };
      this.records.set(robot.id, record);
    }
    record.history.push(state.time, values);
  }

  private wheelsOf(state: State, robot: RobotState): string[] {
    const wheels = wheelsOf(state, robot).map(({ name }) => name);
    return wheels.length > 0 ? wheels : [...this.turning(robot.id)];
  }
}
