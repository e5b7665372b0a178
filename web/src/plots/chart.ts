// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** One chart: its head, its legend, its lines, and the cursor on them. */
import { button, h, setText } from '../dom';
import { timeText } from '../format';
import { Drawing, type Reader } from './drawing';
import { droppedField, isField, nameOf, parseField, shortNames, stepsText, type Field } from './field';
import { listenToGestures, type TimeHand } from './gestures';
import { Legend, number } from './legend';
import type { Bounds, ChartSpec } from './layout';
import type { ChartLines } from './lines';

/** What a chart asks for; the panel does it. */
export interface ChartPort extends TimeHand {
  add(field: Field): void;
  ask(): void; // a field is to be searched for
  removeField(field: Field): void;
  remove(): void;
  setBounds(bounds: Bounds): void;
  replace(field: Field, by: Field): void;
  setXy(on: boolean): void;
}

/** What is shown: the time, and where in it the cursor is, as a share. */
export interface Shown {
  range: readonly [number, number];
  latest: number; // s
  cursor: number | null;
  isHeld: boolean;
  playhead: number | null; // s: of a recording, the time that is shown
  faultOf: (field: Field) => string | null;
}

const OLD = 2; // s without a value of a field
/** What may be made of a field, as it is written behind it, in words. */
const MADE: readonly (readonly [string, string])[] = [
  ['', 'as it is'],
  ['~d', 'derivative'],
  ['~lowpass=0.1', 'low-pass 0.1 s'],
  ['~lowpass=0.5', 'low-pass 0.5 s'],
  ['~lowpass=2', 'low-pass 2 s'],
  ['~lowpass=0.5~d', 'derivative, low-pass 0.5 s'],
];

export class Chart {
  readonly element: HTMLElement;
  private readonly place: HTMLElement;
  private readonly legend: Legend;
  private readonly drawing: Drawing;
  private readonly title = h('span', { class: 'chart-title' });
  private readonly unit = h('span', { class: 'fine' });
  private readonly time = h('span', { class: 'chart-time' });
  private readonly line = h('div', { class: 'chart-cursor', hidden: true }, this.time);
  private readonly part = h('div', { class: 'chart-part', hidden: true });
  private readonly made = h('div');
  private shownMade = ''; // of which fields
  private readonly isXy = h('input', { type: 'checkbox', onchange: () => this.port.setXy(this.isXy.checked) });
  private readonly xy = h('label', { class: 'chart-making' }, this.isXy, h('span', {}, 'Over the first, not over time'));
  private over: HTMLElement | null = null;

  constructor(
    private spec: ChartSpec,
    private about: ChartLines,
    private readonly port: ChartPort,
  ) {
    this.place = h('div', { class: 'chart-plot', tabindex: 0, role: 'group' });
    this.legend = new Legend('Lines', (field) => port.removeField(field));
    this.drawing = new Drawing(this.place, about, spec.bounds, (over) => {
      this.over = over;
      over.append(this.line, this.part);
    });
    this.element = h(
      'figure',
      { class: 'chart' },
      h('figcaption', {}, this.head(), this.legend.element),
      this.place,
    );
    listenToGestures(this.place, () => (this.over ?? this.place).getBoundingClientRect(), {
      ...port,
      choosing: (part) => this.choose(part),
    });
    this.takeDrops();
    this.setLines(spec, about);
  }

  get name(): string {
    return this.about.title;
  }

  get lines(): ChartLines {
    return this.about;
  }

  setLines(spec: ChartSpec, about: ChartLines): void {
    [this.spec, this.about] = [spec, about];
    setText(this.title, about.title);
    this.title.title = about.title;
    setText(this.unit, about.unit);
    this.place.setAttribute(
      'aria-label',
      `${about.title} over time. Left and right move the cursor, with Shift the time; ` +
        'plus and minus zoom, Home follows.',
    );
    this.legend.setLines(about.lines);
    this.element.classList.toggle('states', about.form === 'lanes');
    this.showMade();
    this.drawing.setLines(about, spec.bounds);
  }

  show(read: Reader, shown: Shown, now: number, isUrgent: boolean): void {
    this.drawing.show(read, shown.range, shown.latest, now, isUrgent);
    this.showCursor(read, shown);
  }

  /** Its colours are those of another theme. */
  rebuild(): void {
    this.drawing.rebuild();
  }

  picture<T>(width: number, height: number, take: (canvas: HTMLCanvasElement) => T): Promise<T> {
    return this.drawing.picture(width, height, take);
  }

  /** What its lines are at a time (s), in words. */
  words(read: Reader, time: number): string {
    const { pixel } = this.drawing;
    return this.about.lines
      .map(({ name, stroke, names }) => {
        const value = read(stroke.source)?.at(time) ?? Number.NaN;
        return `${name} ${names?.[value] ?? number(value, pixel)}`;
      })
      .join(', ');
  }

