// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import type uPlot from 'uplot';
import { connectedApp, drawn, graphOf, robotInfo, texts, type TestApp } from './page';
import type { Names } from '../src/channels';
import type { FieldFeed } from '../src/plots/following';
import { decode } from '../src/plots/layout';
import { chartLines } from '../src/plots/lines';
import { lanes, overFirst, type Painting } from '../src/plots/painting';
import { Recorder } from '../src/plots/recorder';
import { Track } from '../src/plots/series';

type Follower = Parameters<FieldFeed['plot']>[2];

// What a chart needs of a browser, beyond a document: it has no size here, so that nothing is drawn.
Object.assign(window, { matchMedia: () => ({ matches: false, addEventListener: () => {} }) });
Object.assign(globalThis, {
  requestAnimationFrame: (call: () => void) => setTimeout(call),
  matchMedia: window.matchMedia,
  devicePixelRatio: 1,
  CustomEvent: window.CustomEvent,
  Node: window.Node,
  navigator: window.navigator,
  getComputedStyle: window.getComputedStyle.bind(window),
});
const { PlotsPanel } = await import('../src/plots/panel');

/** What the panel wishes to follow, by name. */
class Feed implements FieldFeed {
  readonly followers = new Map<string, Follower>();

  plot(topic: string, path: string, follower: Follower): () => void {
    this.followers.set(`${topic}:${path}`, follower);
    return () => void this.followers.delete(`${topic}:${path}`);
  }

  say(name: string, stamps: number[], values: number[], lost = 0, names: Names = {}): void {
    const batch = { stamps: Float64Array.from(stamps), values: Float64Array.from(values), lost, names };
    this.followers.get(name)?.take(batch);
  }
}

const SPEED = '/odom:twist.twist.linear.x';
const field = { topic: '/odom', path: 'twist.twist.linear.x' };

function plots(): { app: TestApp; feed: Feed; recorder: Recorder; panel: InstanceType<typeof PlotsPanel> } {
  localStorage.clear();
  const [app, feed, recorder] = [connectedApp(), new Feed(), new Recorder(() => [])];
  const panel = new PlotsPanel(app, recorder, feed);
  panel.layout.reset(); // what another test chose lasts a visit
  return { app, feed, recorder, panel };
}

function type(panel: { element: HTMLElement }, text: string): void {
  const input = panel.element.querySelector('.plot-search input') as HTMLInputElement;
  input.value = text;
  input.dispatchEvent(new Event('input', { bubbles: true }));
}

function submit(panel: { element: HTMLElement }): void {
  const form = panel.element.querySelector('.plot-search') as HTMLFormElement;
  form.dispatchEvent(new Event('submit', { bubbles: true, cancelable: true }));
}

function shown(panel: { element: HTMLElement }): string[] {
  return [...panel.element.querySelectorAll<HTMLElement>('.chart:not([hidden]) .chart-title')].map(
    (title) => title.textContent,
  );
}

test('the charts of the robot are there, that of the simulator where there is one', () => {
  const { panel } = plots();
  assert.deepEqual(shown(panel), ['Linear velocity', 'Angular velocity', 'Wheel speeds']);
  assert.deepEqual(texts(panel, '.chart:first-child th'), ['command', 'odometry', 'truth']);
});

test('a chart that is added is scrolled to, and those that were there are not', () => {
  const { panel } = plots();
  const scrolled: string[] = [];
  mock.method(window.HTMLElement.prototype, 'scrollIntoView', function scroll(this: Element) {
    scrolled.push(this.textContent);
  });
  panel.toggle(field);
  panel.layout.reset();
  assert.equal(scrolled.length, 1);
  assert.match(scrolled[0]!, /^\/odom linear/);
  mock.restoreAll();
});

test('a robot without wheels has no chart of their speeds', () => {
  const { app, panel, recorder } = plots();
  Object.assign(recorder, { of: () => ({ wheels: [], history: { column: () => null, latest: Number.NaN } }) });
  app.say(graphOf([robotInfo()]));
  assert.deepEqual(shown(panel), ['Linear velocity', 'Angular velocity']);
});

test('a field that is searched for is followed, kept, and said in the legend of its chart', async () => {
  const { feed, panel, recorder } = plots();
  type(panel, '/odom twist.twist.linear.x');
  await drawn();
  submit(panel);
  assert.equal(shown(panel).at(-1), '/odom linear');
  assert.deepEqual([...feed.followers.keys()], [SPEED]);
  feed.say(SPEED, [1, 1.5], [0.25, 0.375]);
  panel.repaint();
  assert.deepEqual(texts(panel, '.chart:last-child th'), ['linear.x']);
  assert.equal(texts(panel, '.chart:last-child td')[0], '0.38');
  assert.equal(recorder.series(undefined, field)?.latest, 1.5);
});

