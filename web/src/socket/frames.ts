// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The binary frames that wait until the page can take them: the newest state, the newest sample of
 * each topic, and all plotted values, up to a bound. A page that draws slowly is never given what is
 * old; of values it would miss some, and the oldest are left out only when there are too many.
 */
import { channelOf, decodeHead, isSample } from '../samples';
import { BadState } from '../state';

const MOST_VALUES = 8 * 1024 * 1024; // bytes: 10 fields at 1 kHz for a minute and a half

export class WaitingFrames {
  private readonly waiting = new Map<string, ArrayBuffer>();
  private values: ArrayBuffer[] = [];
  private size = 0; // of the values, bytes
  private isBusy = false;

  /** `send` is given frames, one call at a time: the next comes after {@link taken}. */
  constructor(private readonly send: (frames: ArrayBuffer[]) => void) {}

  add(frame: ArrayBuffer): void {
    const key = isSample(frame) ? keyOf(frame) : '';
    if (key === null) {
      this.keep(frame);
    } else {
      this.waiting.set(key, frame);
    }
    this.flush();
  }

  /** The page has dealt with the last frames. */
  taken(): void {
    this.isBusy = false;
    this.flush();
  }

  private keep(values: ArrayBuffer): void {
    this.values.push(values);
    this.size += values.byteLength;
    while (this.size > MOST_VALUES) {
      this.size -= this.values.shift()?.byteLength ?? 0;
    }
  }

  private flush(): void {
    if (!this.isBusy && this.waiting.size + this.values.length > 0) {
      this.isBusy = true;
      const frames = [...this.waiting.values(), ...this.values];
      this.waiting.clear();
      this.values = [];
      this.size = 0;
      this.send(frames);
    }
  }
}

/** What a sample replaces, null: nothing; one that cannot be read is let through, for the page to say so. */
function keyOf(frame: ArrayBuffer): string | null {
  try {
    const { head } = decodeHead(frame);
    return head.type === 'values' ? null : `${channelOf(head)} ${head.origin.topic}`;
  } catch (error) {
    if (error instanceof BadState) {
      return 'unreadable';
    }
    throw error;
  }
}
