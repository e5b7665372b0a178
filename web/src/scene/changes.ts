// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Whether two states look the same: a robot that stands costs no frame. */
import { HEADER_BYTES } from '../protocol';
import type { State } from '../state';

const TOLERANCE = 1e-4; // m, rad … a tenth of a millimetre is not seen

/** Whether a state would be drawn otherwise than one of the same layout before it. */
export function differ(before: State | null, after: State): boolean {
  if (before === null || before.layout.id !== after.layout.id) {
    return true;
  }
  const old = new Float32Array(before.poses.buffer, HEADER_BYTES);
  const now = new Float32Array(after.poses.buffer, HEADER_BYTES);
  if (old.length !== now.length) {
    return true;
  }
  for (let i = 0; i < now.length; i++) {
    const isSame = Math.abs(now[i]! - old[i]!) <= TOLERANCE * Math.max(1, Math.abs(old[i]!));
    if (!isSame && !(Number.isNaN(now[i]) && Number.isNaN(old[i]))) {
      return true;
    }
  }
  return false;
}
