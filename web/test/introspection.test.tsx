// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fitted, layered } from '../src/graph/layered';
import { framesPicture, nodesPicture } from '../src/graph/shown';
import { graphPanel } from '../src/panels/graph';
import { logPanel } from '../src/panels/log';
import { valuesOf } from '../src/panels/message_form';
import { numberOf } from '../src/panels/message_tree';
import { parametersPanel } from '../src/panels/parameters';
import { servicesPanel } from '../src/panels/services';
import { topicsPanel } from '../src/panels/topics';
import type { FieldInfo, FrameStatus, LogLine, ParameterInfo, TopicInfo } from '../src/protocol';
import type { Sample } from '../src/samples';
import { connectedApp, drawn, texts, type TestApp } from './page';

function topic(name: string, from: string[], to: string[], rate: number | null = null): TopicInfo {
  const ends = (nodes: string[]) => nodes.map((node) => ({ node, qos: 'reliable, volatile' }));
  return { name, kinds: ['a/msg/B'], publishers: ends(from), subscriptions: ends(to), rate };
}

const TOPICS = [
  topic('/odom', ['/drive'], ['/page', '/nav'], 50),
  topic('/rosout', ['/drive'], ['/page']),
  topic('/<b>', ['/drive'], []),
];

function withTopics(): TestApp {
  const app = connectedApp();
  app.say({ type: 'topics', nodes: ['/drive', '/nav', '/page', '/alone'], topics: TOPICS });
  return app;
}

const NO_PLOTS = { toggle: () => {}, isPlotted: () => false };

function type(input: Element | null, text: string, event = 'input'): void {
  (input as HTMLInputElement).value = text;
  input?.dispatchEvent(new Event(event, { bubbles: true }));
}

function click(element: Element | null | undefined): void {
  (element as HTMLElement).click();
}

test('topics are found by name, type and node, and their names are text', async () => {
  const panel = topicsPanel(withTopics(), NO_PLOTS);
  assert.deepEqual(texts(panel, '.unit-name'), ['/odom', '/rosout', '/<b>']);
  assert.equal(texts(panel, '.topic .fine')[0], '50 Hz · 1 pub, 2 sub');
  type(panel.element.querySelector('input'), 'NAV b');
  await drawn();
  assert.deepEqual(texts(panel, '.unit-name'), ['/odom']);
  assert.deepEqual(panel.watches, ['topics']);
  click(panel.element.querySelector('[role=switch]'));
  assert.deepEqual(panel.watches, ['topics', 'rates']);
});

test('an open topic echoes its messages; a number of it is plotted', async () => {
  const app = withTopics();
  const plotted: string[] = [];
  const panel = topicsPanel(app, {
    toggle: ({ topic: name, path }) => void plotted.push(`${name}:${path}`),
    isPlotted: ({ path }) => path === 'a.x[0]',
  });
  click(panel.element.querySelector('.topic'));
  await drawn();
  assert.deepEqual(app.channels.messages, ['/odom']);
  const origin = { topic: '/odom', frame: '', stamp: 0, rate: 50 };
  const tree = { a: { x: [1.5, { '#number': 'NaN' }] }, name: '<i>' };
  app.channels.take({
    head: { type: 'message', origin, message: 'a/msg/B', size: 9 },
    bytes: new TextEncoder().encode(JSON.stringify(tree)),
    floats: new Float32Array(),
  } satisfies Sample);
  await drawn();
  assert.deepEqual(texts(panel, '.leaf .number'), ['1.5', 'NaN', '<i>']);
  const numbers = [...panel.element.querySelectorAll('.leaf .number')];
  assert.deepEqual(numbers.map((each) => each.getAttribute('aria-pressed')), ['true', 'false', 'false']);
  click(numbers[1]);
  assert.deepEqual(plotted, ['/odom:a.x[1]']);
  click(panel.element.querySelector('.topic'));
  await drawn();
  assert.deepEqual(app.channels.messages, [], 'what is not drawn is not asked for');
});

const NUMBER: FieldInfo = { name: 'x', kind: 'double', length: null, fields: [], value: 0, constants: {} };
const FIELDS: FieldInfo[] = [
  { ...NUMBER, name: 'stamp', kind: 'builtin_interfaces/msg/Time', value: null },
  { ...NUMBER, name: 'name', kind: 'string', value: '' },
  { ...NUMBER, name: 'linear', kind: 'a/msg/V', value: null, fields: [NUMBER] },
  { ...NUMBER, name: 'list', length: 0, value: null },
  { ...NUMBER, name: 'mode', kind: 'uint8', constants: { MODE_OFF: 0, MODE_ON: 1 } },
];

