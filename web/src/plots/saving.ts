// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What is seen of the plots as a table, an image or an address. */
import { saveFile } from '../save';
import type { Store } from '../store';
import type { Chart } from './chart';
import { toCsv } from './csv';
import type { Reader } from './drawing';
import type { Line } from './lines';
import { toPng } from './png';

/** Save the values of lines between two times (s). */
export function saveCsv(
  lines: readonly Line[],
  read: Reader,
  [from, to]: readonly [number, number],
): void {
  const columns = lines.flatMap(({ columns: names, stroke, wanted }) =>
    [stroke, wanted].flatMap((each, index) => {
      const series = each === null ? null : read(each.source);
      return series === null ? [] : [{ name: names[index] ?? '', series }];
    }),
  );
  saveFile('plots.csv', new Blob([toCsv(columns, from, to)], { type: 'text/csv' }));
}

/** Save what is drawn. */
export async function savePng(charts: readonly Chart[], store: Store): Promise<void> {
  const image = await toPng(charts);
  if (image === null) {
    store.note('warning', 'This browser could not draw the image.');
  } else {
    saveFile('plots.png', image);
  }
}

/** Give the address of these plots, without a token: who gets it needs one of their own. */
export function shareLink(link: string, store: Store): void {
  const { origin, pathname, search } = window.location;
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

/** The layout is another one than that of the link. */
export function forgetLink(): void {
  const { pathname, search, hash } = window.location;
  if (hash.startsWith('#plots=')) {
    window.history.replaceState(null, '', `${pathname}${search}`);
  }
}
