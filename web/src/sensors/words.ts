// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What a sample says, in words. */
import { fixed, UNKNOWN } from '../format';
import type { Contacts, OccupancyGrid, Picture } from '../protocol';
import { pointsOf, type Sample } from '../samples';

const OLDEST_CONTACT = 0.5; // s; some publish only while there is a contact
const OLDEST = 3600; // s; more is the difference of two clocks

/** How often it comes, and how old the latest is at `now`, s. */
export function timing({ head }: Sample, now: number): string {
  const { rate, stamp } = head.origin;
  const often = rate === null ? UNKNOWN : `${fixed(rate, rate < 10 ? 1 : 0)} Hz`;
  const age = now - stamp;
  const known = head.type !== 'unreadable' && stamp !== 0 && Math.abs(age) < OLDEST;
  return known ? `${often} · ${fixed(Math.max(0, age), 2)} s old` : often;
}

/** What it has measured, on one line; `now`: s. */
export function measured(sample: Sample, now: number): string {
  const { head, floats } = sample;
  switch (head.type) {
    case 'scan':
      return `${shownOf(floats.length, head.count)} rays · ${nearest(floats, head.range_min, head.range_max)}`;
    case 'cloud':
      return `${shownOf(pointsOf(sample).count, head.count)} points`;
    case 'picture':
      return pictureWords(head);
    case 'range':
      return distance(floats[0]);
    case 'contacts':
      return contactWords(head, now - head.origin.stamp > OLDEST_CONTACT);
    case 'map':
      return mapWords(head);
    case 'path':
      return head.count === 0 ? 'no path' : `${head.count} poses · ${fixed(head.length, 1)} m`;
    case 'marks':
      return `${shownOf(head.shown, head.count)} ${head.count === 1 ? 'mark' : 'marks'}`;
    case 'unreadable':
      return head.text;
    default:
      return ''; // of another channel: no sensor's
  }
}

/** How many there are, and how many of them are shown. */
function shownOf(shown: number, all: number): string {
  return shown < all ? `${thousands(shown)} of ${thousands(all)}` : thousands(all);
}

function thousands(count: number): string {
  return count.toLocaleString('en-GB').replaceAll(',', '\u202f');
}

function nearest(ranges: Float32Array, low: number | null, high: number | null): string {
  let least = Infinity;
  for (const range of ranges) {
    if (range < least && range >= (low ?? -Infinity) && range <= (high ?? Infinity)) {
      least = range;
    }
  }
  return least === Infinity ? 'nothing in range' : `nearest ${fixed(least, 2)} m`;
}

function pictureWords({ width, height, encoding, low, high }: Picture): string {
  const size = `${width} × ${height} ${encoding}`;
  return low === null || high === null ? size : `${size} · ${fixed(low, 2)} to ${fixed(high, 2)} m`;
}

function mapWords({ width, height, resolution }: OccupancyGrid): string {
  const size = `${fixed(width * resolution, 1)} × ${fixed(height * resolution, 1)} m`;
  return `${width} × ${height} cells of ${fixed(resolution, 3)} m · ${size}`;
}

function distance(range: number | undefined): string {
  if (range === Infinity) {
    return 'nothing in range'; // REP 117
  }
  return range === -Infinity ? 'too near' : `${fixed(range, 3)} m`;
}

function contactWords({ contacts }: Contacts, isOver: boolean): string {
  if (contacts.length === 0 || isOver) {
    return 'touches nothing';
  }
  return contacts
    .map(({ first, second, force }) => {
      const strength = force === null ? '' : ` (${fixed(force, 1)} N)`;
      return `${first} touches ${second}${strength}`;
    })
    .join('; ');
}
