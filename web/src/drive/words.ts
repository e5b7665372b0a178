// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What is said of who drives a robot, and of a stop that is held. */
import type { Commanders, HeldRobot } from '../protocol';
import { robotName } from '../format';
import type { Store } from '../store';
import type { Tone } from '../ui';

export interface Word {
  tone: Tone;
  text: string;
}

/** Who drives the shown robot: a page, other nodes, or nobody; or that there is none. */
export function whoDrives(store: Store): Word {
  const { driver, robot } = store;
  if (store.link.state !== 'open') {
    return { tone: 'calm', text: 'Not connected' };
  }
  if (store.silence !== '') {
    return { tone: 'error', text: store.silence };
  }
  const isPaused = store.simulation !== null && store.simulation.state !== 'playing';
  const deaf = store.deafController;
  if (driver !== null) {
    const who = driver.me ? 'You drive' : `${driver.name} drives`;
    const but = isPaused ? 'time stands still' : deaf === null ? '' : `${deaf.name} is ${deaf.state}`;
    return but === ''
      ? { tone: driver.me ? 'good' : 'warning', text: who }
      : { tone: 'warning', text: `${who}, but ${but}` };
  }
  const others = robot === null ? null : store.commanders(robot.id);
  if (others !== null && others.rate > 0) {
    const isHeld = deaf !== null || store.stops.robots.some((each) => each.robot === robot?.id);
    const verb = `${isHeld ? 'command' : 'drive'}${others.nodes.length > 1 ? '' : 's'}`;
    return { tone: 'warning', text: `${named(others)} ${verb}, ${others.rate} Hz` };
  }
  if (isPaused) {
    return { tone: 'warning', text: 'Time stands still' };
  }
  if (deaf !== null) {
    return { tone: 'warning', text: `${deaf.name} is ${deaf.state}` };
  }
  return { tone: 'calm', text: robot === null ? 'No robot' : 'Nobody drives' };
}

/** What becomes of the stops that are held; null: none is. */
export function stopWords(store: Store): Word | null {
  const { stops } = store;
  if (!store.isStopped) {
    return null;
  }
  const worst = worstOf(stops.robots);
  const who = pressedBy(store);
  if (worst === null) {
    return { tone: 'good', text: `${who} No robot is there to hold; one that comes stands.` };
  }
  const name = stops.robots.length > 1 ? `${nameOf(store, worst.robot)} ` : '';
  const others = store.commanders(worst.robot);
  const commanded = others !== null && others.rate > 0 ? `${named(others)}, ${others.rate} Hz` : '';
  switch (worst.state) {
    case 'moves':
      return {
        tone: 'error',
        text: `${name}still moves${commanded === '' ? '' : `: driven by ${commanded}`}. ${who}`,
      };
    case 'braking':
      return { tone: 'warning', text: `${name}brakes. ${who}` };
    case 'unknown':
      return { tone: 'warning', text: `${name}is sent zeros; nothing measures whether it stands. ${who}` };
    case 'holds': {
      const still = commanded === '' ? '' : ` Still commanded by ${commanded}.`;
      return { tone: 'good', text: `${stops.robots.length > 1 ? 'All stand' : 'Stands'} still.${still} ${who}` };
    }
  }
}

/** The robot that still moves, and the controllers that could be deactivated; null: none. */
export function deactivatable(store: Store): HeldRobot | null {
  const moving = store.stops.robots.filter(({ state }) => state === 'moves' || state === 'unknown');
  return moving.find(({ controllers }) => controllers.length > 0) ?? null;
}

const ORDER = ['moves', 'unknown', 'braking', 'holds'] as const;

function worstOf(robots: readonly HeldRobot[]): HeldRobot | null {
  for (const state of ORDER) {
    const found = robots.find((robot) => robot.state === state);
    if (found !== undefined) {
      return found;
    }
  }
  return null;
}

function pressedBy(store: Store): string {
  const { client, since, robots } = store.stops;
  const who = client ?? robots[0]?.client ?? '';
  const when = since ?? robots[0]?.since ?? 0;
  const at = new Date(when * 1000).toLocaleTimeString('en-GB');
  return `Stopped by ${who === store.client ? 'you' : who} at ${at}.`;
}

function named({ nodes }: Commanders): string {
  return nodes.length === 0 ? 'somebody' : nodes.join(', ');
}

function nameOf(store: Store, id: string): string {
  const robot = store.graph?.robots.find((each) => each.id === id);
  return robot === undefined ? id : robotName(robot);
}

/** What the three velocities are. */
export const MEANINGS = {
  command: 'What the robot was told last; nothing is told while this is a dash',
  odometry: 'As the robot reckons by its wheels: it drifts where they slip',
  truth: 'As it really moves, which only a simulator knows',
} as const;
