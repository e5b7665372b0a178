// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Panels one at a time, chosen by tabs as in the ARIA practices: arrows move, Tab leaves. */
import type { Panel } from './app';
import { h, icon, setText } from './dom';
import { ICONS, type IconName } from './icons';
import { showOverflow } from './overflow';
import type { Part } from './protocol';
import { recall, remember } from './remember';
import type { State } from './state';

interface Tab {
  panel: Panel;
  button: HTMLButtonElement;
  badge: HTMLElement;
  body: HTMLElement;
}

/** The order of the tabs by what they are about: the robot, what runs it, the ROS graph. */
const GROUPS: readonly (readonly string[])[] = [
  ['model', 'joints', 'sensors', 'frames'],
  ['simulation', 'control', 'health', 'plots'],
  ['topics', 'log', 'parameters', 'graph'],
];
const ORDER = GROUPS.flat();

export class Tabs {
  readonly element = h('div', { class: 'panels' });
  private readonly list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Panels' });
  private readonly tabs: Tab[] = [];
  private active: Tab | null = null;
  private suggested: string | null = null;

  /** `name`: of what is remembered; the kind of the graph is added to it. */
  constructor(private name: string) {
    this.element.append(this.list);
    this.list.addEventListener('keydown', (event) => this.move(event));
    showOverflow(this.list);
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
      icon(tabIcon(panel.id)),
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
    if (GROUPS.some(([first]) => first === panel.id)) {
      button.classList.add('first'); // of its group
    }
    const at = this.tabs.findIndex((tab) => rank(tab.panel.id) > rank(panel.id));
    const next = this.tabs[at];
    this.tabs.splice(next === undefined ? this.tabs.length : at, 0, { panel, button, badge, body });
    this.list.insertBefore(button, next?.button ?? null);
    this.element.append(body);
    this.settle();
  }

  /** A tab that is not wanted now: it would be empty, or its content stands elsewhere. */
  setHidden(id: string, hidden: boolean): void {
    const tab = this.tabs.find(({ panel }) => panel.id === id);
    if (tab !== undefined && tab.button.hidden !== hidden) {
      tab.button.hidden = hidden;
      this.settle();
    }
  }

  /**
   * The kind of graph that the panels show. What was chosen last for this kind is shown, else the
   * suggested tab: who looked at a simulation yesterday wants the sliders of `display` today.
   * Returns whether the kind is another one than before.
   */
  setKind(kind: string, suggested: string): boolean {
    const name = `tab.${kind}`;
    const isNew = name !== this.name;
    if (isNew || suggested !== this.suggested) {
      this.name = name;
      this.suggested = suggested;
      this.settle();
    }
    return isNew;
  }

  /** Whether the tabs stand in a column: arrow keys go along it. */
  stand(orientation: 'vertical' | 'horizontal'): void {
    this.list.setAttribute('aria-orientation', orientation);
    this.active?.button.scrollIntoView({ inline: 'nearest', block: 'nearest' });
  }

  /** A number on a tab: what waits to be seen there. */
  setBadge(id: string, { count, tone }: { count: number; tone: 'warning' | 'error' }): void {
    const tab = this.tabs.find(({ panel }) => panel.id === id);
    if (tab !== undefined) {
      tab.badge.hidden = count === 0;
      tab.badge.dataset.tone = tone;
      setText(tab.badge, String(count));
      tab.badge.setAttribute('aria-label', `${count} to look at`);
    }
  }

  /** Show a panel, and remember that it was chosen. */
  show(id: string): void {
    const wanted = this.shown.find(({ panel }) => panel.id === id);
    if (wanted !== undefined) {
      remember(this.name, id);
      this.activate(wanted);
    }
  }

  /** Show what was chosen, else what is suggested, else the first that is there. */
  private settle(): void {
    const wanted = [recall(this.name), this.suggested, this.shown[0]?.panel.id];
    const found = wanted.map((id) => this.shown.find(({ panel }) => panel.id === id));
    const tab = found.find((each) => each !== undefined);
    if (tab !== undefined) {
      this.activate(tab);
    }
  }

  private activate(wanted: Tab): void {
    this.active = wanted;
    for (const tab of this.tabs) {
      const active = tab === wanted;
      tab.body.hidden = !active;
      tab.button.tabIndex = active ? 0 : -1;
      tab.button.setAttribute('aria-selected', String(active));
    }
    wanted.button.scrollIntoView({ inline: 'nearest', block: 'nearest' });
  }

  private get shown(): Tab[] {
    return this.tabs.filter(({ button }) => !button.hidden);
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
    const { shown } = this;
    const at = shown.findIndex((tab) => tab === this.active);
    const [next, previous] =
      this.list.getAttribute('aria-orientation') === 'vertical'
        ? ['ArrowDown', 'ArrowUp']
        : ['ArrowRight', 'ArrowLeft'];
    const to: Record<string, number> = {
      [next]: (at + 1) % shown.length,
      [previous]: (at - 1 + shown.length) % shown.length,
      Home: 0,
      End: shown.length - 1,
    };
    const wanted = shown[to[event.key] ?? -1];
    if (wanted !== undefined) {
      event.preventDefault();
      this.show(wanted.panel.id);
      wanted.button.focus();
    }
  }
}

function rank(id: string): number {
  const at = ORDER.indexOf(id);
  return at < 0 ? ORDER.length : at;
}

function tabIcon(id: string): IconName {
  return id in ICONS ? (id as IconName) : 'panels';
}
