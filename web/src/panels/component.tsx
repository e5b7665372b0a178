// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Panels that are Preact components: what they read of the store, and of the state, is followed. */
import { signal, type ReadonlySignal } from '@preact/signals';
import { render, type FunctionComponent } from 'preact';
import type { App, Panel } from '../app';
import { h } from '../dom';
import type { State } from '../state';

export interface PanelProps {
  app: App;
  /** The latest state, ten times a second while the panel can be seen; null: none came yet. */
  state: ReadonlySignal<State | null>;
}

interface About {
  id: string;
  title: string;
  /** What it shows of the states, of those parts that come only on demand. */
  watches?: Panel['watches'] | (() => Panel['watches']);
  /** The topics that it shows now; asked ten times a second. */
  topics?: () => readonly string[];
}

/** The panel of a component. */
export function panelOf(app: App, about: About, Body: FunctionComponent<PanelProps>): Panel {
  const element = h('div', {});
  const state = signal<State | null>(null);
  render(<Body app={app} state={state} />, element);
  return {
    id: about.id,
    title: about.title,
    element,
    get watches() {
      return (typeof about.watches === 'function' ? about.watches() : about.watches) ?? [];
    },
    get topics() {
      return about.topics?.() ?? [];
    },
    pulse: (latest) => {
      // Another object also where no newer state has come: a sample, which no signal follows, has.
      state.value = latest === state.peek() ? { ...latest } : latest;
    },
  };
}
