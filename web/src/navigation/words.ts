// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How a goal goes, in words; and the frame that goals are given in. */
import { fixed } from '../format';
import type { GoalStatus, Layout } from '../protocol';
import type { Tone } from '../ui';

const MAP = 'map'; // REP 105

/** How a goal goes. */
export function goalWords(goal: GoalStatus): { tone: Tone; text: string } {
  const why = goal.text === '' ? '' : `: ${goal.text}`;
  switch (goal.state) {
    case 'active':
      return { tone: 'calm', text: progress(goal) };
    case 'published':
      return { tone: 'calm', text: 'Goal published; nobody tells how far it is' };
    case 'reached':
      return { tone: 'good', text: 'Goal reached' };
    case 'cancelled':
      return { tone: 'warning', text: `Goal cancelled${why}` };
    case 'failed':
      return { tone: 'error', text: `Goal failed${why}` };
  }
}

/** "3.2 m to go, 8 s". */
function progress({ distance, time, recoveries }: GoalStatus): string {
  const parts = [
    distance === null ? 'On the way' : `${fixed(distance, 1)} m to go`,
    ...(time === null ? [] : [`${fixed(time, 0)} s`]),
    ...(recoveries === 0 ? [] : [`${recoveries} ${recoveries === 1 ? 'recovery' : 'recoveries'}`]),
  ];
  return parts.join(', ');
}

/** The frame of a robot's map, which need not be in TF yet: who localises it waits for a pose. */
export function mapFrameOf(layout: Pick<Layout, 'frames'> | null, robot: string): string {
  const names = new Set((layout?.frames ?? []).flatMap(({ name, parent }) => [name, parent]));
  const prefix = robot === '/' ? '' : `${robot.slice(1)}/`;
  const own = `${prefix}${MAP}`;
  if (names.has(own) || names.has(MAP)) {
    return names.has(own) ? own : MAP;
  }
  return [...names].some((name) => prefix !== '' && name.startsWith(prefix)) ? own : MAP;
}
