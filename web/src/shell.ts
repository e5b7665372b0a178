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
import type { Workspace } from './workspace';

interface Parts {
  view: { element: HTMLElement };
  drive: Panel;
  plots: Panel;
  tabs: Tabs;
  workspace: Workspace;
}

export interface Shell {
  openPanels: () => void;
  /** Have all parts stand where they stand at first. */
  reset: () => void;
  pulse(state: State): void;
}

export function arrange({ store }: App, { view, drive, plots, tabs, workspace }: Parts): Shell {
  const { body } = document;
  const dock = h('div', { class: 'dock' });
  const bars = {
    dock: splitter({
      name: 'dock', label: 'Height of the plots', part: () => tabs.at('below') ?? dock,
      least: 0.12, most: 0.75, usual: 0.3,
    }),
    side: splitter({
      name: 'side', label: 'Width of the column', part: () => driving, beside: true,
      least: 0.2, most: 0.6, usual: 0.3,
    }),
    beside: splitter({
      name: 'beside', label: 'Width beside the scene', part: () => tabs.at('beside'), beside: true,
      least: 0.15, most: 0.7, usual: 0.36,
    }),
  };
  const close = button('', () => setSheet(false), { icon: 'close', title: 'Close the panels' });
  const grow = button('', () => setLarge(!body.classList.contains('large')), { icon: 'range', title: 'Large panels' });
  const head = h('div', { class: 'sheet-head' }, grow, close);
  const title = h('h2', { class: 'unseen' }, 'Panels');
  const sheet = h('aside', { class: 'sheet', 'aria-label': 'Panels' }, title, head, tabs.element);
  const slot: Panel = { id: 'plots', title: 'Plots', element: h('div', { class: 'plots-slot' }) };
  drive.element.id = 'drive';
  drive.element.tabIndex = -1; // where "Skip to driving" leads
  const driving = h('div', { class: 'driving' }, drive.element);
  tabs.add(slot);
  bars.side.element.classList.add('of-column');
  bars.beside.element.classList.add('of-beside');
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

  /** Off a desk the panels take all of the room but that of the robot in small, and of STOP. */
  function setLarge(large: boolean): void {
    body.classList.toggle('large', large);
    grow.setAttribute('aria-pressed', String(large));
    remember('large', large ? 'yes' : 'no');
  }

  function setSheet(open: boolean): void {
    const wasFocused = sheet.contains(document.activeElement);
    body.dataset.sheet = open ? 'open' : 'closed';
    sheet.dataset.sheet = open ? 'open' : 'closed';
    sheet.inert = !open;
    tabs.arrange(); // the chosen tab comes into sight
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
    tabs.stand(now === 'desk');
    setSheet(opensPanels(width, height));
  }

  /** Plots stand under the scene where nothing else does; each part has its bar. */
  function standPlots(): void {
    const [beside, below] = [tabs.at('beside') !== null, tabs.at('below') !== null];
    const isDocked = form === 'desk' && !below && workspace.placeOf('plots') === null;
    const place = isDocked ? dock : slot.element;
    if (plots.element.parentElement !== place) {
      place.append(plots.element);
      tabs.setHidden('plots', isDocked);
    }
    body.classList.toggle('beside', beside);
    body.classList.toggle('below', below);
    body.classList.toggle('undocked', form === 'desk' && !below && !isDocked);
    const wanted = [
      [bars.dock.element, isDocked ? plots.element : sheet, isDocked || below], // in the landmark that it is of
      [bars.side.element, sheet, form === 'desk'],
      [bars.beside.element, sheet, beside],
    ] as const;
    for (const [bar, parent, isThere] of wanted) {
      if (isThere && bar.parentElement !== parent) {
        parent.prepend(bar);
      } else if (!isThere) {
        bar.remove();
      }
    }
  }

  store.watch(['graph', 'robot', 'controllers', 'simulation', 'recording'], () => {
    const { robot, recording, movedJoints, simulator, simulation } = store;
    body.classList.toggle('still', isStill(store));
    body.classList.toggle('armed', movedJoints.size > 0); // its joints want a STOP
    body.classList.toggle('paused', simulation?.state === 'paused');
    tabs.setHidden('simulation', robot !== null && simulator === null);
    tabs.setHidden('control', robot !== null && robot.manager === null);
    for (const id of ['health', 'services', 'parameters', 'graph']) {
      tabs.setHidden(id, recording !== null); // nodes are not in a bag
    }
    if (robot !== null) {
      const isNew = tabs.setKind(kindOf(store), hasSliders(store) ? 'joints' : 'model');
      if (isNew && hasSliders(store)) {
        setSheet(true); // sliders are what one has come for
      }
    }
  });
  tabs.onStand = standPlots;
  window.addEventListener('resize', settle);
  setFolded(recall('folded') === 'yes');
  setLarge(recall('large') === 'yes');
  settle();
  return {
    reset: () => {
      setFolded(false);
      setLarge(false);
      Object.values(bars).forEach(({ reset }) => reset());
      workspace.reset();
    },
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
