// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The keyboard as a hand: hold to drive, let go to stop; Space and Escape stop everything. */
import { takesKey } from '../dom';
import { fromKeys, isDriveKey } from './mixing';
import type { Pilot } from './pilot';

const MODIFIERS = new Set(['MetaLeft', 'MetaRight', 'ControlLeft', 'ControlRight', 'AltLeft']);

/** `isDriven`: whether anybody drives anything; `isOff`: whether there is nothing to drive, nor to stop. */
export function listenToKeys(pilot: Pilot, isDriven: () => boolean, isOff: () => boolean = () => false): void {
  const down = new Set<string>();
  const tell = (): void => pilot.set('keys', down.size === 0 ? null : fromKeys(down));

  window.addEventListener('keydown', (event) => {
    if (isOff()) {
      return;
    }
    if (event.code === 'Escape' || (event.code === 'Space' && isStop(event, isDriven()))) {
      event.preventDefault();
      pilot.stop();
    } else if (MODIFIERS.has(event.code)) {
      // While ⌘ is down, macOS sends no key-up of other keys.
      down.clear();
      tell();
    } else if (isDriveKey(event.code, pilot.goesSideways) && isForDriving(event)) {
      event.preventDefault(); // arrows would scroll a panel
      if (!event.repeat) {
        down.add(event.code);
        tell();
      }
    }
  });
  window.addEventListener('keyup', (event) => {
    if (down.delete(event.code)) {
      tell();
    }
  });
  const forget = (): void => {
    pilot.release();
    down.clear();
    tell();
  };
  window.addEventListener('blur', forget);
  window.addEventListener('pagehide', forget);
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) {
      forget();
    }
  });
}

function isForDriving(event: KeyboardEvent): boolean {
  const modified = event.ctrlKey || event.metaKey || event.altKey;
  return !modified && !takesKey(event.target, event.code);
}

/**
 * Space is for a button that was reached with the keyboard, but never while a robot is driven, by
 * whomever: who hits Space in a hurry wants to stop.
 */
function isStop(event: KeyboardEvent, isDriven: boolean): boolean {
  const { target } = event;
  const pressable = 'button:focus-visible, a:focus-visible, summary:focus-visible';
  const busy = target instanceof HTMLElement && target.matches(pressable);
  return isDriven || !(busy || takesKey(target, event.code));
}
