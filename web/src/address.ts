// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The address of what is seen: "#plots=linear;angular&tools=beside.graph", each part by its name. */
import type { Store } from './store';

const parts = new Map<string, () => string>();

/** Have `write` say a part of the address. Returns what the address of this page has of it, or null. */
export function linkPart(name: string, write: () => string): string | null {
  parts.set(name, write);
  return partOf(window.location.hash, name);
}

/** A part of a fragment; null: it has none of that name. */
export function partOf(hash: string, name: string): string | null {
  const found = hash
    .slice(1)
    .split('&')
    .find((each) => each.startsWith(`${name}=`));
  return found?.slice(name.length + 1) ?? null;
}

/** The fragment that shows the same again. */
export function fragment(): string {
  const texts = [...parts].map(([name, write]) => [name, write()] as const);
  return `#${texts
    .filter(([, text]) => text !== '')
    .map(([name, text]) => `${name}=${text}`)
    .join('&')}`;
}

/** Give the address of what is seen, without a token: who gets it needs one of their own. */
export function shareLink(store: Store): void {
  const { origin, pathname, search } = window.location;
  const link = fragment();
  window.history.replaceState(null, '', `${pathname}${search}${link}`);
  const done = (): void => store.note('info', 'The link to these plots is in the clipboard.');
  const failed = (): void =>
    store.note('info', 'The address of this page is now the link to these plots: copy it.');
  // Without https, a page of another host has no clipboard.
  const copied = window.isSecureContext
    ? navigator.clipboard.writeText(`${origin}${pathname}${link}`)
    : Promise.reject(new Error('no clipboard'));
  copied.then(done, failed);
}

/** What is seen is something else than what the link says. */
export function forgetLink(): void {
  const { pathname, search, hash } = window.location;
  if ([...parts.keys()].some((name) => partOf(hash, name) !== null)) {
    window.history.replaceState(null, '', `${pathname}${search}`);
  }
}
