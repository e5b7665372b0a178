// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Panels one at a time, chosen by tabs as in the ARIA practices: arrows move, Tab leaves. */
import type { Panel } from './app';
import { h, setText } from './dom';
import type { Part } from './protocol';
import { recall, remember } from './remember';
import type { State } from './state';

interface Tab {
  panel: Panel;
  button: HTMLButtonElement;
  badge: HTMLElement;
  body: HTMLElement;
}

export class Tabs {
  readonly element = h('div', { class: 'panels' });
  private readonly list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Panels' });
  private readonly tabs: Tab[] = [];
  private active: Tab | null = null;

  constructor(private readonly name: string) {
    this.element.append(this.list);
    this.list.addEventListener('keydown', (event) => this.move(event));
  }

  add(panel: Panel): void {
    const badge = h('span', { class: 'badge', hidden: true });
    const button = h(
      'button',
      {
        type: 'button',
        role: 'tab',
        id: `tab-${panel.id}`,
        'aria-controls': `panel-${panel.id}`,
        onclick: () => this.show(panel.id),
      },
      h('span', {}, panel.title),
      badge,
    );
    const body = h(
      'div',
      {
        class: 'panel',
        role: 'tabpanel',
        id: `panel-${panel.id}`,
        'aria-labelledby': `tab-${panel.id}`,
        tabindex: 0,
        hidden: true,
      },
      panel.element,
    );
    this.tabs.push({ panel, button, badge, body });
    this.list.append(button);
    this.element.append(body);
    this.show(recall(this.name) ?? this.tabs[0].panel.id, false);
  }

  /** A tab that is not wanted now, such as one whose content stands elsewhere. */
  setHidden(id: string, hidden: boolean): void {
    const tab = this.tabs.find(({ panel }) => panel.id === id);
    if (tab !== undefined) {
      tab.button.hidden = hidden;
      if (hidden && tab === this.active) {
        this.show(this.tabs[0].panel.id, false);
      }
    }
  }

  /** A number on a tab: what waits to be seen there. */
  setBadge(id: string, count: number, tone: 'warning' | 'error'): void {
    const tab = this.tabs.find(({ panel }) => panel.id === id);
    if (tab !== undefined) {
      tab.badge.hidden = count === 0;
      tab.badge.dataset.tone = tone;
      setText(tab.badge, String(count));
      tab.badge.setAttribute('aria-label', `${count} to look at`);
    }
  }

  show(id: string, isChoice = true): void {
    const wanted = this.tabs.find(({ panel, button }) => panel.id === id && !button.hidden);
    this.active = wanted ?? this.tabs[0];
    for (const tab of this.tabs) {
      const active = tab === this.active;
      tab.body.hidden = !active;
      tab.button.tabIndex = active ? 0 : -1;
      tab.button.setAttribute('aria-selected', String(active));
    }
    this.active?.button.scrollIntoView({ inline: 'nearest', block: 'nearest' });
    if (wanted !== undefined && isChoice) {
      remember(this.name, id);
    }
  }

  /** Show a tab unless the user has chosen one. */
  suggest(id: string): void {
    if (recall(this.name) === null) {
      this.show(id, false);
    }
  }

  /** What can be seen now of the parts that come only on demand. */
  get watches(): readonly Part[] {
    return (this.isVisible && this.active?.panel.watches) || [];
  }

  /** The topics of sensors that can be seen now. */
  get topics(): readonly string[] {
    return (this.isVisible && this.active?.panel.topics) || [];
  }

  pulse(state: State): void {
    if (this.isVisible) {
      this.active?.panel.pulse?.(state);
    }
  }

  private get isVisible(): boolean {
    return this.element.closest('[inert]') === null;
  }

  private move(event: KeyboardEvent): void {
    const shown = this.tabs.filter(({ button }) => !button.hidden);
    const at = shown.findIndex((tab) => tab === this.active);
    const to: Record<string, number> = {
      ArrowRight: (at + 1) % shown.length,
      ArrowLeft: (at - 1 + shown.length) % shown.length,
      Home: 0,
      End: shown.length - 1,
    };
    const next = shown[to[event.key]];
    if (next !== undefined) {
      event.preventDefault();
      this.show(next.panel.id);
      next.button.focus();
    }
  }
}
