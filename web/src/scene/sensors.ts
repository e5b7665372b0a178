// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What sensors measured, where they were then: scans, clouds, distances, contacts. */
import { Color, Group, Matrix4, Vector3 } from 'three';
import { PLACE_FLOATS, type Contacts, type Distance, type Scan, type SensorInfo } from '../protocol';
import { pointsOf, type Sample } from '../samples';
import { firstLook, type LookOf } from '../sensors/looks';
import { vectorAt } from '../state';
import { rainbow } from './gradient';
import { DynamicPoints } from './points';
import { Segments } from './segments';
import type { Palette } from './theme';

const ARC = 12; // pieces
const MOST_DRAWN = 20; // m, of a distance that is infinite or absurd
const CROSS = 0.015; // m
const NORMAL = 0.15; // m
const MOST_OLDER = 100; // samples of a topic that stay for a while
const OLDEST_CONTACT = 0.5; // s

/** Where a frame was at a time; `isSettled`: no later state knows it better. */
export type Locate = (
  frame: string, robot: string, stamp: number,
) => { pose: Matrix4 | null; isSettled: boolean };

interface Shown {
  info: SensorInfo;
  sample: Sample;
  pose: Matrix4 | null;
  isSettled: boolean;
  points: DynamicPoints | null;
  count: number;
  /** Of samples before, that stay for a while: drawn, in their places. */
  older: Older[];
}

interface Older {
  stamp: number;
  points: DynamicPoints;
}

/** What is drawn of a sensor, for tests: how many points, and their extent in the fixed frame. */
export interface SensorNumbers {
  points: number;
  extent: number[] | null; // m: least x, y, z, then greatest
}

export class SensorLayer {
  /** Hidden by what is before them. */
  readonly points = new Group();
  /** Seen through everything. */
  readonly marks = new Group();
  private readonly lines = new Segments(2.5);
  private readonly shown = new Map<string, Shown>();
  private colours: readonly Color[] = [];
  private readonly distanceColour = new Color();
  private readonly contactColour = new Color();

  /** `lookOf`: how a topic is drawn. */
  constructor(private readonly lookOf: LookOf = ({ kind }) => firstLook(kind)) {
    this.marks.add(this.lines.object);
  }

  get isEmpty(): boolean {
    return this.shown.size === 0;
  }

  setPalette(palette: Palette): void {
    this.colours = palette.scans.map((colour) => new Color(colour));
    this.distanceColour.set(palette.distance);
    this.contactColour.set(palette.touch);
    this.unsettle();
  }

  take(info: SensorInfo, sample: Sample): void {
    const before = this.shown.get(info.topic);
    if (before?.info.kind === info.kind) {
      this.keepOlder(before, sample);
      Object.assign(before, { info, sample, isSettled: false });
      return;
    }
    this.dispose(before);
    const points = this.newPoints(info);
    this.shown.set(info.topic, { info, sample, pose: null, isSettled: false, points, count: 0, older: [] });
  }

  /** Draw no others than these. */
  retain(topics: ReadonlySet<string>): void {
    for (const [topic, each] of [...this.shown]) {
      if (!topics.has(topic)) {
        this.dispose(each);
        this.shown.delete(topic);
      }
    }
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    const each = this.shown.get(topic);
    if (each !== undefined) {
      each.isSettled = false;
      const look = this.lookOf(each.info);
      [each, ...each.older].forEach(({ points }) => points?.setLook(look));
      this.forgetOlder(each, each.sample.head.origin.stamp);
    }
  }

  /** Have what is drawn stay beside the next sample, where the topic is to be drawn so. */
  private keepOlder(each: Shown, { head: { origin } }: Sample): void {
    const { decay } = this.lookOf(each.info);
    if (decay > 0 && each.points !== null && each.pose !== null && each.older.length < MOST_OLDER) {
      each.older.push({ stamp: each.sample.head.origin.stamp, points: each.points });
      each.points = this.newPoints(each.info);
    }
    this.forgetOlder(each, origin.stamp);
  }

  private forgetOlder(each: Shown, now: number): void {
    const { decay } = this.lookOf(each.info);
    const isOver = ({ stamp }: Older): boolean => decay === 0 || now - stamp > decay || now < stamp;
    each.older.filter(isOver).forEach(({ points }) => points.dispose());
    each.older = each.older.filter((one) => !isOver(one));
  }

