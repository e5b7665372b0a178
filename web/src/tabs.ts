// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Panels one at a time, chosen by tabs as in the ARIA practices: arrows move, Tab leaves. On a desk
 * some of them stand large elsewhere, see workspace.ts: their tabs lead there.
 */
import { forgetLink, linkPart } from './address';
import type { Panel } from './app';
import { button as makeButton, h, icon, setText } from './dom';
import { ICONS, type IconName } from './icons';
import { showOverflow } from './overflow';
import type { Part } from './protocol';
import { recall, remember } from './remember';
import type { State } from './state';
import { PLACES, type Place, type Workspace } from './workspace';

interface Tab {
  panel: Panel;
  button: HTMLButtonElement;
  badge: HTMLElement;
  body: HTMLElement;
  movers: Map<Place | null, HTMLButtonElement>; // by where they put it; null: into the column
}

const MOVES = {
  beside: 'Large, beside the scene',
  below: 'Large, over the plots',
  column: 'Back into the column',
} as const;

/** The order of the tabs by what they are about: the robot, what runs it, the ROS graph. */
const GROUPS: readonly (readonly string[])[] = [
  ['model', 'joints', 'sensors', 'frames'],
  ['simulation', 'control', 'health', 'plots'],
  ['topics', 'services', 'log', 'parameters', 'graph'],
];
const ORDER = GROUPS.flat();

export class Tabs {
  readonly element = h('div', { class: 'panels' });
  private readonly list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Panels' });
  private readonly tabs: Tab[] = [];
  private active: Tab | null = null;
  private suggested: string | null = null;
  private isDesk = false; // else one tool at a time
  private linked = linkPart('tab', () => this.active?.panel.id ?? '');
  /** What stands at the places is another tool. */
  onStand: () => void = () => {};

  /** `name`: of what is remembered; the kind of the graph is added to it. */
  constructor(
    private name: string,
    private readonly workspace: Workspace,
  ) {
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
    const movers = new Map(
      [...PLACES, null].map((place) => [place, this.mover(panel.id, place)] as const),
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
      h('div', { class: 'panel-head' }, h('h2', {}, panel.title), ...movers.values()),
      panel.element,
    );
    if (GROUPS.some(([first]) => first === panel.id)) {
      button.classList.add('first'); // of its group
    }
    const at = this.tabs.findIndex((tab) => rank(tab.panel.id) > rank(panel.id));
    const next = this.tabs[at];
    this.tabs.splice(next === undefined ? this.tabs.length : at, 0, { panel, button, badge, body, movers });
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

  /** On a desk the tabs stand in a column, along which arrow keys go, and tools may stand large. */
  stand(isDesk: boolean): void {
    this.isDesk = isDesk;
    this.list.setAttribute('aria-orientation', isDesk ? 'vertical' : 'horizontal');
    this.list.ariaMultiSelectable = isDesk ? 'true' : null;
    this.settle();
  }

  /** The tool that stands at a place now. */
  at(place: Place): HTMLElement | null {
    return this.shown.find((tab) => this.placeOf(tab) === place)?.body ?? null;
  }

  /** Have tools stand where the workspace has them. */
  arrange(): void {
    this.settle();
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

  /** Show a panel, and remember that it was chosen; one that stands large is led to. */
  show(id: string): void {
    const wanted = this.shown.find(({ panel }) => panel.id === id);
    if (wanted !== undefined && this.placeOf(wanted) !== null) {
      wanted.body.focus();
    } else if (wanted !== undefined) {
      this.linked = null;
      forgetLink();
      remember(this.name, id);
      this.activate(wanted);
    }
  }

  /** Show what was chosen, else what is suggested, else the first that is there. */
  private settle(): void {
    const inColumn = this.shown.filter((tab) => this.placeOf(tab) === null);
    const wanted = [this.linked, recall(this.name), this.suggested, inColumn[0]?.panel.id];
    const found = wanted.map((id) => inColumn.find(({ panel }) => panel.id === id));
    this.activate(found.find((each) => each !== undefined) ?? null);
    this.onStand();
  }

  private activate(wanted: Tab | null): void {
    this.active = wanted;
    const first = wanted ?? this.shown[0];
    for (const tab of this.tabs) {
      const place = tab.button.hidden ? null : this.placeOf(tab);
      const isSeen = tab === wanted || place !== null;
      tab.body.hidden = !isSeen;
      tab.body.dataset.place = place ?? 'column';
      tab.button.tabIndex = tab === first ? 0 : -1;
      tab.button.setAttribute('aria-selected', String(isSeen));
      tab.button.classList.toggle('away', place !== null);
      for (const [to, mover] of tab.movers) {
        mover.hidden = to === place;
      }
    }
    wanted?.button.scrollIntoView({ inline: 'nearest', block: 'nearest' });
  }

  private placeOf({ panel }: Tab): Place | null {
    return this.isDesk ? this.workspace.placeOf(panel.id) : null;
  }

  /** A button that has a tool stand elsewhere. */
  private mover(id: string, to: Place | null): HTMLButtonElement {
    const name = to ?? 'column';
    const move = (): void => {
      const tab = this.tabs.find(({ panel }) => panel.id === id);
      this.workspace.put(id, to);
      if (to === null) {
        this.show(id);
      }
      [...(tab?.movers.values() ?? [])].find(({ hidden }) => !hidden)?.focus(); // this one is gone
    };
    return makeButton('', move, { icon: name, title: MOVES[name], kind: 'quiet' });
  }

  private get shown(): Tab[] {
    return this.tabs.filter(({ button }) => !button.hidden);
  }

  /** Panels that can be seen now. */
  private get seen(): Panel[] {
    const isVisible = this.element.closest('[inert]') === null;
    return isVisible ? this.tabs.filter(({ body }) => !body.hidden).map(({ panel }) => panel) : [];
  }

  /** What can be seen now of the parts that come only on demand. */
  get watches(): readonly Part[] {
    return this.seen.flatMap(({ watches }) => watches ?? []);
  }

  /** The topics of sensors that can be seen now. */
  get topics(): readonly string[] {
    return this.seen.flatMap(({ topics }) => topics ?? []);
  }

  pulse(state: State): void {
    for (const panel of this.seen) {
      panel.pulse?.(state);
    }
  }

  private move(event: KeyboardEvent): void {
    const { shown } = this;
    const at = shown.findIndex(({ button }) => button === event.target);
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
      if (this.placeOf(wanted) === null) {
        this.show(wanted.panel.id);
      }
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
