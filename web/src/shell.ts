// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Puts the parts of the page where its form (see form.ts) has them. */
import type { App, Panel } from './app';
import { button, h } from './dom';
import { formOf, opensPanels, type Form } from './form';
import { recall, remember } from './remember';
import { splitter } from './splitter';
import type { State } from './state';
import type { Store } from './store';
import type { Tabs } from './tabs';

interface Parts {
  view: { element: HTMLElement };
  drive: Panel;
  plots: Panel;
  tabs: Tabs;
}

export interface Shell {
  openPanels: () => void;
  pulse(state: State): void;
}

export function arrange({ store }: App, { view, drive, plots, tabs }: Parts): Shell {
  const { body } = document;
  const dock = h('div', { class: 'dock' });
  const bar = splitter('dock', 'Height of the plots');
  const close = button('', () => setSheet(false), { icon: 'close', title: 'Close the panels' });
  const head = h('div', { class: 'sheet-head' }, close);
  const title = h('h2', { class: 'unseen' }, 'Panels');
  const sheet = h('aside', { class: 'sheet', 'aria-label': 'Panels' }, title, head, tabs.element);
  const slot: Panel = { id: 'plots', title: 'Plots', element: h('div', { class: 'plots-slot' }) };
  drive.element.id = 'drive';
  drive.element.tabIndex = -1; // where "Skip to driving" leads
  const driving = h('div', { class: 'driving' }, drive.element);
  tabs.add(slot);
  body.append(view.element, dock, driving, sheet);

  const fold = button('', () => setFolded(!dock.classList.contains('folded')), { kind: 'quiet' });
  plots.element.querySelector('.plot-tools')?.append(fold);
  let form: Form | null = null;

  function setFolded(folded: boolean): void {
    dock.classList.toggle('folded', folded);
    body.classList.toggle('folded', folded);
    fold.textContent = folded ? 'Show' : 'Hide';
    fold.setAttribute('aria-expanded', String(!folded));
    remember('folded', folded ? 'yes' : 'no');
  }

  function setSheet(open: boolean): void {
    const wasFocused = sheet.contains(document.activeElement);
    body.dataset.sheet = open ? 'open' : 'closed';
    sheet.dataset.sheet = open ? 'open' : 'closed';
    sheet.inert = !open;
    const opener = document.querySelector<HTMLElement>('.open-panels');
    opener?.setAttribute('aria-expanded', String(open));
    if (!open && wasFocused) {
      opener?.focus();
    }
  }

  function settle(): void {
    const { innerWidth: width, innerHeight: height } = window;
    const now = formOf(width, height);
    if (now === form) {
      return;
    }
    form = now;
    body.dataset.form = now;
    (now === 'desk' ? dock : slot.element).append(plots.element);
    if (now === 'desk') {
      plots.element.prepend(bar); // in it, as it belongs to that landmark
    } else {
      bar.remove();
    }
    tabs.setHidden('plots', now === 'desk');
    tabs.stand(now === 'desk' ? 'vertical' : 'horizontal');
    setSheet(opensPanels(width, height));
  }

  store.watch(['graph', 'robot', 'controllers', 'simulation', 'recording'], () => {
    const { robot, recording, movedJoints, simulator, simulation } = store;
    body.classList.toggle('still', isStill(store));
    body.classList.toggle('armed', movedJoints.size > 0); // its joints want a STOP
    body.classList.toggle('paused', simulation?.state === 'paused');
    tabs.setHidden('simulation', robot !== null && simulator === null);
    tabs.setHidden('control', robot !== null && robot.manager === null);
    for (const id of ['health', 'parameters', 'graph']) {
      tabs.setHidden(id, recording !== null); // nodes are not in a bag
    }
    if (robot !== null) {
      const isNew = tabs.setKind(kindOf(store), hasSliders(store) ? 'joints' : 'model');
      if (isNew && hasSliders(store)) {
        setSheet(true); // sliders are what one has come for
      }
    }
  });
  window.addEventListener('resize', settle);
  setFolded(recall('folded') === 'yes');
  settle();
  return {
    openPanels: () => {
      setSheet(sheet.inert);
      if (!sheet.inert) {
        close.focus();
      }
    },
    pulse: (state) => {
      if (plots.element.querySelector('.charts')?.checkVisibility() === true) {
        plots.pulse?.(state);
      }
    },
  };
}

/** A description to look at, as in RViz, has no velocity: the place is for its joints. */
function isStill({ robot }: Store): boolean {
  return robot !== null && robot.command === null && robot.odometry === null;
}

/** Whether its joints are what one moves: by joint_state_publisher, or by controllers alone. */
function hasSliders(store: Store): boolean {
  const { robot, movedJoints } = store;
  return robot?.joint_publisher != null || (isStill(store) && movedJoints.size > 0);
}

/** What one does with such a graph: the panel that was open last is remembered for each kind. */
function kindOf(store: Store): string {
  const arm = hasSliders(store) ? 'joints' : 'robot';
  return store.simulator === null ? arm : `simulated.${arm}`;
}
