// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A URDF file that is dropped onto the view stands in the world where it was dropped; where a description
 * is only looked at, it takes its place. With Shift held its root link is fixed to the world, as that of an arm.
 */
import { ask, type App } from './app';
import { freeName } from './format';
import type { Vector } from './protocol';
import { isFree, type Footprint } from './spawn/free_place';

const HEIGHT = 0.2; // m, from which it falls
const LEAST_RADIUS = 0.15; // m: what is smaller is hardly dropped, what is larger may still touch
const LARGEST = 900_000; // bytes: the node takes no more at once

/**
 * `placeAt`: the point of the ground under a point of the page, in `world`; null: there is none.
 * `robots`: where robots stand.
 */
export function acceptUrdf(
  app: App,
  element: HTMLElement,
  placeAt: (clientX: number, clientY: number) => Vector | null,
  robots: () => readonly Footprint[],
): void {
  element.addEventListener('dragover', (event) => event.preventDefault());
  element.addEventListener('drop', (event) => {
    event.preventDefault(); // the browser would leave the page for the file
    const [file] = event.dataTransfer?.files ?? [];
    const [x, y] = placeAt(event.clientX, event.clientY) ?? [0, 0];
    if (file !== undefined) {
      void takeDropped(app, file, [x, y, event.shiftKey ? 0 : HEIGHT], robots(), event.shiftKey);
    }
  });
}

/** Spawn the robot of a file, or show it; what is wrong with it becomes a notice. */
export async function takeDropped(
  app: App, file: File, position: Vector, robots: readonly Footprint[] = [], fixed = false,
): Promise<void> {
  const isSmall = file.size <= LARGEST;
  const urdf = isSmall ? await file.text() : '';
  const fault = isSmall ? faultOf(file.name, urdf) : `${file.size} bytes are more than ${LARGEST}`;
  const { simulator, robot } = app.store;
  if (fault !== null) {
    app.store.note('error', `${file.name}: ${fault}`);
  } else if (simulator !== null && !hasRoom(app, position, robots)) {
    app.store.note('error', `${file.name}: something stands there; drop it where there is room`);
  } else if (simulator !== null) {
    const name = freeName(simulator.entities, entityName(urdf));
    const namespace = `/${name}`;
    const what = { simulator: simulator.id, name, namespace, position, yaw: 0, like: null, urdf, fixed };
    await ask(app, { type: 'spawn', ...what });
  } else if (robot?.joint_publisher != null) {
    const node = `${robot.id.replace(/\/$/, '')}/robot_state_publisher`;
    const name = 'robot_description';
    await ask(app, { type: 'set_parameter', node, name, kind: 'string', value: urdf });
  } else {
    const why = 'nothing simulates here, and no joint_state_publisher moves a robot to look at';
    app.store.note('error', `${file.name}: ${why}; scripts/run and scripts/run display take it`);
  }
}

/** Whether nothing stands where a robot is to fall, of which only its file is known. */
function hasRoom(app: App, [x, y]: Vector, robots: readonly Footprint[]): boolean {
  const shapes = [...app.store.worlds.values()].flatMap((world) => world.shapes);
  return isFree({ x, y }, LEAST_RADIUS, robots, shapes);
}

/** What a robot is called in the world: as in its URDF, as far as that is a name. */
function entityName(urdf: string): string {
  const name = /<robot\b[^>]*\bname\s*=\s*["']([^"']*)["']/.exec(urdf)?.[1] ?? '';
  return name.replace(/\W/g, '_').replace(/^(?=\d|_|$)/, 'robot');
}

/** Why a file cannot be taken; null: it may be a URDF, of which others say the rest. */
function faultOf(name: string, text: string): string | null {
  if (/xmlns:xacro\s*=/.test(text)) {
    return `it is xacro; \`ros2 run xacro xacro ${name} NAME:=VALUE … > robot.urdf\` makes a URDF of it`;
  }
  return /<robot\b/.test(text) ? null : 'it is no URDF: there is no <robot> in it';
}
