// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the person chose, kept in this browser. Where storage is forbidden, it lasts a visit. */

const PREFIX = 'amr.';
const visit = new Map<string, string>();

export function remember(name: string, value: string): void {
  visit.set(name, value);
  try {
    localStorage.setItem(PREFIX + name, value);
  } catch {
    // Private windows and strict settings refuse storage; the visit's own memory is enough.
  }
}

export function recall(name: string): string | null {
  try {
    return visit.get(name) ?? localStorage.getItem(PREFIX + name);
  } catch {
    return visit.get(name) ?? null;
  }
}

/** A number remembered, if it is one within the bounds. */
export function recallNumber(
  name: string,
  least: number,
  most: number,
  otherwise: number,
): number {
  const value = Number.parseFloat(recall(name) ?? '');
  return value >= least && value <= most ? value : otherwise;
}
