// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Where labels go that must not lie on one another: pure, in CSS pixels. */

export interface Anchor {
  key: string;
  x: number; // of the point that the label is of
  y: number;
  width: number;
  height: number;
}

export interface PlacedLabel {
  key: string;
  left: number;
  top: number;
}

interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const GAP = 3;
const NEAR = 12; // from the point to its label
const RINGS = 5;

/**
 * Find a place for each label, near its point; the first ones choose first.
 *
 * `habits` keeps which place each label took, so that it stays there while that is free: it is
 * read and written. A label that finds no free place is left out.
 */
export function placeLabels(
  anchors: readonly Anchor[], width: number, height: number, habits: Map<string, number>,
): PlacedLabel[] {
  const taken: Box[] = [];
  const placed: PlacedLabel[] = [];
  for (const anchor of anchors) {
    const candidates = candidatesOf(anchor);
    const habit = habits.get(anchor.key) ?? 0;
    const order = [habit, ...candidates.keys()];
    const choice = order.find((index) => {
      const box = candidates[index];
      return isWithin(box, width, height) && !taken.some((other) => overlap(box, other));
    });
    if (choice === undefined) {
      continue;
    }
    habits.set(anchor.key, choice);
    const box = candidates[choice];
    taken.push(box);
    placed.push({ key: anchor.key, left: box.left, top: box.top });
  }
  return placed;
}

/** Right of the point, left of it, above and below; then further up and down. */
function candidatesOf({ x, y, width, height }: Anchor): Box[] {
  const boxes: Box[] = [];
  const add = (left: number, top: number): void => {
    boxes.push({ left, top, right: left + width, bottom: top + height });
  };
  for (let ring = 0; ring < RINGS; ring++) {
    const rise = ring * (height + GAP);
    for (const side of ring === 0 ? [0] : [-rise, rise]) {
      add(x + NEAR, y - height / 2 + side);
      add(x - NEAR - width, y - height / 2 + side);
    }
    add(x - width / 2, y - NEAR - height - rise);
    add(x - width / 2, y + NEAR + rise);
  }
  return boxes;
}

function isWithin(box: Box, width: number, height: number): boolean {
  return box.left >= 0 && box.top >= 0 && box.right <= width && box.bottom <= height;
}

function overlap(one: Box, other: Box): boolean {
  return (
    one.left < other.right + GAP &&
    other.left < one.right + GAP &&
    one.top < other.bottom + GAP &&
    other.top < one.bottom + GAP
  );
}
