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
