// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Any topic, by the wishes of whoever shows it: its latest message whole, or numbers of each
 * message. What is wished here is what the node is told (see Watch), and nothing else comes.
 */
import type { AnyMessage, Values } from './protocol';
import { messageOf, valuesOf, type Sample, type Tree } from './samples';

/** The latest message of a topic; or why there is none. */
export interface TopicMessage {
  head: AnyMessage;
  tree: Tree;
}

export interface MessageFollower {
  take(message: TopicMessage): void;
  /** It cannot be shown, such as of a type that is not installed where the node runs. */
  fail(reason: string): void;
}

/** Numbers of the messages that came, by their stamps (s); in the order in which they came. */
export interface FieldBatch {
  stamps: Float64Array;
  values: Float64Array; // NaN: the message has no such element
  lost: number; // messages before these that never came
  rate: number | null; // messages per second of the topic
  names: Names; // of the values of a state
}

/** The names of values of a state, by the values as texts; none: it is a number. */
export type Names = Readonly<Record<string, string>>;

export interface FieldFollower {
  take(batch: FieldBatch): void;
  /** There are no numbers: no such path, a type that is not installed … Said again and again. */
  fail(reason: string): void;
}

export class Channels {
  private readonly shown = new Map<string, Set<MessageFollower>>(); // by topic
  private readonly plotted = new Map<string, Map<string, Set<FieldFollower>>>(); // by topic and path
  private readonly next = new Map<string, number>(); // by topic: the number of the next message

  /** The topics of which messages are wished. */
  get messages(): string[] {
    return [...this.shown.keys()];
  }

  /** By topic, the paths of which numbers are wished. */
  get fields(): Record<string, string[]> {
    return Object.fromEntries([...this.plotted].map(([topic, paths]) => [topic, [...paths.keys()]]));
  }

  /** Follow the messages of a topic, at most ten a second; returns what ends that. */
  follow(topic: string, follower: MessageFollower): () => void {
    const followers = this.shown.get(topic) ?? new Set();
    this.shown.set(topic, followers.add(follower));
    return () => {
      followers.delete(follower);
      if (followers.size === 0 && this.shown.get(topic) === followers) {
        this.shown.delete(topic);
      }
    };
  }

  /**
   * Follow a number of each message of a topic, at a path as `ros2 topic echo --field` has it:
   * `twist.twist.linear.x`, `position[2]`. Returns what ends that.
   */
  plot(topic: string, path: string, follower: FieldFollower): () => void {
    const paths = this.plotted.get(topic) ?? new Map<string, Set<FieldFollower>>();
    const followers = paths.get(path) ?? new Set();
    this.plotted.set(topic, paths.set(path, followers.add(follower)));
    return () => {
      followers.delete(follower);
      if (followers.size === 0 && paths.get(path) === followers) {
        paths.delete(path);
      }
      if (paths.size === 0 && this.plotted.get(topic) === paths) {
        this.plotted.delete(topic);
        this.next.delete(topic);
      }
    };
  }

  /** A connection has ended: the next node counts anew. */
  forget(): void {
    this.next.clear();
  }

  /** Hand a sample to those who follow its topic; returns whether it is one of these. */
  take(sample: Sample): boolean {
    const { head } = sample;
    switch (head.type) {
      case 'message': {
        const message = { head, tree: messageOf(sample) };
        this.shown.get(head.origin.topic)?.forEach((each) => each.take(message));
        return true;
      }
      case 'values':
        this.takeValues(sample as Sample<Values>);
        return true;
      case 'unreadable':
        return this.fail(head.origin.topic, head.channel, head.text);
      default:
        return false;
    }
  }

  private takeValues(sample: Sample<Values>): void {
    const { head } = sample;
    const { topic, rate } = head.origin;
    const plotted = this.plotted.get(topic);
    if (plotted === undefined) {
      return; // it was on its way when the last wish ended
    }
    const lost = Math.max(0, head.first - (this.next.get(topic) ?? head.first));
    this.next.set(topic, head.first + head.count);
    const { stamps, columns } = valuesOf(sample);
    for (const [path, followers] of plotted) {
      const values = columns.get(path); // undefined: a wish of which the node does not know yet
      const fault = head.faults[path];
      for (const each of followers) {
        if (fault !== undefined) {
          each.fail(fault);
        } else if (values !== undefined) {
          each.take({ stamps, values, lost, rate, names: head.names[path] ?? {} });
        }
      }
    }
  }

  private fail(topic: string, channel: string, reason: string): boolean {
    if (channel === 'message') {
      this.shown.get(topic)?.forEach((each) => each.fail(reason));
    } else if (channel === 'values') {
      for (const followers of this.plotted.get(topic)?.values() ?? []) {
        followers.forEach((each) => each.fail(reason));
      }
    }
    return channel !== 'sensor';
  }
}
