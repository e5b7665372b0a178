// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The plots: charts of the robot and of any fields, over one time, with one cursor. */
import { effect, signal, untracked } from '@preact/signals';
import { render } from 'preact';
import { forgetLink, linkPart, shareLink } from '../address';
import type { App, Panel } from '../app';
import type { Names } from '../channels';
import { h, setText } from '../dom';
import type { Part } from '../protocol';
import { recall, recallNumber, remember } from '../remember';
import type { State } from '../state';
import { timeText } from '../format';
import { Chart, type ChartPort } from './chart';
import type { Reader } from './drawing';
import { droppedField, isField, parseField, type Field } from './field';
import { Following, type FieldFeed } from './following';
import { PlotLayout, type ChartSpec } from './layout';
import { chartLines, type Line, type Source } from './lines';
import { Offers } from './offers';
import type { Recorder } from './recorder';
import { saveCsv, savePng } from './saving';
import { SPAN, type Series } from './series';
import { TimeView, type Extent } from './time_view';
import { toolsOf, WINDOWS } from './tools';

const ANOTHER_CLOCK = 1e5; // s from the time of the states
const AT_LAST = 600; // ms without a state, after which all of the last one is drawn
const SAID_AFTER = 400; // ms after the last key: the values at the cursor are said once it rests

