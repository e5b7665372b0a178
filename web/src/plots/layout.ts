// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Which charts there are, with which lines: as it is kept, shared as a link, and changed. */
import { signal } from '@preact/signals';
import { nameOf, parentOf, parseField, type Field } from './field';

/** The lines that the page itself knows, of the chosen robot. */
const KINDS = ['linear', 'angular', 'wheels', 'factor'] as const;
export type Kind = (typeof KINDS)[number];

/** The least and the greatest value in view; null: as the values are. */
export type Bounds = readonly [number | null, number | null];

export interface ChartSpec {
  id: number; // of this visit alone
  kind: Kind | null;
  fields: readonly Field[];
  bounds: Bounds;
  isXy: boolean; // over the first field in place of time
}

const MOST_CHARTS = 12;
const MOST_FIELDS = 12; // a chart
const DEFAULT = KINDS.join(';');
const FREE: Bounds = [null, null];
const XY = 'xy'; // in an address, before the fields

/** "linear;wheels,/odom:twist.twist.linear.x@-1..1": charts, their lines, their bounds. */
export function encode(charts: readonly ChartSpec[]): string {
  return charts
    .map(({ kind, fields, bounds: [least, most], isXy }) => {
      const lines = [...(isXy ? [XY] : []), ...(kind === null ? [] : [kind]), ...fields.map(nameOf)].map(escaped);
      const bounds = least === null && most === null ? '' : `@${least ?? ''}..${most ?? ''}`;
      return lines.join(',') + bounds;
    })
    .join(';');
}

/** The charts that a text means; of what is none, nothing. */
export function decode(text: string): ChartSpec[] {
  return text
    .split(';')
    .flatMap((part) => {
      const [lines = '', bounds = ''] = part.split('@');
      const names = lines.split(',').map(unescaped);
      const kind = KINDS.find((each) => names.includes(each)) ?? null;
      const fields = names.flatMap((name) => parseField(name) ?? []);
      return kind === null && fields.length === 0
        ? []
        : [specOf(kind, fields.slice(0, MOST_FIELDS), boundsOf(bounds), kind === null && names.includes(XY))];
    })
    .slice(0, MOST_CHARTS);
}

export class PlotLayout {
  private readonly cell;

  /**
   * `kept`: the layout of the last visit; `keep`: called with each new one; `shared`: that of the
   * page's address, which comes first, and is kept when something is changed.
   */
  constructor(
    kept: string | null,
    private readonly keep: (text: string) => void,
    shared: string | null = null,
  ) {
    const wanted = decode(shared ?? '');
    this.cell = signal(wanted.length > 0 ? wanted : decode(kept ?? DEFAULT));
  }

  get charts(): readonly ChartSpec[] {
    return this.cell.value;
  }

  /** These charts, as in an address. */
  get text(): string {
    return encode(this.charts);
  }

  isPlotted(field: Field): boolean {
    return this.charts.some(({ fields }) => fields.some((each) => isSame(each, field)));
  }

  /** Add a line to a chart, or to a new one; returns why not, or null. */
  add(field: Field, chart: number | null = null): string | null {
    const there = this.charts.find(({ id }) => id === chart);
    if (there === undefined) {
      if (this.charts.length >= MOST_CHARTS) {
        return `There are ${MOST_CHARTS} charts, as many as there may be: remove one.`;
      }
      this.set([...this.charts, specOf(null, [field], FREE, false)]);
      return null;
    }
    if (there.fields.some((each) => isSame(each, field))) {
      return null;
    }
    if (there.fields.length >= MOST_FIELDS) {
      return `A chart takes ${MOST_FIELDS} fields: drop it beside, for a chart of its own.`;
    }
    this.change(there.id, { fields: [...there.fields, field] });
    return null;
  }

  /** Plot a field beside its siblings, or alone, or plot it no more; returns why not, or null. */
  toggle(field: Field): string | null {
    if (!this.isPlotted(field)) {
      return this.add(field, this.chartOfSiblings(field));
    }
    for (const { id } of this.charts) {
      this.removeField(id, field);
    }
    return null;
  }

  /** Take a line out of a chart; a chart without lines goes, too. */
  removeField(chart: number, field: Field): void {
    const charts = this.charts.map((spec) =>
      spec.id === chart
        ? { ...spec, fields: spec.fields.filter((each) => !isSame(each, field)) }
        : spec,
    );
    this.set(charts.filter(({ kind, fields }) => kind !== null || fields.length > 0));
  }

  /** Have a line be another one, such as what is made of it; one that is there already is not added. */
  replaceField(chart: number, field: Field, by: Field): void {
    const there = this.charts.find(({ id }) => id === chart)?.fields ?? [];
    const isThere = there.some((each) => isSame(each, by));
    this.change(chart, {
      fields: there.flatMap((each) => (isSame(each, field) ? (isThere ? [] : [by]) : [each])),
    });
  }

  removeChart(chart: number): void {
    this.set(this.charts.filter(({ id }) => id !== chart));
  }

  setBounds(chart: number, bounds: Bounds): void {
    this.change(chart, { bounds: isOrdered(bounds) ? bounds : FREE });
  }

  setXy(chart: number, isXy: boolean): void {
    this.change(chart, { isXy });
  }

  reset(): void {
    this.set(decode(DEFAULT));
  }

  /** The chart of nothing but numbers of the same vector or array, which has room; null: none is. */
  private chartOfSiblings(field: Field): number | null {
    const wanted = nameOf(parentOf(field));
    const chart = this.charts.find(
      ({ kind, fields, isXy }) =>
        kind === null &&
        !isXy &&
        fields.length < MOST_FIELDS &&
        fields.every((each) => nameOf(parentOf(each)) === wanted),
    );
    return chart?.id ?? null;
  }

  private change(chart: number, part: Partial<ChartSpec>): void {
    this.set(this.charts.map((spec) => (spec.id === chart ? { ...spec, ...part } : spec)));
  }

  private set(charts: ChartSpec[]): void {
    this.cell.value = charts;
    this.keep(encode(charts));
  }
}

let made = 0;

function specOf(kind: Kind | null, fields: readonly Field[], bounds: Bounds, isXy: boolean): ChartSpec {
  made += 1;
  return { id: made, kind, fields, bounds, isXy };
}

function isSame(one: Field, other: Field): boolean {
  return nameOf(one) === nameOf(other);
}

function boundsOf(text: string): Bounds {
  const [least, most] = text.split('..').map((each) => (each === '' ? null : Number(each)));
  const bounds: Bounds = [finite(least), finite(most)];
  return isOrdered(bounds) ? bounds : FREE;
}

function finite(value: number | null | undefined): number | null {
  return value !== null && Number.isFinite(value) ? (value as number) : null;
}

function isOrdered([least, most]: Bounds): boolean {
  return least === null || most === null || least < most;
}

/** Fragments take slashes, colons and equals signs as they are, and so do people who read them. */
function escaped(name: string): string {
  return encodeURIComponent(name).replaceAll('%2F', '/').replaceAll('%3A', ':').replaceAll('%3D', '=');
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return '';
  }
}
