// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Which robot was chosen, over a reload of the page: for each ROS domain, in this browser. */
import { recall, remember } from './remember';
import type { Store } from './store';

/** Choose what was chosen before, and keep what will be. */
export function keepChoice(store: Store): void {
  const name = (): string | null => (store.hello === null ? null : `robot.${store.hello.domain}`);
  store.watch(['hello'], () => {
    const at = name();
    const before = at === null ? null : recall(at);
    if (store.chosen === null && before !== null) {
      store.choose(before);
    }
  });
  store.watch(['robot'], () => {
    const at = name();
    if (at !== null && store.chosen !== null) {
      remember(at, store.chosen);
    }
  });
}
