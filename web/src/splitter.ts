// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A bar at the start of a part of the page, that is dragged or moved by keys: the part ends where it ends. */
import { forgetLink, linkPart } from './address';
import { h } from './dom';
import { recall, remember } from './remember';

const STEP = 0.03;

interface About {
  name: string; // that of the CSS variable, and under which the size is kept
  label: string;
  /** Between parts beside one another, else below one another. */
  beside?: boolean;
  part: () => Element | null; // whose size it is
  /** Shares of the window. `usual`: what the style sheet wants, about. */
  least: number;
  most: number;
  usual: number;
}

export interface Splitter {
  readonly element: HTMLElement;
  /** As it was at first. */
  reset: () => void;
}

export function splitter({ name, label, beside = false, part, least, most, usual }: About): Splitter {
  const bar = h('div', {
    class: beside ? 'splitter upright' : 'splitter',
    role: 'separator',
    tabindex: 0,
    'aria-label': label,
    'aria-orientation': beside ? 'vertical' : 'horizontal',
    'aria-valuemin': 100 * least,
    'aria-valuemax': 100 * most,
    title: `Drag, or the ${beside ? 'left and right' : 'up and down'} arrow keys; a double click: as it was`,
  });
  let share: number | null = null; // of the window's size; null: what the style sheet wants

  const set = (wanted: number | null): void => {
    share = wanted === null ? null : Math.min(most, Math.max(least, wanted));
    const { style } = document.body;
    if (share === null) {
      style.removeProperty(`--${name}`);
    } else {
      style.setProperty(`--${name}`, `${100 * share}${beside ? 'vw' : 'vh'}`);
    }
    bar.setAttribute('aria-valuenow', String(Math.round(100 * (share ?? usual))));
  };
  const keep = (): void => {
    remember(name, share === null ? '' : share.toFixed(3));
    forgetLink();
  };
  const reset = (): void => {
    set(null);
    keep();
  };
  const whole = (): number => (beside ? window.innerWidth : window.innerHeight);
  const box = (): DOMRect | undefined => part()?.getBoundingClientRect();
  const end = (): number => (beside ? box()?.right : box()?.bottom) ?? whole();
  /** The part's size now, of the window's. */
  const now = (): number => ((beside ? box()?.width : box()?.height) ?? 0) / whole();

  bar.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    bar.focus();
    bar.setPointerCapture(event.pointerId);
  });
  bar.addEventListener('pointermove', (event) => {
    if (bar.hasPointerCapture(event.pointerId)) {
      set((end() - (beside ? event.clientX : event.clientY)) / whole());
    }
  });
  bar.addEventListener('lostpointercapture', keep);
  bar.addEventListener('dblclick', reset);
  bar.addEventListener('keydown', (event) => {
    const [larger, smaller] = beside ? (['ArrowLeft', 'ArrowRight'] as const) : (['ArrowUp', 'ArrowDown'] as const);
    const step = { [larger]: STEP, [smaller]: -STEP }[event.key as typeof larger | typeof smaller];
    if (step !== undefined) {
      event.preventDefault();
      event.stopPropagation(); // the robot is not meant
      set(now() + step);
      keep();
    }
  });
  const text = linkPart(name, () => share?.toFixed(3) ?? '') ?? recall(name) ?? '';
  const kept = Number.parseFloat(text);
  set(Number.isFinite(kept) ? kept : null);
  return { element: bar, reset };
}
