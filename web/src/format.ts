// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Numbers as people read them: of constant width, a true minus, a dash for what is unknown. */

export const UNKNOWN = '–';

/** What a robot is called: by its namespace, which is its own; in none by its description. */
export function robotName({ id, name }: { id: string; name: string }): string {
  return id === '/' ? name : id.slice(1);
}

/** A number with so many decimals. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return UNKNOWN;
  }
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}

/** An angle (rad) in degrees. */
export function degrees(angle: number): string {
  return Number.isFinite(angle) ? `${fixed((angle * 180) / Math.PI, 1)}°` : UNKNOWN;
}

/** How fast simulated time goes: "0.98×". */
export function factor(value: number | null): string {
  return value === null ? UNKNOWN : `${fixed(value, 2)}×`;
}

/** A time (s) of a simulator as "1:02:03.4", a clock's as its time of day. */
export function clock(time: number): string {
  if (!Number.isFinite(time)) {
    return UNKNOWN;
  }
  if (time > 1e8) {
    return new Date(time * 1000).toLocaleTimeString('en-GB');
  }
  const tenths = Math.floor(time * 10 + 1e-6);
  const seconds = Math.floor(tenths / 10);
  const hours = Math.floor(seconds / 3600);
  const minutes = Math.floor(seconds / 60) % 60;
  const rest = `${String(seconds % 60).padStart(2, '0')}.${tenths % 10}`;
  const head = hours === 0 ? `${minutes}` : `${hours}:${String(minutes).padStart(2, '0')}`;
  return `${head}:${rest}`;
}

/** Bytes: "3.4 MB". */
export function sizeText(bytes: number): string {
  return bytes < 1e6 ? `${Math.round(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(bytes < 1e8 ? 1 : 0)} MB`;
}

/** A name that is not taken: this one, or its like with the least number from 1 on. */
export function freeName(taken: readonly string[], wanted = 'robot1'): string {
  const stem = wanted.replace(/\d+$/, '');
  let name = wanted;
  for (let number = 1; taken.includes(name); number += 1) {
    name = `${stem}${number}`;
  }
  return name;
}

/** A time, s, at a cursor: "12.34 s", or of a clock, "14:03:20.15". */
export function timeText(time: number): string {
  return time > 1e8 ? `${clock(time)}${(time % 1).toFixed(2).slice(1)}` : `${time.toFixed(2)} s`;
}
