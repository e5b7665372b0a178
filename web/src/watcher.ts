// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Tells the node what this page shows of what is collected on demand, while it can be seen. */
import { MOST_TOPICS, type Part, type Watch } from './protocol';

/** What is shown of what is collected on demand, see Watch. */
export interface Shown {
  parts: Iterable<Part>;
  topics?: Iterable<string>; // of sensors
  messages?: Iterable<string>;
  fields?: Readonly<Record<string, readonly string[]>>;
  whole?: Iterable<string>; // topics of clouds
}

const NOTHING = JSON.stringify(watchOf({ parts: [] }));

export class Watcher {
  private told = NOTHING; // what the node knows of this connection

  /**
   * `send`: returns whether the message could be sent; `isSeen`: whether the page can be seen at
   * all, and is not behind other tabs.
   */
  constructor(
    private readonly send: (message: Watch) => boolean,
    private readonly isSeen: () => boolean = () => true,
  ) {}

  /** A connection has ended: of the next one, the node will know nothing. */
  forget(): void {
    this.told = NOTHING;
  }

  /**
   * This is shown now. To be called often: only what has changed is told. Plots go on while the
   * page cannot be seen: they would have gaps.
   */
  show(shown: Shown): void {
    const message = watchOf(this.isSeen() ? shown : { parts: [], fields: shown.fields ?? {} });
    const now = JSON.stringify(message);
    if (now !== this.told && this.send(message)) {
      this.told = now;
    }
  }
}

function watchOf({ parts, topics = [], messages = [], fields = {}, whole = [] }: Shown): Watch {
  const pairs = sorted(Object.keys(fields)).map((topic) => [topic, sorted(fields[topic] ?? [])]);
  return {
    type: 'watch',
    parts: sorted(parts),
    topics: sorted(topics).slice(0, MOST_TOPICS),
    messages: sorted(messages).slice(0, MOST_TOPICS),
    fields: Object.fromEntries(pairs.slice(0, MOST_TOPICS)) as Record<string, string[]>,
    whole: sorted(whole).slice(0, MOST_TOPICS),
  };
}

function sorted<T extends string>(shown: Iterable<T>): T[] {
  return [...new Set(shown)].sort();
}
