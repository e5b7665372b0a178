// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A gamepad as a hand: the left stick drives, the right one turns too, B (circle) stops. The left
 * stick of a robot that goes sideways takes it there, and only the right one turns.
 */
import { fromStick, mix, type Demand } from './mixing';
import type { Pilot } from './pilot';

const DEAD = 0.12; // share of the throw; worn sticks rest at some 0.08
const HAND = 'gamepad';
const STOP_BUTTON = 1; // of the standard mapping

/** What is read of a gamepad. */
export interface Pad {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly pressed: boolean }[];
}

/** The command of a gamepad; null while its sticks are at rest. */
export function demandOf({ axes }: Pad, goesSideways: boolean): Demand | null {
  const { forward, turn: left } = fromStick(axes[0] ?? 0, axes[1] ?? 0, DEAD);
  const { turn } = fromStick(axes[2] ?? 0, 0, DEAD);
  const drive = goesSideways ? { forward, turn: 0, left } : { forward, turn: left };
  const demand = mix([drive, { forward: 0, turn }]);
  return Object.values(demand).every((share) => share === 0) ? null : demand;
}

export function wantsStop({ buttons }: Pad): boolean {
  return buttons[STOP_BUTTON]?.pressed === true;
}

/** Read gamepads while one is connected; `onName` gets its name, null when it is gone. */
export function listenToGamepads(pilot: Pilot, onName: (name: string | null) => void): void {
  let running = false;
  let stopped = false; // one press is one stop

  const read = (): void => {
    const pad = navigator.getGamepads().find((one) => one !== null && one.connected) ?? null;
    if (pad === null) {
      running = false;
      pilot.set(HAND, null);
      onName(null);
      return;
    }
    const stop = wantsStop(pad);
    if (stop && !stopped) {
      pilot.stop();
    }
    stopped = stop;
    pilot.set(HAND, document.hasFocus() ? demandOf(pad, pilot.goesSideways) : null);
    requestAnimationFrame(read);
  };
  window.addEventListener('gamepadconnected', (event) => {
    onName(event.gamepad.id.replace(/\s*\(.*$/, ''));
    if (!running) {
      running = true;
      requestAnimationFrame(read);
    }
  });
}