test('what is made of a field is chosen in the settings of its chart, and follows what comes', async () => {
  const { feed, panel } = plots();
  panel.toggle(field);
  panel.toggle({ topic: '/odom', path: 'twist.twist.linear.y' });
  await drawn();
  const select = (): HTMLSelectElement => [...panel.element.querySelectorAll<HTMLSelectElement>('.chart-making select')][0]!;
  assert.deepEqual([...select().options].map(({ value }) => value).slice(-1), ['~minus=/odom:twist.twist.linear.y']);
  for (const [value, expected] of [['~d', '2.00'], ['~minus=/odom:twist.twist.linear.y', '4.00']] as const) {
    select().value = value;
    select().dispatchEvent(new Event('change', { bubbles: true }));
    feed.say('/odom:twist.twist.linear.y', [1, 2], [1, 1]);
    feed.say(SPEED, [1, 2], [3, 5]);
    panel.repaint();
    assert.equal(texts(panel, '.chart:last-child td')[0], expected);
    assert.equal(texts(panel, '.chart:last-child th')[0], `linear.x${value}`);
  }
  assert.equal(select().value, '~minus=/odom:twist.twist.linear.y');
  panel.layout.reset();
  assert.deepEqual([...feed.followers.keys()], [], 'both numbers are let go');
});

test('states are said by their names, and forgotten where a node numbers its texts otherwise', () => {
  const { feed, panel, recorder } = plots();
  panel.toggle(field);
  const names = { 0: 'idle', 1: 'driving' };
  feed.say(SPEED, [1, 2], [0, 1], 0, names);
  panel.repaint();
  assert.equal(texts(panel, '.chart:last-child td')[0], 'driving');
  feed.say(SPEED, [3], [2], 0, { ...names, 2: 'lost' });
  assert.equal(recorder.series(undefined, field)?.first, 1);
  feed.say(SPEED, [4], [0], 0, { 0: 'lost' });
  assert.equal(recorder.series(undefined, field)?.first, 4);
  panel.toggle(field);
  const other = { topic: '/other', path: 'state' };
  const difference = { ...field, steps: [{ by: 'minus', other }] } as const;
  panel.toggle(difference);
  for (const time of [5, 6, 7]) {
    feed.say(SPEED, [time], [1], 0, names);
    feed.say('/other:state', [time], [0], 0, { 0: 'false', 1: 'true' });
  }
  assert.equal(recorder.series(undefined, difference)?.first, 5, 'of two states each has its own names');
  feed.followers.get('/other:state')?.fail('nobody publishes it');
  feed.say(SPEED, [8], [1], 0, names);
  panel.repaint();
  assert.equal(texts(panel, '.chart:last-child td')[0], 'nobody publishes it');
});

test('a chart is drawn over its first field on demand', async () => {
  const { panel } = plots();
  panel.toggle(field);
  const box = (): HTMLInputElement => panel.element.querySelector('.chart:last-child [type=checkbox]')!;
  assert.equal(box().parentElement?.hidden, true, 'one field is over nothing');
  panel.toggle({ topic: '/odom', path: 'twist.twist.linear.y' });
  await drawn();
  assert.equal(box().parentElement?.hidden, false);
  box().click();
  box().dispatchEvent(new Event('change', { bubbles: true }));
  assert.match(panel.layout.text, /;xy,\/odom:twist\.twist\.linear\.x,\/odom:twist\.twist\.linear\.y$/);
  assert.equal(texts(panel, '.chart:last-child .fine')[0], 'over linear.x');
});