export class PlotsPanel implements Panel {
  readonly id = 'plots';
  readonly title = 'Plots';
  readonly element: HTMLElement;
  readonly layout = new PlotLayout(
    recall('plots'),
    (text) => {
      remember('plots', text);
      forgetLink();
    },
    linkPart('plots', () => this.layout.text),
  );
  private readonly place = h('div', { class: 'charts' });
  private readonly live = h('div', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
  private readonly view = new TimeView(
    recallNumber('window', WINDOWS[0] ?? 10, SPAN, 30),
    SPAN,
  );
  private readonly following: Following;
  private readonly charts = new Map<number, Chart>();
  private readonly heldAt = signal<string | null>(null); // in words
  private readonly target = signal<{ id: number; name: string } | null>(null);
  private known = ''; // of what charts are made: the wheels of the robot, and which fields are states
  private held: Recorder | null = null;
  private cursor: number | null = null; // a share of what is seen
  private sayLater: ReturnType<typeof setTimeout> | undefined;
  private isSearching = false;
  private last: ReturnType<typeof setTimeout> | undefined;
  private moving = 0; // the frame that will draw
  /** Another time is looked at, s; null: that which comes. */
  onTime: (time: number | null) => void = () => {};
  private told: number | null = null;
  private now: number | null = null; // s, of the latest state of a recording

  constructor(
    private readonly app: App,
    private readonly recorder: Recorder,
    feed: FieldFeed,
  ) {
    this.following = new Following(feed, recorder);
    const own = h('div', { class: 'plot-tools-own' });
    const tools = h('div', { class: 'plot-tools', role: 'toolbar', 'aria-label': 'Plots' }, own);
    const beside = h('div', { class: 'chart-new' }, 'Drop here for a new chart');
    this.element = h(
      'section',
      { class: 'plots', 'aria-label': 'Plots' },
      tools,
      this.place,
      beside,
      this.live,
    );
    const { store } = app;
    const save = {
      csv: () => saveCsv(this.lines, this.read, this.view.range(this.extent)),
      png: () => {
        this.draw(true); // what has come since the last drawing, too
        void savePng(this.shown, store);
      },
      link: () => shareLink(store),
    };
    const { heldAt, target, layout } = this;
    const Tools = toolsOf({
      window: this.view.window,
      heldAt,
      target,
      offers: new Offers(app),
      search: (on) => (this.isSearching = on),
      setWindow: (seconds) => this.setWindow(seconds),
      pause: (on) => this.pause(on),
      add: (text) => this.addText(text),
      reset: () => layout.reset(),
      ...save,
    });
    render(Tools, own);
    this.takeDrops(beside);
    effect(() => {
      void layout.charts;
      untracked(() => this.arrange());
    });
    app.store.watch(['graph', 'robot'], () => this.arrange());
    app.store.watch(['reset'], () => this.pause(false));
    app.store.watch(['recording'], () => {
      this.following.follow([]); // from now on they come from elsewhere
      this.arrange();
    });
    app.store.watch(['link'], () => {
      if (app.store.link.state !== 'open') {
        recorder.interrupt();
      }
    });
  }

  /** Topics, while somebody searches for one. */
  get watches(): readonly Part[] {
    return this.isSearching ? ['topics'] : [];
  }

  pulse({ time }: State): void {
    this.now = this.app.store.recording === null ? null : time;
    this.draw(false);
  }

  /** All of a recording is kept now: show all of it. */
  showWhole(): void {
    const { first, latest } = this.extent;
    this.view.setWhole(Math.max(1, latest - first || 0));
    this.pause(false);
  }

  /** The colours changed. */
  repaint(): void {
    for (const chart of this.charts.values()) {
      chart.rebuild();
    }
    this.draw(true);
  }

  /** Follow what comes. */
  follow(): void {
    if (this.view.isHeld) {
      this.pause(false);
    }
  }

  /** Whether a field is plotted; followed, as it is a signal. */
  isPlotted(field: Field): boolean {
    return this.layout.isPlotted(field);
  }

  /** Plot a field, or no more: for those who show fields. */
  toggle(field: Field): void {
    this.complain(this.layout.toggle(field));
  }

  /** One chart for each of the layout, in its order. */
  private arrange(): void {
    const { charts } = this.layout;
    const added: HTMLElement[] = [];
    const wheels = this.recorder.of(this.robot)?.wheels ?? [];
    this.known = this.knownNow;
    for (const [id, chart] of [...this.charts]) {
      if (!charts.some((spec) => spec.id === id)) {
        chart.element.remove();
        this.charts.delete(id);
      }
    }
    for (const spec of charts) {
      const about = chartLines(spec, wheels, this.namesOf);
      const chart = this.charts.get(spec.id) ?? new Chart(spec, about, this.portOf(spec.id));
      this.charts.set(spec.id, chart);
      chart.setLines(spec, about);
      chart.element.hidden = this.isEmpty(spec);
      if (chart.element.parentElement === null) {
        this.place.append(chart.element);
        added.push(chart.element);
      }
    }
    if (added.length === 1) { // not all of a layout
      added[0]?.scrollIntoView({ block: 'nearest' }); // it may be below the fold
      added[0]?.classList.add('added');
    }
    const fields = charts.flatMap((spec) => spec.fields);
    this.following.follow(fields);
    document.body.classList.toggle('plotted', fields.length > 0);
    this.draw(true);
  }

  /** Whether a chart of the page's own would stay without lines: of no simulator, of no wheels. */
  private isEmpty({ kind, fields }: ChartSpec): boolean {
    if (kind === 'wheels' && fields.length === 0) {
      return this.recorder.of(this.robot)?.wheels.length === 0;
    }
    return kind === 'factor' && this.app.store.simulator === null;
  }

  private readonly namesOf = (field: Field): Names | null | undefined => this.following.namesOf(field);

  private get knownNow(): string {
    const fields = this.layout.charts.flatMap((spec) => spec.fields);
    return JSON.stringify([this.recorder.of(this.robot)?.wheels, fields.map((field) => this.namesOf(field) ?? String(this.namesOf(field)))]);
  }

  private get robot(): string | undefined {
    return this.app.store.robot?.id;
  }

  private get shown(): Chart[] {
    return [...this.charts.values()].filter(({ element }) => !element.hidden);
  }

  private get lines(): Line[] {
    return this.shown.flatMap(({ lines }) => lines.lines);
  }

  /** A chart's values: those that are held, or the latest. */
  private readonly read: Reader = (source: Source): Series | null =>
    (this.held ?? this.recorder).series(this.robot, source);

  /** From when to when there are values of what is shown. */
  private get extent(): Extent {
    const series = this.lines
      .map(({ stroke }) => this.read(stroke.source))
      .filter((one) => one !== null && this.isOfNow(one)) as Series[];
    return series.length === 0
      ? { first: Number.NaN, latest: Number.NaN }
      : {
          first: Math.min(...series.map(({ first }) => first)),
          latest: Math.max(...series.map(({ latest }) => latest)),
        };
  }

  /** Whether its times are those of the states: some publishers stamp by another clock. */
  private isOfNow({ latest }: Series): boolean {
    const now = (this.held ?? this.recorder).of(this.robot)?.history.latest ?? latest;
    return Math.abs(latest - (Number.isNaN(now) ? latest : now)) < ANOTHER_CLOCK;
  }

  private draw(isUrgent: boolean): void {
    if (this.known !== this.knownNow) {
      this.arrange(); // which draws: the wheels are known with the first state of a robot
      return;
    }
    const { extent, cursor } = this;
    const isHeld = this.view.isHeld;
    const range = this.view.range(extent);
    const now = performance.now();
    this.tellTime(range, extent.latest);
    for (const chart of this.shown) {
      const faultOf = (field: Field): string | null => this.following.faultOf(field);
      const shown = { range, latest: extent.latest, cursor, isHeld, playhead: this.now, faultOf };
      chart.show(this.read, shown, now, isUrgent);
    }
    if (!isUrgent) {
      clearTimeout(this.last); // what is not due now is drawn even if nothing comes after it
      this.last = setTimeout(() => this.draw(true), AT_LAST);
    }
  }

  /** Tell which time is looked at, where it is held: that of the cursor, else the last. */
  private tellTime([from, to]: readonly [number, number], latest: number): void {
    const isHeld = this.view.isHeld && this.app.store.recording === null;
    const time = isHeld ? Math.min(from + (this.cursor ?? 1) * (to - from), latest) : null;
    if (time !== this.told) {
      this.told = time;
      this.onTime(time);
    }
  }

  /** Draw at the next frame, once, whatever happens until then. */
  private drawSoon(isUrgent = true): void {
    if (this.moving === 0) {
      this.moving = requestAnimationFrame(() => {
        this.moving = 0;
        this.draw(isUrgent);
      });
    }
  }

  private portOf(id: number): ChartPort {
    return {
      add: (field) => this.complain(this.layout.add(field, id)),
      ask: () => (this.target.value = { id, name: this.charts.get(id)?.name ?? '' }),
      removeField: (field) => this.layout.removeField(id, field),
      remove: () => this.layout.removeChart(id),
      setXy: (on) => this.layout.setXy(id, on),
      replace: (field, by) => this.layout.replaceField(id, field, by),
      setBounds: (bounds) => this.layout.setBounds(id, bounds),
      cursor: (share) => {
        this.cursor = share;
        this.drawSoon(false);
      },
      step: (share) => this.step(id, share),
      zoom: (share, ratio) => this.look(() => this.view.zoom(share, ratio, this.extent)),
      pan: (share) => this.look(() => this.view.pan(share, this.extent)),
      choosing: () => {},
      choose: ([from, to]) => this.look(() => this.view.select(from, to, this.extent)),
      follow: () => this.pause(false),
    };
  }

  /** A key moves the cursor; once it rests, the values there are said. */
  private step(id: number, share: number): void {
    this.cursor = Math.min(1, Math.max(0, (this.cursor ?? 1) + share));
    this.drawSoon(false);
    clearTimeout(this.sayLater);
    this.sayLater = setTimeout(() => {
      const [from, to] = this.view.range(this.extent);
      const time = from + (this.cursor ?? 1) * (to - from);
      const words = this.charts.get(id)?.words(this.read, time) ?? '';
      setText(this.live, `${timeText(time)}: ${words}`);
    }, SAID_AFTER);
  }

  /** Look at another time: it is held, with all that there is of it. */
  private look(move: () => void): void {
    this.held ??= this.recorder.hold(this.robot);
    move();
    this.sayHeld();
    this.drawSoon();
  }

  private setWindow(seconds: number): void {
    this.view.setWindow(seconds);
    remember('window', String(seconds));
    this.draw(true);
  }

  /** Hold what is seen, and all that is kept, or follow what comes; recording goes on. */
  private pause(on: boolean): void {
    if (on) {
      this.held ??= this.recorder.hold(this.robot);
      this.view.hold(this.extent);
    } else {
      this.held = null;
      this.view.follow();
    }
    this.sayHeld();
    this.draw(true);
  }

  private sayHeld(): void {
    const [from, to] = this.view.range(this.extent);
    this.heldAt.value = this.view.isHeld ? `${timeText(from)} to ${timeText(to)}` : null;
  }

  private addText(text: string): boolean {
    const field = parseField(text);
    if (field === null) {
      return false;
    }
    this.complain(this.layout.add(field, this.target.value?.id ?? null));
    return true;
  }

  private complain(why: string | null): void {
    if (why !== null) {
      this.app.store.note('warning', why);
    }
  }

  private takeDrops(beside: HTMLElement): void {
    const dragged = (is: boolean): void => void this.element.classList.toggle('dragged', is);
    window.addEventListener('dragstart', (event) => dragged(isField(event.dataTransfer)));
    window.addEventListener('dragend', () => dragged(false));
    for (const place of [beside, this.place]) {
      place.addEventListener('dragover', (event) => {
        if (isField(event.dataTransfer)) {
          event.preventDefault();
        }
      });
      place.addEventListener('drop', (event) => {
        const field = droppedField(event.dataTransfer);
        if (field !== null) {
          event.preventDefault();
          this.complain(this.layout.add(field));
        }
      });
    }
  }
}
