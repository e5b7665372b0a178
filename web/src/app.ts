// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What every part of the page is given, and what a part is. */
import type { Asked, Connection } from './connection';
import type { Pilot } from './drive/pilot';
import type { State } from './state';
import type { Store } from './store';

export interface App {
  store: Store;
  connection: Connection;
  pilot: Pilot;
}

/** A part of the page with a title; it is told of states only while it can be seen. */
export interface Panel {
  readonly id: string;
  readonly title: string;
  readonly element: HTMLElement;
  /** Show the numbers of a state; called ten times a second. */
  pulse?(state: State): void;
}

/** Ask the node; a no becomes a notice. Returns whether it was done. */
export async function ask(app: App, asked: Asked): Promise<boolean> {
  const reply = await app.connection.request(asked);
  if (!reply.ok) {
    app.store.note('error', reply.message);
  }
  return reply.ok;
}
