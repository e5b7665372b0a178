// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What may be plotted, for who types: topics by their names, and the numbers in their messages. */
import { signal } from '@preact/signals';
import type { App } from '../app';
import type { FieldInfo, TopicInfo } from '../protocol';
import { nameOf } from './field';

const FEW = 6; // topics of which the fields are offered
const MOST = 40; // names that are offered
const MOST_PATHS = 200; // of a message

export class Offers {
  private readonly paths = signal<ReadonlyMap<string, readonly string[]>>(new Map()); // by type
  private readonly asked = new Set<string>(); // types

  constructor(private readonly app: Pick<App, 'store' | 'connection'>) {}

  /** Ask what the messages of the topics have that a text may mean, where these are few. */
  look(text: string): void {
    const meant = this.meant(text);
    for (const kind of meant.length > FEW ? [] : meant.flatMap(({ kinds }) => kinds.slice(0, 1))) {
      if (!this.asked.has(kind)) {
        this.asked.add(kind);
        void this.ask(kind);
      }
    }
  }

  /** Names that have all words of a text: of fields as far as these are known, else of topics. */
  of(text: string): string[] {
    const words = wordsOf(text);
    return this.meant(text)
      .flatMap(({ name: topic, kinds: [kind = ''] }) => {
        const paths = this.paths.value.get(kind);
        return paths === undefined ? [topic] : paths.map((path) => nameOf({ topic, path }));
      })
      .filter((name) => words.every((word, index) => index === 0 || has(name, word)))
      .slice(0, MOST);
  }

  /** The topics in whose names the first word is; the one that is it, alone. */
  private meant(text: string): readonly TopicInfo[] {
    const [first = ''] = wordsOf(text);
    const topics = this.app.store.topics?.topics ?? [];
    const exact = topics.filter(({ name }) => name === first);
    return exact.length > 0 ? exact : topics.filter(({ name }) => has(name, first));
  }

  private async ask(kind: string): Promise<void> {
    const { ok, data } = await this.app.connection.request({ type: 'definition', message: kind });
    if (ok) {
      const paths = leavesOf(data as FieldInfo[], '').slice(0, MOST_PATHS);
      this.paths.value = new Map(this.paths.value).set(kind, paths);
    } else {
      this.asked.delete(kind); // such as without a connection: the next key asks again
    }
  }
}

function wordsOf(text: string): string[] {
  return text.trim().split(/[\s:]+/);
}

function has(name: string, word: string): boolean {
  return name.toLowerCase().includes(word.toLowerCase());
}

/** The paths of all numbers and strings; of arrays, those of the first element. */
function leavesOf(fields: readonly FieldInfo[], before: string): string[] {
  return fields.flatMap(({ name, kind, length, fields: inner }) => {
    const path = `${before}${name}${length === null ? '' : '[0]'}`;
    if (inner.length > 0) {
      return leavesOf(inner, `${path}.`);
    }
    return kind.includes('/') || kind === 'wstring' ? [] : [path];
  });
}
