// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Elements, made in one expression; no style attributes, as the page's CSP forbids them. */

type Handler = (event: Event) => void;
type Value = string | number | boolean | null | Handler;
export type Child = Node | string | null;

/**
 * An element with attributes and children.
 *
 * `onclick: f` listens, `true` sets an empty attribute, `false` and null leave it out.
 */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') {
      element.addEventListener(name.slice(2), value);
    } else if (value !== false && value !== null) {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

const ICONS = {
  play: 'M5 3.5v9l7.5-4.5z',
  pause: 'M4.5 3.5h2.5v9H4.5zM9 3.5h2.5v9H9z',
  step: 'M3.5 3.5v9L9.5 8zM10.5 3.5h2v9h-2z',
  reset: 'M8 2.5V0L4 3.5 8 7V4.3a3.9 3.9 0 1 1-3.9 3.9H2.3A5.7 5.7 0 1 0 8 2.5z',
  theme: 'M8 1.5a6.5 6.5 0 1 0 0 13zM8 1.5v1.3a5.2 5.2 0 0 1 0 10.4v1.3a6.5 6.5 0 0 0 0-13z',
  panels: 'M2 3h12v2H2zM2 7h12v2H2zM2 11h12v2H2z',
  close: 'M3 4.4 4.4 3 8 6.6 11.6 3 13 4.4 9.4 8l3.6 3.6-1.4 1.4L8 9.4 4.4 13 3 11.6 6.6 8z',
  down: 'M3 5.5 8 10.5l5-5z',
  up: 'M3 10.5 8 5.5l5 5z',
} as const;

export type IconName = keyof typeof ICONS;

/** A drawing that says nothing to a screen reader: the button around it has the words. */
export function icon(name: IconName): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', ICONS[name]);
  svg.append(path);
  return svg;
}

export interface ButtonOptions {
  icon?: IconName;
  title?: string; // also what a screen reader says when there is no text
  kind?: 'primary' | 'quiet';
}

export function button(
  text: string,
  onClick: () => void,
  { icon: name, title, kind }: ButtonOptions = {},
): HTMLButtonElement {
  return h(
    'button',
    {
      type: 'button',
      class: kind === undefined ? 'button' : `button ${kind}`,
      title: title ?? null,
      'aria-label': text === '' ? (title ?? null) : null,
      onclick: onClick,
    },
    name === undefined ? null : icon(name),
    text === '' ? null : h('span', {}, text),
  );
}

const DOUBT = 3000; // ms in which the second press counts

/** A button for what cannot be taken back: it asks, and does it on the second press. */
export function confirmed(text: string, question: string, onSure: () => void): HTMLButtonElement {
  let asked: ReturnType<typeof setTimeout> | null = null;
  const settle = (): void => {
    asked = null;
    element.classList.remove('danger');
    element.replaceChildren(h('span', {}, text));
  };
  const element = button(text, () => {
    if (asked !== null) {
      clearTimeout(asked);
      settle();
      onSure();
      return;
    }
    element.classList.add('danger');
    element.replaceChildren(h('span', {}, question));
    asked = setTimeout(settle, DOUBT);
  }, { kind: 'quiet' });
  return element;
}

/** A button that stays in. */
export function toggle(
  text: string,
  on: boolean,
  onToggle: (on: boolean) => void,
  title: string | null = null,
): HTMLButtonElement {
  const element = h('button', { type: 'button', class: 'toggle', title }, text);
  element.setAttribute('aria-pressed', String(on));
  element.addEventListener('click', () => {
    const pressed = element.getAttribute('aria-pressed') !== 'true';
    element.setAttribute('aria-pressed', String(pressed));
    onToggle(pressed);
  });
  return element;
}

/** A titled part of a panel. */
export function section(title: string, ...children: Child[]): HTMLElement {
  return h('section', { class: 'section' }, h('h3', {}, title), ...children);
}

/** A table with a head; numbers stand to the right. */
export function table(
  caption: string,
  columns: readonly { name: string; number?: boolean }[],
  body: HTMLTableSectionElement,
): HTMLElement {
  const head = columns.map(({ name, number }) =>
    h('th', { scope: 'col', class: number === true ? 'number' : null }, name),
  );
  return h(
    'div',
    { class: 'table' },
    h(
      'table',
      {},
      h('caption', { class: 'unseen' }, caption),
      h('thead', {}, h('tr', {}, ...head)),
      body,
    ),
  );
}

/** Names and values, as a description list. */
export function facts(pairs: readonly (readonly [string, string])[]): HTMLElement {
  const rows = pairs.map(([name, value]) =>
    h('div', {}, h('dt', {}, name), h('dd', { title: value }, value)),
  );
  return h('dl', { class: 'facts' }, ...rows);
}

/** Put a text into an element, if it is another one: the DOM is touched on change alone. */
export function setText(element: Node, text: string): void {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

/** Whether a key is for what has the focus: letters where one types, arrows where they move. */
export function takesKey(target: EventTarget | null, code: string): boolean {
  if (!(target instanceof HTMLElement)) {
    return false;
  }
  if (target.matches('textarea, select, input:not([type=range], [type=checkbox])')) {
    return true;
  }
  const movesIn = '[type=range], [role=tablist], .chart-plot';
  return code.startsWith('Arrow') && target.closest(movesIn) !== null;
}
