// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The numbers of a state under their names. */
import { WHEEL_FLOATS } from './protocol';
import type { Velocity } from './drive/mixing';
import type { RobotState, State, WheelNumbers } from './state';

export const SOURCES = ['command', 'odometry', 'truth'] as const;
export type Source = (typeof SOURCES)[number];

const LINEAR = 7; // where the twist stands in a motion, behind the pose
const ANGULAR = 8;
const SIDEWAYS = 9;

export interface JointReading {
  name: string;
  position: number; // rad or m
  velocity: number; // rad/s or m/s
  commanded: number; // the velocity that its controller wants
}

export interface WheelReading {
  name: string;
  speed: number; // rad/s, of its joint
  contact: boolean | null; // null: unknown
  force: number; // N, normal
  along: number; // m/s of slip
  across: number; // m/s
}

/** The part of a state that is of a robot. */
export function robotOf(state: State, id: string | undefined): RobotState | null {
  return state.robots.find((robot) => robot.id === id) ?? null;
}

/** Velocity as commanded, as odometry has it, or as it truly is; not a number where unknown. */
export function velocityOf(robot: RobotState, source: Source): Velocity {
  return source === 'command'
    ? { linear: robot.command[0]!, angular: robot.command[1]!, sideways: robot.command[2]! }
    : {
        linear: robot[source][LINEAR]!,
        angular: robot[source][ANGULAR]!,
        sideways: robot[source][SIDEWAYS]!,
      };
}

function layoutOf(state: State, robot: RobotState): { joints: string[]; wheels: string[] } {
  return state.layout.robots.find(({ id }) => id === robot.id) ?? { joints: [], wheels: [] };
}

export function jointsOf(state: State, robot: RobotState): JointReading[] {
  return layoutOf(state, robot).joints.map((name, index) => ({
    name,
    position: robot.positions[index]!,
    velocity: robot.velocities[index]!,
    commanded: robot.commanded[index]!,
  }));
}

export function wheelsOf(state: State, robot: RobotState): WheelReading[] {
  const { joints, wheels } = layoutOf(state, robot);
  return wheels.map((name, index) => {
    const numbers = robot.wheels.subarray(index * WHEEL_FLOATS, (index + 1) * WHEEL_FLOATS);
    const [contact, force, along, across] = numbers as unknown as WheelNumbers;
    const speed = robot.velocities[joints.indexOf(name)] ?? Number.NaN;
    return { name, speed, contact: toFlag(contact), force, along, across };
  });
}

function toFlag(value: number): boolean | null {
  return Number.isNaN(value) ? null : value > 0.5;
}
