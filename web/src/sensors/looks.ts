// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How topics are drawn: size, colour, opacity, how long, over which, where it is not as at first. Kept, and in the link. */
import { signal } from '@preact/signals';
import { forgetLink, linkPart } from '../address';
import type { SensorInfo } from '../protocol';
import { recall, remember } from '../remember';

/** own: by their colours, else intensities; height: of the fixed frame; plain: one colour for all. */
export const COLOURINGS = ['own', 'height', 'plain'] as const;
export type Colouring = (typeof COLOURINGS)[number];

export interface Look {
  size: number; // CSS pixels, of points
  colouring: Colouring;
  opacity: number; // 0.1..1
  decay: number; // s that points stay; 0: until the next ones come
  order: number; // those with more are drawn over those with less
}

/** How a topic is drawn. */
export type LookOf = (info: Pick<SensorInfo, 'topic' | 'kind'>) => Look;

export const BOUNDS = { size: [1, 20], opacity: [0.1, 1], decay: [0, 30], order: [-10, 10] } as const;
type Kind = SensorInfo['kind'];

const NAME = 'looks';
const SIZES: Partial<Record<Kind, number>> = { scan: 4, cloud: 2 };
const OF_POINTS = ['size', 'colouring', 'opacity', 'decay', 'order'] as const;
const OF_SHAPES = ['opacity', 'order'] as const;
const SETTINGS: Partial<Record<Kind, readonly (keyof Look)[]>> = {
  scan: OF_POINTS, cloud: OF_POINTS, map: OF_SHAPES, markers: OF_SHAPES, poses: OF_SHAPES, polygon: OF_SHAPES,
  point: OF_SHAPES,
};

/** What can be set of a kind. */
export function settingsOf(kind: Kind): readonly (keyof Look)[] {
  return SETTINGS[kind] ?? [];
}

/** As a kind is drawn at first: scans in one colour. */
export function firstLook(kind: Kind): Look {
  return { size: SIZES[kind] ?? 2, colouring: kind === 'scan' ? 'plain' : 'own', opacity: 1, decay: 0, order: 0 };
}

export class Looks {
  private readonly known = signal<ReadonlyMap<string, Partial<Look>>>(new Map());
  /** A topic is drawn otherwise. */
  onChange: (topic: string) => void = () => {};

  constructor() {
    this.known.value = decode(linkPart(NAME, () => this.text) ?? recall(NAME) ?? '');
  }

  of({ topic, kind }: Pick<SensorInfo, 'topic' | 'kind'>): Look {
    return { ...firstLook(kind), ...this.known.value.get(topic) };
  }

  /** Whether it is drawn otherwise than at first. */
  isOwn(topic: string): boolean {
    return this.known.value.has(topic);
  }

  /** Change some of it; null: as at first. */
  set(topic: string, look: Partial<Look> | null): void {
    const all = new Map(this.known.peek());
    if (look === null) {
      all.delete(topic);
    } else {
      all.set(topic, { ...all.get(topic), ...look });
    }
    this.known.value = all;
    remember(NAME, this.text);
    forgetLink();
    this.onChange(topic);
  }

  /** "/scan:size.8,opacity.0.5;/points:colouring.height" */
  private get text(): string {
    const looks = [...this.known.peek()].map(([topic, look]) => {
      const values = Object.entries(look).map(([name, value]) => `${name}.${value}`);
      return `${topic}:${values.join(',')}`;
    });
    return looks.join(';');
  }
}

/** What is out of bounds, or of no name, is left out. */
function decode(text: string): Map<string, Partial<Look>> {
  const found = new Map<string, Partial<Look>>();
  for (const each of text.split(';')) {
    const [topic = '', values = ''] = each.split(':');
    const look: Partial<Look> = {};
    for (const pair of values.split(',')) {
      const [, name = '', value = ''] = /^(\w+)\.(.+)$/.exec(pair) ?? [];
      const colouring = COLOURINGS.find((one) => one === value);
      if (name === 'colouring' && colouring !== undefined) {
        look.colouring = colouring;
      } else if (name in BOUNDS) {
        const key = name as keyof typeof BOUNDS;
        look[key] = bounded(key, Number(value)) ?? firstLook('cloud')[key];
      }
    }
    if (/^\/[\w/]+$/.test(topic) && Object.keys(look).length > 0) {
      found.set(topic, look);
    }
  }
  return found;
}

/** A number within its bounds; null: it is none. */
export function bounded(name: keyof typeof BOUNDS, value: number): number | null {
  const [least, most] = BOUNDS[name];
  return Number.isFinite(value) ? Math.min(most, Math.max(least, value)) : null;
}
