// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Keeps what the plots show: of each robot the last minutes of its states, and plotted fields. */
import { jointsOf, robotOf, SOURCES, velocityOf, wheelsOf } from '../readings';
import type { RobotState, State } from '../state';
import { nameOf, type Field } from './field';
import { History } from './history';
import { SPAN, Track, type Series } from './series';

const RATE = 60; // samples of the states a second kept
const UNSETTLED = 1; // s of a simulation's beginning, whose real-time factor is that of starting
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
  private readonly tracks = new Map<string, Track>();
  private span = SPAN;

  /** `turning`: the joints of a robot that are taken for wheels where no simulator names them. */
  constructor(private readonly turning: (robot: string) => readonly string[]) {}

  /** Keep so many seconds from now on; what was kept is forgotten. */
  setSpan(seconds: number): void {
    this.span = Math.max(SPAN, seconds);
    this.clear();
  }

  /** Keep a state. `factor`: the real-time factor now, null if unknown. */
  record(state: State, factor: number | null): void {
    const known = factor === null || state.time < UNSETTLED ? Number.NaN : factor;
    for (const { id } of state.layout.robots) {
      const robot = robotOf(state, id);
      if (robot !== null) {
        this.recordRobot(state, robot, known);
      }
    }
  }

  /** Keep a value of a field; NaN where the message has none. `time`: s. */
  take(field: Field, time: number, value: number): void {
    const name = nameOf(field);
    const track = this.tracks.get(name) ?? new Track(this.span);
    this.tracks.set(name, track);
    track.push(time, value);
  }

  /** What is kept of a robot. */
  of(robot: string | undefined): Record | null {
    return robot === undefined ? null : (this.records.get(robot) ?? null);
  }

  /** The values of a source, a column being of this robot's record; null: nothing has come. */
  series(robot: string | undefined, source: { column: number } | Field): Series | null {
    return 'column' in source
      ? (this.of(robot)?.history.column(source.column) ?? null)
      : (this.tracks.get(nameOf(source)) ?? null);
  }

  /** A copy of what is kept of a robot, and of the fields, that does not change any more. */
  hold(robot: string | undefined): Recorder {
    const held = new Recorder(this.turning);
    const record = this.of(robot);
    if (robot !== undefined && record !== null) {
      held.records.set(robot, { ...record, history: record.history.copy() });
    }
    for (const [name, track] of this.tracks) {
      held.tracks.set(name, track.copy());
    }
    return held;
  }

  /** Time began anew. */
  clear(): void {
    this.records.clear();
    this.tracks.clear();
  }

  /** Forget robots that are gone. */
  keep(robots: readonly string[]): void {
    retain(this.records, robots);
  }

  /** Forget fields that are plotted no more. */
  keepFields(fields: readonly Field[]): void {
    retain(this.tracks, fields.map(nameOf));
  }

  /** Forget what was of a field. */
  forget(field: Field): void {
    this.tracks.delete(nameOf(field));
  }

  /** Fields do not come any more: what comes next is no continuation. */
  interrupt(): void {
    for (const track of this.tracks.values()) {
      if (!Number.isNaN(track.at(track.latest))) {
        track.push(track.latest, Number.NaN);
      }
    }
  }

  /** How many samples are kept, of all robots and fields. */
  get length(): number {
    let sum = 0;
    for (const { history } of this.records.values()) {
      sum += history.length;
    }
    for (const track of this.tracks.values()) {
      sum += track.length;
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
      record = { wheels: names, history: new History(values.length, this.span, SPAN * RATE) };
      this.records.set(robot.id, record);
    }
    record.history.push(state.time, values);
  }

  private wheelsOf(state: State, robot: RobotState): string[] {
    const wheels = wheelsOf(state, robot).map(({ name }) => name);
    return wheels.length > 0 ? wheels : [...this.turning(robot.id)];
  }
}

function retain<T>(map: Map<string, T>, names: readonly string[]): void {
  const kept = new Set(names);
  for (const name of [...map.keys()]) {
    if (!kept.has(name)) {
      map.delete(name);
    }
  }
}
