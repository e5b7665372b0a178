// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The form of the page, by the room that there is: the only place where sizes decide. The style
 * sheet has the rules of each form under `[data-form=…]` of the body.
 *
 * desk: view, plots below it, driving and a panel beside it, the tabs on the edge.
 * wide: low windows, phones on their side, zoomed pages: the view has all of the room; stick and
 *     STOP stand over it; panels come as a column beside it.
 * tall: phones and narrow windows: view, driving, and the panels as a sheet between them.
 */
export type Form = 'desk' | 'wide' | 'tall';

const DESK = { width: 900, height: 660 }; // CSS px, at least
const ROOMY = 1000; // px of width from which a panel takes nothing away from a low view

/** The form for a window, CSS px. */
export function formOf(width: number, height: number): Form {
  if (width >= DESK.width && height >= DESK.height) {
    return 'desk';
  }
  return width >= height ? 'wide' : 'tall';
}

/** Whether the panels are open to begin with: on a desk they always are. */
export function opensPanels(width: number, height: number): boolean {
  return width >= ROOMY || formOf(width, height) === 'desk';
}
