// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What every part of the page is given, and what a part is. */
import type { Channels } from './channels';
import type { Asked, Connection } from './connection';
import type { Pilot } from './drive/pilot';
import type { Part } from './protocol';
import type { State } from './state';
import type { Store } from './store';

export interface App {
  store: Store;
  connection: Connection;
  pilot: Pilot;
  channels: Channels;
}

/** A part of the page with a title; it gets states only while it is visible. */
export interface Panel {
  readonly id: string;
  readonly title: string;
  readonly element: HTMLElement;
  /** What it shows of the states, of those parts that come only on demand. */
  readonly watches?: readonly Part[];
  /** The topics of sensors that it shows. */
  readonly topics?: readonly string[];
  /** Show the numbers of a state; called ten times a second. */
  pulse?(state: State): void;
}

const WORTH_SAYING: ReadonlySet<Asked['type']> = new Set(['spawn', 'set_up', 'delete', 'stop_recording']);

/**
 * Ask the node. A no becomes a notice, and so does a yes to what cannot be seen at once.
 * Returns whether it was done.
 */
export async function ask(app: App, asked: Asked): Promise<boolean> {
  const { ok, message, again, data } = await app.connection.request(asked);
  const isWarned = asked.type === 'place' && data === true;
  if (!ok || isWarned || WORTH_SAYING.has(asked.type)) {
    app.store.note(!ok ? 'error' : isWarned ? 'warning' : 'info', message, again as Asked | null);
  }
  return ok;
}
