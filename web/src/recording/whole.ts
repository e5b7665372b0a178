// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** All of a recording at once: its states for plots and trails, and numbers of its messages. */
import type { App } from '../app';
import type { FieldFeed } from '../plots/following';
import type { Layout, OverviewData, SeriesData } from '../protocol';
import { decodeState, stateBytes, type State } from '../state';

/** Has the states of the whole recording come, each time that another one is shown. */
export class WholeRecording {
  private overview: OverviewData | null = null;

  /** `take`: called with the states, in the order of time. */
  constructor(
    private readonly app: Pick<App, 'store' | 'connection'>,
    private readonly take: (states: readonly State[]) => void,
  ) {
    const { store } = app;
    store.watch(['recording'], () => {
      this.overview = null;
      if (store.recording !== null) {
        void this.ask();
      }
    });
    store.watch(['layout'], () => this.settle());
  }

  private async ask(): Promise<void> {
    const { store } = this.app;
    const { recording } = store;
    const { ok, message, data } = await this.app.connection.request({ type: 'overview' });
    if (recording !== store.recording) {
      return;
    }
    if (ok) {
      this.overview = data as OverviewData;
      this.settle();
    } else {
      store.note('error', `No plots and trails of the whole recording: ${message}`);
    }
  }

  /** Read them, as soon as robots are drawn, whatever the frames of the time that is shown. */
  private settle(): void {
    const { overview } = this;
    if (overview === null || this.app.store.layout === null) {
      return;
    }
    this.overview = null;
    const { frames, robots } = overview;
    const layout: Layout = { type: 'layout', id: overview.layout, frames, robots };
    const bytes = bytesOf(overview.states);
    const size = stateBytes(layout);
    const states: State[] = [];
    for (let at = 0; at + size <= bytes.byteLength; at += size) {
      const state = decodeState(bytes.slice(at, at + size), layout);
      if (state !== null) {
        states.push(state);
      }
    }
    this.take(states);
  }
}

/** Plotted fields of a recording: all of their numbers come at once. */
export function seriesFeed({ connection }: Pick<App, 'connection'>): FieldFeed {
  return {
    plot: (topic, path, follower) => {
      let isWanted = true;
      void connection.request({ type: 'series', topic, path }).then(({ ok, message, data }) => {
        if (isWanted && ok) {
          const { stamps, values, names } = data as SeriesData;
          const numbers = { stamps: numbersOf(stamps), values: numbersOf(values) };
          follower.take({ ...numbers, lost: 0, names });
        } else if (isWanted) {
          follower.fail(message);
        }
      });
      return () => {
        isWanted = false;
      };
    },
  };
}

function numbersOf(text: string): Float64Array {
  return new Float64Array(bytesOf(text));
}

function bytesOf(text: string): ArrayBuffer {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
}
