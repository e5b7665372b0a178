// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Which sensors the page shows, and the latest sample of each. */
import { signal } from '@preact/signals';
import type { SensorInfo } from '../protocol';
import { recall, remember } from '../remember';
import type { Sample } from '../samples';
import type { Store } from '../store';
import { Looks } from './looks';

/**
 * Shown until the user says otherwise: a scan is small, and what a mobile robot is about; of maps and
 * paths those that it is driven by; what somebody draws is drawn to be seen.
 */
function isShownAtFirst({ topic, kind }: SensorInfo): boolean {
  return kind === 'scan' || kind === 'markers' || kind === 'point' || (kind === 'map' && topic.endsWith('/map')) || (kind === 'path' && topic.endsWith('/plan'));
}

export class Sensing {
  /** The latest samples, by topic, of those that are on. */
  readonly latest = new Map<string, Sample>();
  /** How they are drawn. */
  readonly looks = new Looks();
  private readonly switches = signal(0); // how often one was flipped
  /** What is on, or there is, has changed. */
  onChange: () => void = () => {};

  constructor(private readonly store: Store) {
    store.watch(['graph', 'robot'], () => this.settle());
    store.watch(['reset'], () => {
      for (const [topic, { head }] of [...this.latest]) {
        if (head.type !== 'map') { // others are of a time that has not come yet
          this.latest.delete(topic);
        }
      }
      this.onChange();
    });
  }

  /** The sensors of the robot that the panels show, and maps that are nobody's own. */
  get here(): readonly SensorInfo[] {
    const { graph, robot } = this.store;
    return (graph?.sensors ?? []).filter((each) => each.robot === robot?.id || each.robot === '');
  }

  isOn(info: SensorInfo): boolean {
    void this.switches.value; // who shows it follows
    const kept = recall(`sensor.${info.topic}`);
    return kept === null ? isShownAtFirst(info) : kept === 'yes';
  }

  set(topic: string, on: boolean): void {
    remember(`sensor.${topic}`, on ? 'yes' : 'no');
    this.switches.value += 1;
    this.settle();
  }

  /** Whether all points of a cloud are shown, not only as many as are drawn quickly. */
  isWhole({ topic }: SensorInfo): boolean {
    void this.switches.value;
    return recall(`whole.${topic}`) === 'yes';
  }

  setWhole(topic: string, on: boolean): void {
    remember(`whole.${topic}`, on ? 'yes' : 'no');
    this.switches.value += 1;
  }

  /** The topics of clouds that are shown whole. */
  get whole(): readonly string[] {
    return this.shown.filter((each) => each.kind === 'cloud' && this.isWhole(each)).map(({ topic }) => topic);
  }

  /** Those that are on. */
  get shown(): readonly SensorInfo[] {
    return this.here.filter((each) => this.isOn(each));
  }

  /** … of which something is drawn in the scene. */
  get inScene(): readonly SensorInfo[] {
    return this.shown.filter(({ kind }) => kind !== 'picture');
  }

  /** Take in a sample. Returns its sensor; null: it is shown no more. */
  take(sample: Sample): SensorInfo | null {
    const { topic } = sample.head.origin;
    const info = this.shown.find((each) => each.topic === topic) ?? null;
    if (info !== null) {
      this.latest.set(topic, sample);
    }
    return info;
  }

  /** Forget the samples of what is not shown any more. */
  private settle(): void {
    const shown = new Set(this.shown.map(({ topic }) => topic));
    for (const topic of [...this.latest.keys()]) {
      if (!shown.has(topic)) {
        this.latest.delete(topic);
      }
    }
    this.onChange();
  }
}