test('while one searches, topics are offered, then numbers and texts of those that are meant', async () => {
  const { app, panel } = plots();
  const input = panel.element.querySelector('.plot-search input') as HTMLInputElement;
  assert.deepEqual(panel.watches, []);
  input.dispatchEvent(new Event('focus'));
  assert.deepEqual(panel.watches, ['topics']);
  const ends = { publishers: [], subscriptions: [], rate: null };
  const many = Array.from({ length: 7 }, (_, index) => ({ name: `/t${index}`, kinds: ['a/T'], ...ends }));
  app.say({ type: 'topics', nodes: [], topics: [{ name: '/odom', kinds: ['a/Odom'], ...ends }, ...many] });
  await drawn();
  assert.equal(texts(panel, 'datalist option').length, 8);
  const asked = () => app.sent.filter((message) => message.type === 'definition');
  assert.equal(asked().length, 0, 'of many topics, nothing is asked');
  type(panel, 'ODOM');
  await drawn();
  assert.deepEqual(asked().map(({ message }) => message), ['a/Odom']);
  const plain = { length: null, fields: [], value: 0 };
  const data = [
    { ...plain, name: 'frame', kind: 'string' },
    { ...plain, name: 'twist', kind: 'a/V', fields: [{ ...plain, name: 'x', kind: 'double' }] },
    { ...plain, name: 'covariance', kind: 'double', length: 36 },
  ];
  app.say({ type: 'reply', id: asked()[0]!.id, ok: true, message: '', data, again: null });
  await drawn();
  assert.deepEqual(texts(panel, 'datalist option'), ['/odom:frame', '/odom:twist.x', '/odom:covariance[0]']);
  type(panel, '/odom tw');
  await drawn();
  assert.deepEqual(texts(panel, 'datalist option'), ['/odom:twist.x']);
  input.dispatchEvent(new Event('blur'));
  assert.deepEqual(panel.watches, []);
});

test('behind the latest value, nothing is said of what has not come', async () => {
  const { feed, panel } = plots();
  panel.toggle(field);
  feed.say(SPEED, [0, 2], [0.25, 0.5]);
  const place = panel.element.querySelector('.chart:last-child .chart-plot') as HTMLElement;
  const press = (key: string) =>
    place.dispatchEvent(Object.assign(new Event('keydown', { bubbles: true }), { key }));
  const value = () => texts(panel, '.chart:last-child td')[0];
  press('ArrowLeft');
  await drawn();
  assert.equal(value(), '–');
  for (let step = 0; step < 50; step += 1) {
    press('ArrowLeft');
  }
  await drawn();
  assert.equal(value(), '0.25');
});

test('what is no field is not plotted', async () => {
  const { feed, panel } = plots();
  type(panel, 'odom');
  await drawn();
  submit(panel);
  assert.equal(feed.followers.size, 0);
  assert.equal(shown(panel).length, 3);
});

test('a field that does not exist says why in its legend, until it comes', () => {
  const { feed, panel } = plots();
  panel.toggle(field);
  feed.followers.get(SPEED)?.fail('nav_msgs/msg/Odometry has no field twist.twist.linear.x');
  panel.repaint();
  assert.match(texts(panel, '.chart:last-child td')[0] ?? '', /has no field/);
  feed.say(SPEED, [1], [0.5]);
  panel.repaint();
  assert.equal(texts(panel, '.chart:last-child td')[0], '0.50');
});

test('a field that is dropped on a chart joins it, and its button takes it out', () => {
  const { feed, panel } = plots();
  const [chart] = panel.element.querySelectorAll('.chart');
  const drop = new Event('drop', { bubbles: true, cancelable: true });
  const transfer = { types: ['application/x-amr-field'], getData: () => SPEED };
  chart!.dispatchEvent(Object.assign(drop, { dataTransfer: transfer }));
  assert.equal(shown(panel).length, 3, 'no chart of its own');
  assert.deepEqual(texts(panel, '.chart:first-child th'), ['command', 'odometry', 'truth', 'linear.x']);
  (panel.element.querySelector('.legend button') as HTMLButtonElement).click();
  assert.equal(feed.followers.size, 0);
});

test('messages that were lost leave a gap', () => {
  const { feed, panel, recorder } = plots();
  panel.toggle(field);
  feed.say(SPEED, [1], [1]);
  feed.say(SPEED, [5], [2], 3);
  const found: number[] = [];
  recorder.series(undefined, field)?.visit(0, 9, 0, (_, value) => found.push(value));
  assert.deepEqual(found, [1, Number.NaN, 2]);
});

