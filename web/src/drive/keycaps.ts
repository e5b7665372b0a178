// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Keys as they are labelled: W A S D are places on the keyboard, and on a French one these places
 * say Z Q S D. Browsers that do not tell (all but Chromium's) get the letters of a US keyboard.
 */
import { h, setText } from '../dom';

interface Layout {
  get(code: string): string | undefined;
}

interface Keyboard {
  getLayoutMap(): Promise<Layout>;
}

/** What is written on the key of a `KeyboardEvent.code`. */
export function labelOf(code: string, layout: Layout | null): string {
  return (layout?.get(code) ?? code.replace(/^Key/, '')).toUpperCase();
}

async function layoutOf(navigator: Navigator): Promise<Layout | null> {
  const { keyboard } = navigator as Navigator & { keyboard?: Keyboard };
  try {
    return (await keyboard?.getLayoutMap()) ?? null;
  } catch {
    return null; // not in this frame, or not allowed
  }
}

/** Key caps of these codes; they get their letters as soon as the browser has told them. */
export function keycaps(...codes: string[]): HTMLElement[] {
  const caps = codes.map((code) => h('kbd', {}, labelOf(code, null)));
  void layoutOf(navigator).then((layout) =>
    caps.forEach((cap, index) => setText(cap, labelOf(codes[index]!, layout))),
  );
  return caps;
}
