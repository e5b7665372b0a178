// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Where labels go that must not lie on one another: pure, in CSS pixels. */

export interface Anchor {
  key: string;
  x: number; // of the point that the label is of
  y: number;
  width: number;
  height: number;
  isAbove?: boolean; // the label is best right above its point
}

export interface PlacedLabel {
  key: string;
  left: number;
  top: number;
}

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const GAP = 3;
const DISTANCES = [10, 22, 40, 64, 92]; // from the point to its label
const DIRECTIONS = 12;
const CLUSTER = 220; // points within are about one another
const HABIT = 0.8;
const UP = { x: 0, y: -1 };

/**
 * Find a place for each label, near its point; the first ones choose first.
 *
 * A label goes to the side of its point that is away from the points around, so that a cluster's
 * labels stand about it like rays. `habits` keeps which place each took, so that it stays there
 * while that is free: it is read and written. A label that finds no free place is left out.
 * `blocked`: what else stands there.
 */
export function placeLabels(
  anchors: readonly Anchor[], width: number, height: number, habits: Map<string, number>,
  blocked: readonly Box[] = [],
): PlacedLabel[] {
  const taken: Box[] = [...blocked];
  const placed: PlacedLabel[] = [];
  for (const anchor of anchors) {
    const outward = anchor.isAbove === true ? UP : outwardOf(anchor, anchors);
    const habit = habits.get(anchor.key);
    const cost = (index: number): number =>
      costOf(PLACES[index]!, outward) - (index === habit ? HABIT : 0);
    const order = [...PLACES.keys()].sort((a, b) => cost(a) - cost(b));
    const boxes = PLACES.map((place) => boxAt(anchor, place));
    const choice = order.find(
      (index) =>
        isWithin(boxes[index]!, width, height) &&
        !taken.some((other) => overlap(boxes[index]!, other)),
    );
    if (choice === undefined) {
      continue;
    }
    habits.set(anchor.key, choice);
    const box = boxes[choice]!;
    taken.push(box);
    placed.push({ key: anchor.key, left: box.left, top: box.top });
  }
  return placed;
}

/** A place about a point: the direction to it, and how far the label is pushed that way. */
interface Place {
  x: number; // unit vector, in the picture
  y: number;
  distance: number; // CSS pixels
}

const PLACES: readonly Place[] = DISTANCES.flatMap((distance) =>
  Array.from({ length: DIRECTIONS }, (_, at) => {
    const angle = (2 * Math.PI * at) / DIRECTIONS;
    return { x: Math.cos(angle), y: Math.sin(angle), distance };
  }),
);

/** The label's box where it just lies beyond `distance` from its point, in that direction. */
function boxAt({ x, y, width, height }: Anchor, place: Place): Box {
  const left = x + place.x * (place.distance + width / 2) - width / 2;
  const top = y + place.y * (place.distance + height / 2) - height / 2;
  return { left, top, right: left + width, bottom: top + height };
}

/** Away from the other points nearby: 0 long in their middle, about 1 at their edge. */
function outwardOf(anchor: Anchor, anchors: readonly Anchor[]): { x: number; y: number } {
  const near = anchors.filter(({ x, y }) => Math.hypot(x - anchor.x, y - anchor.y) < CLUSTER);
  const mean = (values: number[]): number => values.reduce((a, b) => a + b, 0) / values.length;
  const x = anchor.x - mean(near.map((each) => each.x));
  const y = anchor.y - mean(near.map((each) => each.y));
  const length = Math.max(Math.hypot(x, y), CLUSTER / 8);
  return { x: x / length, y: y / length };
}

/** Near is better, outward is better, and of the rest the right side. */
function costOf(place: Place, outward: { x: number; y: number }): number {
  return place.distance / 20 - 2 * (place.x * outward.x + place.y * outward.y) - 0.3 * place.x;
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
