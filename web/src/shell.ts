// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Where the parts stand: on a desk the plots below the view and the panels beside it; on a phone
 * the view, the driving below it, and the rest in a sheet that slides up.
 */
import type { App, Panel } from './app';
import { button, h } from './dom';
import { recall, remember } from './remember';
import type { State } from './state';
import type { Tabs } from './tabs';

const PHONE = '(max-width: 760px)';

interface Parts {
  view: { element: HTMLElement };
  drive: Panel;
  plots: Panel;
  tabs: Tabs;
}

export interface Shell {
  openPanels(): void;
  pulse(state: State): void;
}

export function arrange({ store }: App, { view, drive, plots, tabs }: Parts): Shell {
  const dock = h('div', { class: 'dock' });
  const close = button('', () => setSheet(false), { icon: 'close', title: 'Close the panels' });
  const head = h('div', { class: 'sheet-head' }, h('h2', {}, 'Panels'), close);
  const sheet = h('aside', { class: 'sheet', 'aria-label': 'Panels' }, head, tabs.element);
  const slot: Panel = { id: 'plots', title: 'Plots', element: h('div', { class: 'plots-slot' }) };
  drive.element.id = 'drive';
  drive.element.tabIndex = -1; // where "Skip to driving" leads
  tabs.add(slot);
  document.body.append(view.element, dock, drive.element, sheet);

  const phone = window.matchMedia(PHONE);
  const fold = button('', () => setFolded(!dock.classList.contains('folded')), { kind: 'quiet' });
  plots.element.querySelector('.plot-tools')?.append(fold);

  function setFolded(folded: boolean): void {
    dock.classList.toggle('folded', folded);
    document.body.classList.toggle('folded', folded);
    fold.textContent = folded ? 'Show' : 'Hide';
    fold.setAttribute('aria-expanded', String(!folded));
    remember('folded', folded ? 'yes' : 'no');
  }

  function setSheet(open: boolean): void {
    sheet.dataset.sheet = open ? 'open' : 'closed';
    sheet.inert = phone.matches && !open;
    if (open) {
      close.focus();
    }
  }

  function settle(): void {
    (phone.matches ? slot.element : dock).append(plots.element);
    tabs.setHidden('plots', !phone.matches);
    setSheet(false);
  }

  // A description to look at, as in RViz, has no velocity: the place is for its joints.
  store.watch(['graph', 'robot', 'controllers'], () => {
    const { robot, movedJoints } = store;
    const moves = robot === null || robot.command !== null || robot.odometry !== null;
    document.body.classList.toggle('still', !moves);
    document.body.classList.toggle('armed', movedJoints.size > 0); // its joints want a STOP
    if (robot?.joint_publisher != null || (!moves && movedJoints.size > 0)) {
      tabs.suggest('joints');
    }
  });
  phone.addEventListener('change', settle);
  setFolded(recall('folded') === 'yes');
  settle();
  return {
    openPanels: () => setSheet(sheet.dataset.sheet !== 'open'),
    pulse: (state) => {
      if (plots.element.querySelector('.charts')?.checkVisibility() === true) {
        plots.pulse?.(state);
      }
    },
  };
}
