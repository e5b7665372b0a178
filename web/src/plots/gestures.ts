// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What mouse, fingers and keys on a chart mean for the time that is seen, as shares of it. */

export interface TimeHand {
  cursor(share: number | null): void;
  /** The cursor goes by this much, moved by a key. */
  step(share: number): void;
  zoom(share: number, ratio: number): void;
  pan(share: number): void;
  /** A part is being chosen (null: no more); it is chosen. */
  choosing(part: readonly [number, number] | null): void;
  choose(part: readonly [number, number]): void;
  follow(): void;
}

const WHEEL = 0.0015; // of the exponent, a pixel of the wheel
const LINE = 16; // px, where a wheel counts lines
const LEAST_CHOICE = 4; // px: less was a click
const KEY_STEP = 0.02; // of what is seen
const KEY_PAN = 0.2;
const KEY_ZOOM = 1.5;

/** Listen on an element; `area` is where the lines are, of which the shares are. */
export function listenToGestures(
  element: HTMLElement,
  area: () => Pick<DOMRect, 'left' | 'width'>,
  hand: TimeHand,
): void {
  const fingers = new Map<number, number>(); // x of each, as a share
  let chosenFrom: number | null = null;
  let pannedFrom: number | null = null;

  const shareOf = ({ clientX }: { clientX: number }): number => {
    const { left, width } = area();
    return Math.min(1, Math.max(0, (clientX - left) / Math.max(1, width)));
  };

  element.addEventListener('pointerdown', (event) => {
    const share = shareOf(event);
    if (event.pointerType === 'touch') {
      fingers.set(event.pointerId, share);
      hand.cursor(share);
    } else if (event.button === 1 || (event.button === 0 && event.shiftKey)) {
      pannedFrom = share;
    } else if (event.button === 0) {
      chosenFrom = share;
    } else {
      return;
    }
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    const share = shareOf(event);
    if (fingers.has(event.pointerId)) {
      moveFinger(fingers, event.pointerId, share, hand);
    } else if (pannedFrom !== null) {
      hand.pan(pannedFrom - share);
      pannedFrom = share;
    } else if (event.pointerType !== 'touch') {
      hand.cursor(share);
      if (chosenFrom !== null) {
        hand.choosing([chosenFrom, share]);
      }
    }
  });
  const end = (event: PointerEvent): void => {
    const share = shareOf(event);
    fingers.delete(event.pointerId);
    pannedFrom = null;
    if (chosenFrom !== null) {
      hand.choosing(null);
      if (Math.abs(share - chosenFrom) * area().width >= LEAST_CHOICE) {
        hand.choose([chosenFrom, share]);
      }
      chosenFrom = null;
    }
  };
  element.addEventListener('pointerup', end);
  element.addEventListener('pointercancel', (event) => {
    chosenFrom = null;
    hand.choosing(null);
    end(event);
  });
  element.addEventListener('pointerleave', () => {
    if (fingers.size === 0) {
      hand.cursor(null);
    }
  });
  element.addEventListener('dblclick', () => hand.follow());
  element.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault(); // else the page scrolls
      const pixels = event.deltaMode === 0 ? 1 : LINE;
      const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
      if (Math.abs(sideways) > Math.abs(event.deltaY) || event.shiftKey) {
        hand.pan((pixels * sideways) / Math.max(1, area().width));
      } else {
        hand.zoom(shareOf(event), Math.exp(WHEEL * pixels * event.deltaY));
      }
    },
    { passive: false },
  );
  element.addEventListener('keydown', (event) => {
    if (onKey(event, hand)) {
      event.preventDefault();
      event.stopPropagation(); // neither the robot nor the camera is meant
    }
  });
}

/** One finger moves what is seen, two hold what is below them. */
function moveFinger(
  fingers: Map<number, number>,
  id: number,
  share: number,
  hand: TimeHand,
): void {
  const before = fingers.get(id) ?? share;
  fingers.set(id, share);
  const other = [...fingers].find(([each]) => each !== id);
  if (other === undefined) {
    hand.pan(before - share);
    hand.cursor(share);
  } else if (fingers.size === 2) {
    const [, fixed] = other;
    const apart = Math.abs(share - fixed);
    if (apart > 0.01) {
      hand.zoom(fixed, Math.abs(before - fixed) / apart);
    }
  }
}

function onKey(event: KeyboardEvent, hand: TimeHand): boolean {
  const sign = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (event.ctrlKey || event.metaKey || event.altKey) {
    return false;
  }
  if (sign !== undefined) {
    if (event.shiftKey) {
      hand.pan(sign * KEY_PAN);
    } else {
      hand.step(sign * KEY_STEP);
    }
    return true;
  }
  switch (event.key) {
    case '+':
    case '=':
      hand.zoom(0.5, 1 / KEY_ZOOM);
      return true;
    case '-':
      hand.zoom(0.5, KEY_ZOOM);
      return true;
    case 'Home':
      hand.follow();
      return true;
    default:
      return false;
  }
}