test('arrow keys move one cursor over all charts, and what is there is said', async () => {
  const { feed, panel } = plots();
  panel.toggle(field);
  feed.say(SPEED, [1, 2], [0.25, 0.5]);
  const place = panel.element.querySelector('.chart:last-child .chart-plot') as HTMLElement;
  const press = (key: string, shiftKey = false) =>
    place.dispatchEvent(Object.assign(new Event('keydown', { bubbles: true }), { key, shiftKey }));
  press('ArrowLeft');
  await drawn();
  const cursors = [...panel.element.querySelectorAll<HTMLElement>('.chart-cursor')];
  assert.ok(cursors.every(({ hidden }) => !hidden));
  const [live] = panel.element.querySelectorAll('[role=status]');
  const said = async () => {
    while (live!.textContent === '') {
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    return live!.textContent;
  };
  assert.match(await said(), /^\d+\.\d\d s: linear\.x 0\.50$/);
});

test('pausing holds what is seen while recording goes on; so does looking at another time', async () => {
  const { feed, panel, recorder } = plots();
  panel.toggle(field);
  feed.say(SPEED, [1], [0.25]);
  const told: (number | null)[] = [];
  panel.onTime = (time) => told.push(time);
  const pause = panel.element.querySelector('.toggle') as HTMLButtonElement;
  pause.click();
  feed.say(SPEED, [2], [0.5]);
  panel.repaint();
  await drawn();
  assert.equal(pause.getAttribute('aria-pressed'), 'true');
  assert.equal(texts(panel, '.chart:last-child td')[0], '0.25');
  assert.equal(recorder.series(undefined, field)?.at(2), 0.5);
  panel.follow();
  await drawn();
  assert.deepEqual(told, [1, null], 'who shows other things of that time is told');
  assert.equal(texts(panel, '.chart:last-child td')[0], '0.50');
  const place = panel.element.querySelector('.chart:last-child .chart-plot') as HTMLElement;
  place.dispatchEvent(Object.assign(new Event('keydown', { bubbles: true }), { key: '+' }));
  await drawn();
  assert.equal(pause.getAttribute('aria-pressed'), 'true', 'zoomed');
});

/** What is called on a canvas of a pixel a unit, in which a letter is one wide. */
function calls({ paint }: Painting): [string, ...unknown[]][] {
  const made: [string, ...unknown[]][] = [];
  const ctx = new Proxy({}, {
    get: (_, name: string) => (...given: unknown[]) => {
      made.push([name, ...given]);
      return { width: 10 * String(given[0]).length };
    },
  });
  paint({ ctx, valToPos: (value: number, scale: string) => (scale === 'x' ? value : 100 - 50 * value) } as unknown as uPlot);
  return made.filter(([name]) => name !== 'measureText');
}

function track(...samples: [number, number][]): Track {
  const made = new Track();
  samples.forEach(([time, value]) => made.push(time, value));
  return made;
}

test('each state has a lane, in which each value lasts until the next', () => {
  const names = { 0: 'idle', 1: 'a very long name' };
  const about = chartLines(decode('/a:mode,/a:on')[0]!, [], () => names);
  assert.equal(about.form, 'lanes');
  const mode = track([0, 0], [100, 0], [200, 1], [230, NaN], [260, 0]);
  const painting = lanes(about, ({ name }) => (name === 'mode' ? mode : null), [50, 300], 280);
  assert.deepEqual([painting.x, painting.y], [[50, 300], [0, 2]]);
  const made = calls(painting);
  const spans = made.filter(([name], index) => name === 'fillRect' && index % 3 === 0).map(([, x, y, width]) => [x, y, width]);
  assert.deepEqual(spans, [[50, 3, 150], [200, 3, 30], [260, 3, 20]]);
  assert.deepEqual(made.filter(([name]) => name === 'fillText').map(([, text]) => text), ['mode: idle', 'a…', '']);
});

test('a number among states makes lines of all', () => {
  const about = chartLines(decode('/a:mode,/a:x')[0]!, [], ({ path }) => (path === 'x' ? null : { 0: 'idle' }));
  assert.equal(about.form, 'time');
});

test('fields are drawn over the first one, with gaps where one of them is not known', () => {
  const about = chartLines(decode('xy,/a:x,/a:y')[0]!, [], () => null);
  const known: Record<string, Track> = {
    x: track([0, 10], [1, 20], [2, 30], [3, NaN], [4, 50]), y: track([0, 0], [1, 1], [2, 0], [3, 1], [4, 1]),
  };
  const painting = overFirst(about, ({ name }) => known[name]!, [0, 4])!;
  assert.deepEqual(painting.y, [0, 1]);
  const made = calls(painting).filter(([name]) => /To|arc/.test(name));
  assert.deepEqual(made.map(([name, x, y]) => [name, x, y]), [
    ['moveTo', 10, 100], ['lineTo', 20, 50], ['lineTo', 30, 100], ['moveTo', 50, 50], ['arc', 50, 50],
  ]);
  assert.equal(overFirst(about, () => null, [0, 4]), null);
});