  private showCursor(read: Reader, { range, latest, cursor: hand, isHeld, playhead, faultOf }: Shown): void {
    const [from, to] = range;
    const isSeen = playhead !== null && playhead >= from && playhead <= to;
    const cursor = hand ?? (isSeen ? (playhead - from) / (to - from) : null);
    const time = cursor === null ? Math.min(to, latest) : from + cursor * (to - from);
    const isNow = !isHeld && cursor === null;
    const isKnown = time <= latest; // behind that, nothing has come yet
    const values = this.about.lines.map(({ stroke, wanted, field, names }) => {
      const series = read(stroke.source);
      const value = (isKnown ? series?.at(time) : null) ?? Number.NaN;
      return {
        value,
        name: names?.[value] ?? null,
        wanted: (wanted === null || !isKnown ? null : read(wanted.source)?.at(time)) ?? Number.NaN,
        isOld: isNow && field !== null && series !== null && latest - series.latest > OLD,
        fault: field === null ? null : faultOf(field),
      };
    });
    this.legend.show(values, this.drawing.pixel);
    this.line.hidden = cursor === null || this.about.form === 'xy';
    if (cursor !== null) {
      const width = this.over?.clientWidth ?? 0;
      this.line.style.transform = `translateX(${cursor * width}px)`;
      this.line.classList.toggle('late', cursor > 0.5);
      setText(this.time, timeText(time));
    }
  }

  private choose(part: readonly [number, number] | null): void {
    this.part.hidden = part === null;
    if (part !== null) {
      const width = this.over?.clientWidth ?? 0;
      this.part.style.left = `${Math.min(...part) * width}px`;
      this.part.style.width = `${Math.abs(part[1] - part[0]) * width}px`;
    }
  }

  private head(): HTMLElement {
    const form = h('div', { class: 'chart-settings', hidden: true }, this.boundsForm(), this.made);
    const bounds = button('', () => (form.hidden = !form.hidden), {
      icon: 'range',
      kind: 'quiet',
      title: this.spec.kind === null ? 'Bounds, derivative, filter, difference' : 'Bounds',
    });
    return h(
      'div',
      { class: 'chart-head' },
      this.title,
      this.unit,
      h(
        'span',
        { class: 'chart-buttons' },
        button('', () => this.port.ask(), { icon: 'plus', kind: 'quiet', title: 'Add a field to it' }),
        bounds,
        button('', () => this.port.remove(), { icon: 'close', kind: 'quiet', title: 'Remove the chart' }),
      ),
      form,
    );
  }

  /** Of each field, what is made of it. */
  private showMade(): void {
    const { kind, fields, isXy } = this.spec;
    const now = fields.map(nameOf).join();
    if (now !== this.shownMade) {
      this.shownMade = now;
      this.made.replaceChildren(...fields.map((field, index) => this.makingOf(field, index)), this.xy);
      this.xy.hidden = kind !== null || fields.length < 2;
    }
    this.isXy.checked = isXy;
  }

  private makingOf(field: Field, index: number): HTMLElement {
    const { topic, path } = field;
    const [name = path] = shortNames([{ topic, path }]);
    const others = this.spec.fields.filter((each) => each.topic !== topic || each.path !== path);
    const minus = others.map((other): [string, string] => [
      `~minus=${nameOf({ topic: other.topic, path: other.path })}`,
      `minus ${shortNames([other, field])[0] ?? ''}`,
    ]);
    const offered = new Map([...MADE, ...minus]);
    const current = stepsText(field);
    const all = offered.has(current) ? offered : new Map([...offered, [current, current]]);
    const select = h(
      'select',
      { 'aria-label': `${name} is shown` },
      ...[...all].map(([value, words]) => h('option', { value }, words)),
    );
    select.value = current;
    select.addEventListener('change', () => {
      const by = parseField(`${topic}:${path}${select.value}`);
      if (by !== null) {
        this.port.replace(field, by);
        this.made.querySelectorAll('select')[index]?.focus(); // this one has gone
      }
    });
    return h('label', { class: 'chart-making' }, h('span', {}, name), select);
  }

  private boundsForm(): HTMLFormElement {
    const input = (name: string, value: number | null): HTMLInputElement =>
      h('input', { type: 'number', step: 'any', placeholder: 'auto', 'aria-label': name, value });
    const least = input('Least value', this.spec.bounds[0]);
    const most = input('Greatest value', this.spec.bounds[1]);
    const form = h('form', { class: 'bounds' }, least, '–', most);
    const valueOf = ({ value }: HTMLInputElement): number | null =>
      value.trim() === '' || !Number.isFinite(Number(value)) ? null : Number(value);
    form.addEventListener('change', () => {
      const bounds: Bounds = [valueOf(least), valueOf(most)];
      const isEmpty = bounds[0] !== null && bounds[1] !== null && bounds[0] >= bounds[1];
      most.setCustomValidity(isEmpty ? 'It has to be greater than the least value.' : '');
      if (form.reportValidity()) {
        this.port.setBounds(bounds);
      }
    });
    form.addEventListener('submit', (event) => event.preventDefault());
    return form;
  }

  private takeDrops(): void {
    const over = (is: boolean): void => void this.element.classList.toggle('dropping', is);
    this.element.addEventListener('dragover', (event) => {
      if (isField(event.dataTransfer)) {
        event.preventDefault();
        over(true);
      }
    });
    this.element.addEventListener('dragleave', () => over(false));
    this.element.addEventListener('drop', (event) => {
      over(false);
      const field = droppedField(event.dataTransfer);
      if (field !== null) {
        event.preventDefault();
        event.stopPropagation();
        this.port.add(field);
      }
    });
  }
}