test('what was typed becomes the values of a message, and the rest are defaults', () => {
  assert.deepEqual(valuesOf(FIELDS, {}), {});
  const typed = { stamp: 'now', name: '3', 'linear.x': '-0.5', list: '[1, 2]' };
  assert.deepEqual(valuesOf(FIELDS, typed), { stamp: 'now', name: '3', linear: { x: -0.5 }, list: [1, 2] });
  assert.deepEqual(valuesOf(FIELDS, { mode: 'MODE_ON' }), { mode: 1 });
  assert.throws(() => valuesOf(FIELDS, { mode: 'MODE_UP' }), /mode is a uint8: "MODE_UP" cannot be read as one/);
  assert.throws(() => valuesOf(FIELDS, { 'linear.x': 'fast' }), /linear\.x is a double: "fast"/);
});

test('a form publishes at a rate until it is closed with its topic', async () => {
  const app = withTopics();
  const panel = topicsPanel(app, NO_PLOTS);
  click(panel.element.querySelector('.topic'));
  await drawn();
  const button = (text: string) =>
    [...panel.element.querySelectorAll('button')].find((each) => each.textContent === text);
  click(button('Publish …'));
  app.say({ type: 'reply', id: 1, ok: true, message: '', data: FIELDS, again: null });
  await drawn();
  type(panel.element.querySelector('[id="field-linear.x"]'), '2');
  await drawn();
  click(button('At 10 Hz'));
  assert.deepEqual(app.sent.at(-1), {
    type: 'publish', id: 2, topic: '/odom', message: 'a/msg/B', values: { linear: { x: 2 } }, rate: 10,
  });
  app.say({ type: 'reply', id: 2, ok: true, message: 'published', data: null, again: null });
  await drawn();
  assert.deepEqual(texts(panel, '.publish output'), ['published']);
  click(panel.element.querySelector('.topic'));
  await drawn();
  assert.deepEqual(app.sent.at(-1), { type: 'unpublish', id: 3, topic: '/odom' });
});

const button = (panel: { element: HTMLElement }, text: string): HTMLButtonElement | undefined =>
  [...panel.element.querySelectorAll('button')].find((each) => each.textContent === text);

function withServices(): { app: TestApp; panel: ReturnType<typeof servicesPanel> } {
  const app = connectedApp();
  const service = (name: string, kind: string, is_action = false) => ({ name, kind, is_action });
  app.say({
    type: 'services',
    services: [
      service('/arm/count', 'a/action/Count', true),
      service('/arm/get_parameters', 'rcl_interfaces/srv/GetParameters'),
      service('/arm/set_it', 'a/srv/SetIt'),
    ],
  });
  return { app, panel: servicesPanel(app) };
}

test('a service is called with what was typed, and its response is shown', async () => {
  const { app, panel } = withServices();
  assert.deepEqual(texts(panel, '.unit-name'), ['/arm/count', '/arm/set_it']);
  click(panel.element.querySelector('[role=switch]'));
  type(panel.element.querySelector('input'), 'param');
  await drawn();
  assert.deepEqual(texts(panel, '.unit-name'), ['/arm/get_parameters']);
  type(panel.element.querySelector('input'), 'set_it');
  await drawn();
  click(panel.element.querySelector('.topic'));
  await drawn();
  assert.deepEqual(app.sent.at(-1), { type: 'definition', id: 1, message: 'a/srv/SetIt' });
  app.say({ type: 'reply', id: 1, ok: true, message: '', data: FIELDS.slice(4), again: null });
  await drawn();
  assert.deepEqual([...panel.element.querySelectorAll('option')].map(({ value }) => value), ['MODE_OFF', 'MODE_ON']);
  type(panel.element.querySelector('[id="field-mode"]'), 'MODE_ON');
  await drawn();
  click(button(panel, 'Call'));
  assert.deepEqual(app.sent.at(-1), {
    type: 'call_service', id: 2, service: '/arm/set_it', kind: 'a/srv/SetIt', values: { mode: 1 },
  });
  app.say({ type: 'reply', id: 2, ok: true, message: 'it answered', data: 'done: <b>\n', again: null });
  await drawn();
  assert.deepEqual([...texts(panel, 'output'), ...texts(panel, 'pre')], ['it answered', 'done: <b>\n']);
});

