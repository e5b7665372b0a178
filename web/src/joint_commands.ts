// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Where hands want the joints of a robot, sent no faster than it can be taken. */
import { signal } from '@preact/signals';
import type { App } from './app';

const HELD = 1500; // ms: how long a joint is shown where a hand has put it
const LEAST_GAP = 50; // ms between two positions for a controller

/** Where a hand has put a joint, rad or m, and when, ms. */
interface Put {
  position: number;
  at: number;
}

export class JointCommands {
  private readonly puts = signal<ReadonlyMap<string, Put>>(new Map());
  private wanted: Record<string, number> = {};
  private isSending = false;
  private sentAt = -Infinity; // ms

  constructor(
    private readonly app: App,
    readonly robot: string,
  ) {}

  /**
   * Where a joint is to be shown; null: where it is measured. A key on a slider is not overruled
   * by what comes back while the robot is on its way.
   */
  shown(joint: string): number | null {
    const put = this.puts.value.get(joint);
    const isFresh = put !== undefined && performance.now() - put.at < (this.isDirect ? 0 : HELD);
    return isFresh || this.isSending ? (put?.position ?? null) : null;
  }

  /** Send positions with the next frame of the screen, and others that come until then. */
  move(positions: Readonly<Record<string, number>>): void {
    const at = performance.now();
    const puts = Object.entries(positions).map(([joint, position]) => [joint, { position, at }] as const);
    this.puts.value = new Map([...this.puts.value, ...puts]);
    this.wanted = { ...this.wanted, ...positions };
    if (!this.isSending) {
      this.isSending = true;
      const wait = this.isDirect ? 0 : this.sentAt + LEAST_GAP - at;
      setTimeout(() => requestAnimationFrame(() => this.send()), Math.max(0, wait));
    }
  }

  /** Whether what is sent is what is published: there is no robot on its way to it. */
  private get isDirect(): boolean {
    const info = this.app.store.robots.find(({ id }) => id === this.robot);
    return info !== undefined && info.joint_publisher !== null;
  }

  private send(): void {
    this.isSending = false;
    this.sentAt = performance.now();
    const positions = this.wanted;
    this.wanted = {};
    this.app.connection.send({ type: 'set_joints', robot: this.robot, positions });
  }
}
