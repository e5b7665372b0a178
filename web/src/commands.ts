// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Texts in which a command stands between back-quotes: as code, with a button that copies it. */
import { button, h } from './dom';
import { ICONS } from './icons';

/** The nodes of a text. Browsers let pages copy on this host and over HTTPS only. */
export function commands(text: string): Node[] {
  return text
    .split('`')
    .map((part, index) => (index % 2 === 1 ? command(part) : document.createTextNode(part)));
}

function command(text: string): HTMLElement {
  const code = h('code', {}, text);
  if (!('clipboard' in navigator)) {
    return code;
  }
  const path = (name: 'copy' | 'done'): void => copy.querySelector('path')?.setAttribute('d', ICONS[name]);
  const copy = button(
    '',
    () => {
      void navigator.clipboard.writeText(text).then(
        () => path('done'),
        () => getSelection()?.selectAllChildren(code), // not allowed: Ctrl+C does it
      );
    },
    { icon: 'copy', kind: 'quiet', title: 'Copy the command' },
  );
  return h('span', { class: 'command' }, code, copy);
}
