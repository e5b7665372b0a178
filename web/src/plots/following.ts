// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Has the fields that are plotted come, and keeps what comes, or what is made of it. */
import type { Names } from '../channels';
import { nameOf, type Field } from './field';
import { make } from './making';
import type { Recorder } from './recorder';

/** Numbers of the messages of a topic; see channels.ts. */
export interface FieldFeed {
  plot(
    topic: string,
    path: string,
    follower: {
      take(batch: { stamps: Float64Array; values: Float64Array; lost: number; names: Names }): void;
      fail(reason: string): void;
    },
  ): () => void;
}

interface Followed {
  end: () => void;
  faults: Map<string, string>; // why there are none, by what is followed for it
  names: Names | undefined;
}

export class Following {
  private readonly followed = new Map<string, Followed>();

  constructor(
    private readonly feed: FieldFeed,
    private readonly recorder: Recorder,
  ) {}

  /** These fields are plotted now, and no others. */
  follow(fields: readonly Field[]): void {
    const wanted = new Set(fields.map(nameOf));
    for (const [name, { end }] of [...this.followed]) {
      if (!wanted.has(name)) {
        end();
        this.followed.delete(name);
      }
    }
    for (const field of fields) {
      if (!this.followed.has(nameOf(field))) {
        this.begin(field);
      }
    }
    this.recorder.keepFields(fields);
  }

  /** The names of the values of a state; null: it is none, or what is made of one; undefined: nothing has come. */
  namesOf(field: Field): Names | null | undefined {
    const names = this.followed.get(nameOf(field))?.names;
    return names === undefined || (field.steps === undefined && Object.keys(names).length > 0) ? names : null;
  }

  /** Why there are no numbers of a field, in one line; null: none was said. */
  faultOf(field: Field): string | null {
    const [fault = null] = this.followed.get(nameOf(field))?.faults.values() ?? [];
    return fault;
  }

  private begin(field: Field): void {
    const ends: (() => void)[] = [];
    const followed: Followed = { end: () => ends.forEach((end) => end()), faults: new Map(), names: undefined };
    const follow = ({ topic, path }: Field, take: (time: number, value: number) => void): void => {
      const name = nameOf({ topic, path });
      let before: Names = {};
      const end = this.feed.plot(topic, path, {
        take: ({ stamps, values, lost, names }) => {
          followed.faults.delete(name);
          if (Object.entries(before).some(([value, was]) => was !== (names[value] ?? was))) {
            this.recorder.forget(field); // another node has come, and numbers its texts otherwise
          }
          followed.names = before = names;
          const [first] = stamps;
          if (lost > 0 && first !== undefined) {
            take(first, Number.NaN); // no line over what never came
          }
          for (const [index, stamp] of stamps.entries()) {
            take(stamp, values[index] ?? Number.NaN);
          }
        },
        fail: (reason) => {
          followed.faults.set(name, reason);
        },
      });
      ends.push(end);
    };
    follow(field, make(field, (time, value) => this.recorder.take(field, time, value), follow));
    this.followed.set(nameOf(field), followed);
  }
}