test('a goal is followed and cancelled, also when its form was shut meanwhile', async () => {
  const { app, panel } = withServices();
  const open = async (): Promise<void> => {
    click(panel.element.querySelector('.topic'));
    await drawn();
  };
  await open();
  app.say({ type: 'reply', id: 1, ok: true, message: '', data: [], again: null });
  await drawn();
  click(button(panel, 'Send goal'));
  assert.deepEqual(app.sent.at(-1), { type: 'send_goal', id: 2, action: '/arm/count', kind: 'a/action/Count', values: {} });
  app.say({ type: 'reply', id: 2, ok: true, message: 'accepted', data: null, again: null });
  app.say({ type: 'goal_progress', goal: 2, state: 'active', text: 'at: 1\n' });
  await open();
  await open();
  assert.deepEqual([...texts(panel, '.chip'), ...texts(panel, 'pre')], ['active', 'at: 1\n']);
  click(button(panel, 'Cancel goal'));
  assert.deepEqual(app.sent.at(-1), { type: 'cancel_sent', id: 4, goal: 2 });
  app.say({ type: 'goal_progress', goal: 2, state: 'canceled', text: 'at: 2\n' });
  await drawn();
  assert.deepEqual([...texts(panel, '.chip'), ...texts(panel, 'pre')], ['canceled', 'at: 2\n']);
  assert.equal(button(panel, 'Cancel goal'), undefined);
});

function line(number: number, level: LogLine['level'], node: string, text: string): LogLine {
  return { number, stamp: number, level, node, text, place: '' };
}

test('the log is sifted by level, node and words, the newest first, each line once', async () => {
  const app = connectedApp();
  const panel = logPanel(app);
  const old = line(1, 'warning', 'sim', 'the <b>wheel</b> slips');
  app.say({ type: 'log', lines: [line(2, 'info', 'sim', 'ready'), line(3, 'error', 'nav', 'lost')] });
  app.say({ type: 'log', lines: [old, line(3, 'error', 'nav', 'lost')] });
  await drawn();
  assert.deepEqual(texts(panel, '.log .words'), ['lost', 'ready', 'the <b>wheel</b> slips']);
  const [level, node] = panel.element.querySelectorAll('select');
  type(level ?? null, 'warning', 'change');
  await drawn();
  assert.deepEqual(texts(panel, '.log .words'), ['lost', 'the <b>wheel</b> slips']);
  type(node ?? null, 'sim', 'change');
  await drawn();
  assert.deepEqual(texts(panel, '.log .words'), ['the <b>wheel</b> slips']);
  type(panel.element.querySelector('input'), 'LOST');
  await drawn();
  assert.deepEqual(texts(panel, '.empty'), ['No line is of this kind.']);
});

const SPEED: ParameterInfo = {
  name: 'speed', kind: 'double', value: 1, read_only: false, description: 'how fast',
  constraints: '', lower: 0, upper: 2, step: null,
};

test('a parameter is set when it is left; the reason of a refusal is beside it', async () => {
  const app = withTopics();
  const panel = parametersPanel(app);
  type(panel.element.querySelector('select'), '/drive', 'change');
  await drawn();
  assert.deepEqual(app.sent.at(-1), { type: 'parameters', id: 1, node: '/drive' });
  app.say({
    type: 'reply', id: 1, ok: true, message: '',
    data: [SPEED, { ...SPEED, name: 'fixed', read_only: true }], again: null,
  });
  await drawn();
  assert.equal(texts(panel, '.parameter .fine')[0], 'double · 0 to 2 · how fast');
  const inputs = panel.element.querySelectorAll<HTMLInputElement>('.parameter input');
  assert.deepEqual([...inputs].map(({ readOnly }) => readOnly), [false, true]);
  type(inputs[0] ?? null, '9', 'blur');
  await drawn();
  assert.deepEqual(app.sent.at(-1), {
    type: 'set_parameter', id: 2, node: '/drive', name: 'speed', kind: 'double', value: 9,
  });
  app.say({ type: 'reply', id: 2, ok: false, message: '/drive refuses speed: 9 > 2', data: null, again: null });
  await drawn();
  assert.deepEqual(texts(panel, '[role=alert]'), ['/drive refuses speed: 9 > 2']);
});

