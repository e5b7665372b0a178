// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Elements, made in one expression; no style attributes, as the page's CSP forbids them. */

import { ICONS, type IconName } from './icons';

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