  private dispose(each: Shown | undefined): void {
    each?.points?.dispose();
    each?.older.forEach(({ points }) => points.dispose());
  }

  /** Find the places anew: another frame stands still. */
  unsettle(): void {
    this.shown.forEach((each) => {
      each.isSettled = false;
      each.older.splice(0).forEach(({ points }) => points.dispose());
    });
  }

  /** Contacts are published while there are some: forget old ones. Returns whether any went. */
  expire(now: number): boolean {
    const before = this.shown.size;
    for (const [topic, { info, sample }] of [...this.shown]) {
      if (info.kind === 'contacts' && now - sample.head.origin.stamp > OLDEST_CONTACT) {
        this.shown.delete(topic);
      }
    }
    return this.shown.size < before;
  }

  place(locate: Locate): void {
    this.lines.clear();
    let index = 0;
    for (const each of this.shown.values()) {
      if (!each.isSettled) {
        const { frame, stamp } = each.sample.head.origin;
        const { pose, isSettled } = locate(frame, each.info.robot, stamp);
        each.isSettled = isSettled;
        each.pose = pose;
        this.drawPoints(each, index);
      }
      this.drawMarks(each);
      index += 1;
    }
    this.lines.commit();
  }

  numbers(): Record<string, SensorNumbers> {
    const pairs = [...this.shown].map(([topic, { pose, points, count }]) => {
      const extent = pose === null ? null : extentOf(points, count, pose);
      return [topic, { points: pose === null ? 0 : count, extent }] as const;
    });
    return Object.fromEntries(pairs);
  }

  private newPoints(info: SensorInfo): DynamicPoints | null {
    if (info.kind !== 'scan' && info.kind !== 'cloud') {
      return null;
    }
    const look = this.lookOf(info);
    const points = new DynamicPoints(look.size);
    points.setLook(look);
    this.points.add(points.object);
    return points;
  }

  private drawPoints(each: Shown, index: number): void {
    const { sample, pose, points } = each;
    if (points === null) {
      return;
    }
    points.object.visible = pose !== null;
    if (pose === null) {
      return;
    }
    points.object.matrix.copy(pose);
    points.object.matrixWorldNeedsUpdate = true;
    const { colouring } = this.lookOf(each.info);
    const colour = this.colours[index % this.colours.length] ?? new Color();
    if (sample.head.type === 'scan') {
      each.count = fillScan(points, sample as Sample<Scan>, colour);
      if (colouring !== 'plain') {
        paint(points.colours, heights(points.positions.subarray(0, 3 * each.count), pose));
      }
    } else if (sample.head.type === 'cloud') {
      each.count = fillCloud(points, sample, pose, colouring === 'plain' ? colour : colouring);
    } else {
      each.count = 0;
    }
    points.commit(each.count);
  }

  private drawMarks({ sample, pose }: Shown): void {
    if (pose === null) {
      return;
    }
    if (sample.head.type === 'range') {
      this.drawDistance(sample as Sample<Distance>, pose);
    } else if (sample.head.type === 'contacts') {
      this.drawContacts(sample as Sample<Contacts>, pose);
    }
  }

  /** The cone that the sensor sees, as far as it sees, from above. */
  private drawDistance({ head, floats }: Sample<Distance>, pose: Matrix4): void {
    const farthest = Math.min(head.max_range ?? MOST_DRAWN, MOST_DRAWN);
    const distance = floats[0] ?? Number.NaN;
    const measured = distance === -Infinity ? (head.min_range ?? 0) : distance;
    const range = Math.min(measured, farthest);
    if (!(range >= 0)) {
      return; // it is not known
    }
    const half = Math.min(Math.PI, Math.max(0, (head.field_of_view ?? 0) / 2));
    const at = (angle: number): Vector3 =>
      new Vector3(range * Math.cos(angle), range * Math.sin(angle), 0).applyMatrix4(pose);
    const origin = new Vector3().setFromMatrixPosition(pose);
    for (const angle of [-half, half]) {
      this.lines.add(origin, at(angle), this.distanceColour);
    }
    for (let piece = 0; piece < ARC; piece += 1) {
      const from = at(-half + (2 * half * piece) / ARC);
      this.lines.add(from, at(-half + (2 * half * (piece + 1)) / ARC), this.distanceColour);
    }
  }

