// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Says what happened: to the eye for some seconds, to a screen reader in a live region. */
import { ask, type App } from './app';
import type { NoticeEntry } from './store';
import { button, h, setText } from './dom';

const SHOWN = { info: 5000, warning: 9000, error: 12000 } as const; // ms
const MOST = 3;

export function announce(app: App): HTMLElement {
  const { store } = app;
  const live = h('div', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
  const toasts = h('div', { class: 'toasts' });
  let announced = store.notices[0];

  store.watch(['notice'], () => {
    const [latest] = store.notices;
    if (latest !== undefined && latest !== announced) {
      announced = latest;
      if (latest.count > 1) {
        toasts.firstElementChild?.remove();
      }
      toasts.prepend(toast(app, latest));
      setText(live, latest.text);
      while (toasts.childElementCount > MOST) {
        toasts.lastElementChild?.remove();
      }
    }
  });
  store.watch(['link'], () => {
    const words = { connecting: '', open: 'Connected.', waiting: 'The connection was lost.' };
    setText(live, words[store.link.state]);
  });
  store.watch(['driver', 'robot'], () => {
    const { driver } = store;
    setText(live, driver === null ? '' : driver.me ? 'You drive.' : `${driver.name} drives.`);
  });
  return h('div', { class: 'announce' }, live, toasts);
}

/** What can be tried again stays until that is done, or it is dismissed. */
function toast(app: App, { level, text, again }: NoticeEntry): HTMLElement {
  const element = h('div', { class: 'toast', 'data-tone': level }, h('p', {}, text));
  const remove = (): void => element.remove();
  if (again === null) {
    setTimeout(remove, SHOWN[level]);
  } else {
    const tryAgain = (): void => {
      remove();
      void ask(app, again);
    };
    element.append(button('Try again', tryAgain));
  }
  element.append(button('', remove, { icon: 'close', kind: 'quiet', title: 'Dismiss' }));
  return element;
}
