// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Light or dark: as the system is set, until the user chooses. */
import { recall, remember } from './remember';

export type Theme = 'light' | 'dark';

const DARK = window.matchMedia('(prefers-color-scheme: dark)');

/** The theme of the page. */
function theme(): Theme {
  const chosen = recall('theme');
  return chosen === 'light' || chosen === 'dark' ? chosen : DARK.matches ? 'dark' : 'light';
}

/** Set the theme on the page, and call back now and on each change. */
export function watchTheme(call: (theme: Theme) => void): { flip: () => void } {
  const apply = (): void => {
    document.documentElement.dataset.theme = theme();
    call(theme());
  };
  DARK.addEventListener('change', apply);
  apply();
  return {
    flip: () => {
      remember('theme', theme() === 'dark' ? 'light' : 'dark');
      apply();
    },
  };
}

/** A colour of the style sheet, for those who draw on a canvas. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
