// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The lines of a chart by name, each with its value now or at the cursor: a table. */
import { button, h, setText } from '../dom';
import { fixed, UNKNOWN } from '../format';
import type { Field } from './field';
import type { Line } from './lines';

const MOST_DECIMALS = 6;
const LARGE = 1e6;

interface Shown {
  value: number;
  name: string | null; // of the value, where it is a state
  wanted: number; // what it ought to be
  isOld: boolean; // nothing has come for a while
  fault: string | null; // why there is no value
}

interface Row {
  element: HTMLTableRowElement;
  value: HTMLElement;
  wanted: HTMLElement | null;
}

export class Legend {
  readonly element: HTMLTableElement;
  private readonly body = h('tbody');
  private rows: Row[] = [];
  private lines = '';

  constructor(title: string, private readonly onRemove: (field: Field) => void) {
    this.element = h('table', { class: 'legend' }, h('caption', { class: 'unseen' }, title), this.body);
  }

  setLines(lines: readonly Line[]): void {
    const now = JSON.stringify(lines);
    if (now !== this.lines) {
      this.lines = now;
      this.rows = lines.map((line) => this.row(line));
      this.body.replaceChildren(...this.rows.map(({ element }) => element));
    }
  }

  show(values: readonly Shown[], pixel: number): void {
    for (const [index, { value, name, wanted, isOld, fault }] of values.entries()) {
      const row = this.rows[index];
      if (row !== undefined) {
        setText(row.value, fault ?? name ?? number(value, pixel));
        row.element.classList.toggle('fault', fault !== null);
        row.element.classList.toggle('old', isOld);
        if (row.wanted !== null) {
          setText(row.wanted, ` / ${number(wanted, pixel)}`);
        }
      }
    }
  }

  private row({ name, title, colour, stroke, wanted, field }: Line): Row {
    const value = h('span', {}, UNKNOWN);
    const ought = wanted === null ? null : h('span', { class: 'wanted' });
    const swatch = h('span', { class: stroke.dash.length > 0 ? 'swatch dashed' : 'swatch' });
    swatch.style.setProperty('--colour', `var(--${colour})`);
    const remove =
      field === null
        ? null
        : button('', () => this.onRemove(field), {
            icon: 'close',
            kind: 'quiet',
            title: `Remove ${title} from the chart`,
          });
    const element = h(
      'tr',
      { title },
      h('th', { scope: 'row' }, swatch, name),
      h('td', {}, value, ought),
      remove === null ? null : h('td', { class: 'remove' }, remove),
    );
    return { element, value, wanted: ought };
  }
}

/** As exact as the chart is drawn. `pixel`: how much one is. */
export function number(value: number, pixel: number): string {
  if (Math.abs(value) >= LARGE) {
    return value.toExponential(3).replace('-', '−');
  }
  const decimals = Math.floor(-Math.log10(Math.max(pixel, 1e-9)));
  return fixed(value, Math.min(MOST_DECIMALS, Math.max(2, decimals)));
}