test('the picture of nodes leaves out what nearly all nodes have', () => {
  const all = { type: 'topics' as const, nodes: ['/alone'], topics: TOPICS };
  const few = nodesPicture(all, false, '');
  assert.deepEqual(few.boxes.map(({ id }) => id), ['topic /odom', 'node /drive', 'node /nav', 'node /page']);
  assert.equal(few.edges.length, 3);
  assert.equal(nodesPicture(all, true, '').boxes.length, 7);
  assert.deepEqual(nodesPicture(all, true, '/nav').boxes.map(({ id }) => id)[0], 'topic /odom');
});

function frame(name: string, parents: string[], age: number | null = 0.1, topics = ['/tf']): FrameStatus {
  const [parent = ''] = parents;
  return { name, parent, parents, is_static: age === null, rate: age === null ? null : 20, age, topics };
}

test('the picture of frames marks islands, two parents, and what comes no more', () => {
  const frames = [
    frame('base', ['odom', 'map'], 0.1, ['/tf', '/tf_static']), frame('laser', ['base'], null), frame('arm', ['island'], 9),
  ];
  const { boxes, edges, faults } = framesPicture({ type: 'transforms', frames, publishers: { '/tf': ['/a', '/b'] } });
  assert.equal(faults.length, 2);
  assert.match(faults[0] ?? '', /3 trees that nothing connects: odom, map, island/);
  assert.match(faults[1] ?? '', /base has 2 parents: odom, map; by \/tf of \/a or \/b, and by \/tf_static of nobody now/);
  const tones = new Map(boxes.map(({ id, tone }) => [id, tone]));
  assert.deepEqual([tones.get('base'), tones.get('laser'), tones.get('arm')], ['error', undefined, 'warning']);
  assert.deepEqual(edges.map(({ tone }) => tone), ['error', 'error', 'static', undefined]);
  assert.equal(boxes.find(({ id }) => id === 'base')?.lines[1], '20 Hz, 0.10 s old');
});

test('each box is right of those that lead to it, none on another, with loops and without', () => {
  const boxes = 'abcdefgh'.split('').map((id, index) => ({ id, width: 40 + 9 * index, height: 20 }));
  const edges: [string, string][] = [
    ['a', 'b'], ['b', 'c'], ['a', 'c'], ['c', 'd'], ['e', 'c'], ['d', 'd'], ['f', 'nobody'],
  ];
  const at = new Map(layered(boxes, edges).boxes.map((box) => [box.id, box]));
  for (const [from, to] of edges.slice(0, 5)) {
    const [one, other] = [at.get(from), at.get(to)];
    assert.ok(one !== undefined && other !== undefined && one.x + one.width < other.x, `${from} ${to}`);
  }
  const loop: [string, string][] = [...edges, ['d', 'a'], ['g', 'h'], ['h', 'g']];
  for (const drawing of [layered(boxes, loop), fitted(boxes, loop, 0.1), fitted(boxes, loop, 9)]) {
    assert.equal(drawing.boxes.length, boxes.length);
    for (const one of drawing.boxes) {
      assert.ok(one.x >= 0 && one.x + one.width <= drawing.width + 1e-9);
      assert.ok(one.y >= 0 && one.y + one.height <= drawing.height + 1e-9);
      for (const other of drawing.boxes) {
        const apart =
          one.x + one.width <= other.x || other.x + other.width <= one.x
          || one.y + one.height <= other.y || other.y + other.height <= one.y;
        assert.ok(one === other || apart, `${one.id} ${other.id}`);
      }
    }
  }
});

test('the picture asks for what it shows alone', async () => {
  const app = withTopics();
  const panel = graphPanel(app);
  assert.deepEqual(panel.watches, ['topics']);
  assert.deepEqual(texts(panel, '.box text'), ['/odom', '50 Hz', '/drive', '/nav', '/page']);
  assert.match(texts(panel, 'p.fine')[0] ?? '', /^1 of 4 nodes are not shown/);
  click(panel.element.querySelectorAll('.toggle')[1]);
  await drawn();
  assert.deepEqual(panel.watches, ['transforms']);
});

test('numbers are short, and tell what is none', () => {
  const numbers = [0.1 + 0.2, 7, 1e-9, true, { '#number': 'Infinity' }, 'NaN'];
  assert.deepEqual(numbers.map(numberOf), ['0.3', '7', '1e-9', 'true', 'Infinity', null]);
});
