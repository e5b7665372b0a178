// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A bar between a part of the page and the one below it, that is dragged or moved by keys. */
import { h } from './dom';
import { recall, remember } from './remember';

const LEAST = 0.12; // of the height of the window
const MOST = 0.75;
const STEP = 0.03;
const USUAL = 0.3; // what the style sheet wants, about

/** `name`: that of the CSS variable, and under which the height is kept; `label`: of the bar. */
export function splitter(name: string, label: string): HTMLElement {
  const bar = h('div', {
    class: 'splitter',
    role: 'separator',
    tabindex: 0,
    'aria-label': label,
    'aria-orientation': 'horizontal',
    'aria-valuemin': 100 * LEAST,
    'aria-valuemax': 100 * MOST,
    title: 'Drag, or the up and down arrow keys; a double click: as it was',
  });
  let share: number | null = null; // of the window's height; null: what the style sheet wants

  const set = (wanted: number | null): void => {
    share = wanted === null ? null : Math.min(MOST, Math.max(LEAST, wanted));
    const { style } = document.body;
    if (share === null) {
      style.removeProperty(`--${name}`);
    } else {
      style.setProperty(`--${name}`, `${100 * share}vh`);
    }
    bar.setAttribute('aria-valuenow', String(Math.round(100 * (share ?? USUAL))));
  };
  const keep = (): void => remember(name, share === null ? '' : share.toFixed(3));
  /** The height below the bar now, of the window's. */
  const now = (): number => 1 - bar.getBoundingClientRect().bottom / window.innerHeight;

  bar.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    bar.focus();
    bar.setPointerCapture(event.pointerId);
  });
  bar.addEventListener('pointermove', (event) => {
    if (bar.hasPointerCapture(event.pointerId)) {
      set(1 - event.clientY / window.innerHeight);
    }
  });
  bar.addEventListener('lostpointercapture', keep);
  bar.addEventListener('dblclick', () => {
    set(null);
    keep();
  });
  bar.addEventListener('keydown', (event) => {
    const step = { ArrowUp: STEP, ArrowDown: -STEP }[event.key];
    if (step !== undefined) {
      event.preventDefault();
      event.stopPropagation(); // the robot is not meant
      set((share ?? now()) + step);
      keep();
    }
  });
  const kept = Number.parseFloat(recall(name) ?? '');
  set(Number.isFinite(kept) ? kept : null);
  return bar;
}