  /** A cross where shapes touch, and the normal. */
  private drawContacts({ floats }: Sample<Contacts>, pose: Matrix4): void {
    const from = new Vector3();
    const to = new Vector3();
    for (let place = 0; place + PLACE_FLOATS <= floats.length; place += PLACE_FLOATS) {
      const point = new Vector3().fromArray(floats, place).applyMatrix4(pose);
      const normal = new Vector3().fromArray(floats, place + 3).transformDirection(pose);
      if (!Number.isFinite(point.x + point.y + point.z)) {
        continue;
      }
      for (const axis of [[CROSS, 0, 0], [0, CROSS, 0], [0, 0, CROSS]]) {
        from.fromArray(axis).add(point);
        to.fromArray(axis).negate().add(point);
        this.lines.add(from, to, this.contactColour);
      }
      if (normal.lengthSq() > 0.5) {
        this.lines.add(point, to.copy(point).addScaledVector(normal, NORMAL), this.contactColour);
      }
    }
  }
}

/** Put the rays that hit something in, m in the frame of the sensor; returns how many. */
export function fillScan(
  points: DynamicPoints, { head, floats }: Sample<Scan>, colour: Color,
): number {
  const { angle_min: begin, angle_increment: step } = head;
  const low = head.range_min ?? 0;
  const high = head.range_max ?? Infinity;
  points.reserve(floats.length);
  const { positions, colours } = points;
  const bytes = bytesOf(colour);
  let count = 0;
  floats.forEach((range, ray) => {
    if (range >= low && range <= high && range < Infinity) {
      const at = 3 * count;
      positions[at] = range * Math.cos(begin + ray * step);
      positions[at + 1] = range * Math.sin(begin + ray * step);
      positions[at + 2] = 0;
      colours.set(bytes, at);
      count += 1;
    }
  });
  return count;
}

/** Put a cloud in, by its own colours, else its intensities, by its heights in the fixed frame, or in one. */
function fillCloud(points: DynamicPoints, sample: Sample, pose: Matrix4, by: 'own' | 'height' | Color): number {
  const { count, positions, rgb, intensities } = pointsOf(sample);
  points.reserve(count);
  points.positions.set(positions);
  if (by instanceof Color) {
    const bytes = bytesOf(by);
    for (let at = 0; at < count; at += 1) {
      points.colours.set(bytes, 3 * at);
    }
  } else if (rgb !== null && by === 'own') {
    points.colours.set(linear(rgb));
  } else {
    paint(points.colours, (by === 'own' ? intensities : null) ?? heights(positions, pose));
  }
  return count;
}

function bytesOf({ r, g, b }: Color): number[] {
  return [r, g, b].map((part) => Math.round(255 * part));
}

function heights(positions: Float32Array, { elements: m }: Matrix4): Float32Array {
  const found = new Float32Array(positions.length / 3);
  for (let at = 0; at < found.length; at += 1) {
    const [x, y, z] = vectorAt(positions, at);
    found[at] = m[2] * x + m[6] * y + m[10] * z + m[14];
  }
  return found;
}

function paint(colours: Uint8Array, values: Float32Array): void {
  let least = Infinity;
  let most = -Infinity;
  for (const value of values) {
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  const table = rainbow();
  const scale = 255 / Math.max(most - least, 1e-6);
  values.forEach((value, at) => {
    const from = 3 * Math.round((value - least) * scale);
    colours.set(table.subarray(from, from + 3), 3 * at);
  });
}

/** Of sRGB bytes those of linear light, as three.js takes colours of points. */
function linear(rgb: Uint8Array): Uint8Array {
  return rgb.map((value) => LINEAR[value]!);
}

const LINEAR = Uint8Array.from({ length: 256 }, (_, value) => {
  return Math.round(255 * new Color().setRGB(value / 255, 0, 0, 'srgb').r);
});

function extentOf(points: DynamicPoints | null, count: number, pose: Matrix4): number[] | null {
  if (points === null || count === 0) {
    return null;
  }
  const least = new Vector3(Infinity, Infinity, Infinity);
  const most = least.clone().negate();
  for (let at = 0; at < count; at += 1) {
    const point = new Vector3().fromArray(points.positions, 3 * at).applyMatrix4(pose);
    least.min(point);
    most.max(point);
  }
  return [...least.toArray(), ...most.toArray()];
}
