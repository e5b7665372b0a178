// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { parentOf, parseField, shortNames } from '../src/plots/field';
import { decode, encode, PlotLayout } from '../src/plots/layout';
import { TimeView } from '../src/plots/time_view';

const SPEED = { topic: '/odom', path: 'twist.twist.linear.x' };
const TURN = { topic: '/imu', path: 'angular_velocity.z' };
const USUAL = 'linear;angular;wheels;factor';

function layout(kept: string | null = null, link: string | null = null): PlotLayout & { kept: string[] } {
  const texts: string[] = [];
  return Object.assign(new PlotLayout(kept, (text) => texts.push(text), link), { kept: texts });
}

test('a field is written as topic and path', () => {
  assert.deepEqual(parseField(' /odom twist.twist.linear.x '), SPEED);
  assert.deepEqual(parseField('/odom:twist.twist.linear.x'), SPEED);
  assert.deepEqual(parseField('/scan: ranges[3]'), { topic: '/scan', path: 'ranges[3]' });
  for (const text of ['', 'odom x', '/odom', '/odom x y', '/odom:']) {
    assert.equal(parseField(text), null, text);
  }
});

test('names in a legend are as short as they can be told apart', () => {
  assert.deepEqual(shortNames([SPEED, TURN]), ['linear.x', 'angular_velocity.z']);
  const pose = { topic: '/odom', path: 'pose.pose.linear.x' };
  assert.deepEqual(shortNames([SPEED, pose]), ['twist.linear.x', 'pose.linear.x']);
  const truth = { ...SPEED, topic: '/truth' };
  assert.deepEqual(shortNames([SPEED, truth]), ['/odom:twist.twist.linear.x', '/truth:twist.twist.linear.x']);
  assert.deepEqual(shortNames([{ topic: '/a', path: 'data' }]), ['data']);
  assert.deepEqual(shortNames([SPEED, { ...SPEED, steps: [{ by: 'd' }] }]), ['linear.x', 'linear.x~d']);
});

test('what a number is of: a vector, an array, a message, or nothing but its topic', () => {
  const parent = (path: string) => parentOf({ topic: '/t', path }).path;
  const paths = ['twist.linear.x', 'position[3]', 'data', 'a[2].b', 'a[2].b[0]'];
  assert.deepEqual(paths.map(parent), ['twist.linear', 'position', '', 'a[2]', 'a[2].b']);
});

test('without a layout the charts of the robot are there', () => {
  assert.equal(encode(layout().charts), USUAL);
});

test('fields join a chart or get one; it is kept, and without lines it goes', () => {
  const plots = layout();
  assert.equal(plots.add(SPEED), null);
  const own = plots.charts.at(-1)!;
  assert.equal(plots.add(TURN, own.id), null);
  plots.add(TURN, own.id); // twice is once
  plots.setBounds(own.id, [-1, null]);
  assert.equal(plots.kept.at(-1), `${USUAL};/odom:twist.twist.linear.x,/imu:angular_velocity.z@-1..`);
  assert.equal(plots.isPlotted(TURN), true);
  plots.removeField(own.id, SPEED);
  plots.toggle(TURN);
  assert.equal(encode(plots.charts), USUAL);
  plots.removeChart(plots.charts[0]!.id);
  assert.equal(plots.kept.at(-1), 'angular;wheels;factor');
});

test('numbers of one vector that are ticked share a chart; others, and what is full, do not', () => {
  const plots = layout('');
  const tick = (topic: string, path: string) => plots.toggle({ topic, path });
  tick('/odom', 'twist.linear.x');
  tick('/odom', 'twist.linear.y');
  tick('/odom', 'twist.angular.z');
  tick('/truth', 'twist.linear.x');
  tick('/joints', 'position[0]');
  tick('/joints', 'position[1]');
  assert.deepEqual(plots.charts.map(({ fields }) => fields.map(({ path }) => path)), [
    ['twist.linear.x', 'twist.linear.y'], ['twist.angular.z'], ['twist.linear.x'],
    ['position[0]', 'position[1]'],
  ]);
  for (let index = 2; index < 14; index += 1) {
    assert.equal(tick('/joints', `position[${index}]`), null);
  }
  assert.deepEqual(plots.charts.slice(3).map(({ fields }) => fields.length), [12, 2]);
});

test('a layout is the same after it was kept or sent as a link', () => {
  const text = 'linear,/odom:twist.twist.linear.x@-1..1;/scan:ranges%5B3%5D;wheels@..2.5;xy,/a:x,/a:y~lowpass=0.5';
  assert.equal(encode(decode(text)), text);
  assert.equal(encode(layout(text).charts), text);
  const shared = layout(USUAL, text);
  assert.equal(encode(shared.charts), text);
  assert.equal(shared.text, text);
  assert.deepEqual(shared.kept, [], 'one’s own layout stays until something is changed');
});

test('a line is replaced by what is made of it, in its place and once', () => {
  const plots = layout('/odom:twist.twist.linear.x,/imu:angular_velocity.z');
  const { id } = plots.charts[0]!;
  const made = parseField('/odom:twist.twist.linear.x~d')!;
  plots.replaceField(id, SPEED, made);
  assert.equal(plots.kept.at(-1), '/odom:twist.twist.linear.x~d,/imu:angular_velocity.z');
  assert.deepEqual(decode(plots.kept.at(-1)!)[0]!.fields, [made, TURN]);
  assert.deepEqual([plots.isPlotted(SPEED), plots.isPlotted(made)], [false, true]);
  plots.add(SPEED, id);
  plots.replaceField(id, SPEED, made);
  assert.deepEqual(plots.charts[0]!.fields, [made, TURN]);
  assert.equal(plots.toggle({ topic: '/odom', path: 'twist.twist.linear.y' }), null);
  assert.equal(plots.charts.length, 2, 'a vector and its derivative are not drawn together');
});

test('of a link that is none, nothing is taken', () => {
  for (const text of ['', '%zz;;@;,', 'nonsense,<b>']) {
    assert.equal(encode(layout(null, text).charts), USUAL, text);
  }
  assert.equal(encode(decode('linear@2..1')), 'linear', 'bounds in disorder are none');
  assert.equal(encode(decode('linear@a..b')), 'linear');
  assert.equal(encode(decode('xy;xy,linear')), 'linear', 'over what, is not said');
  const much = Array.from({ length: 99 }, (_, index) => `/t${index}:x`);
  assert.equal(decode(much.join(';')).length, 12);
  assert.equal(decode(much.join(','))[0]!.fields.length, 12);
});

test('no more charts and lines than can be seen; it is said why', () => {
  const plots = layout();
  for (let index = 0; index < 8; index += 1) {
    assert.equal(plots.add({ topic: '/t', path: `x${index}` }), null);
  }
  assert.match(plots.add(SPEED) ?? '', /12 charts/);
  const { id } = plots.charts[0]!;
  for (let index = 0; index < 12; index += 1) {
    assert.equal(plots.add({ topic: '/t', path: `y${index}` }, id), null);
  }
  assert.match(plots.add(SPEED, id) ?? '', /12 fields/);
});

test('time begins where the samples do: nothing is empty before', () => {
  const view = new TimeView(30, 300);
  const none = { first: Number.NaN, latest: Number.NaN };
  assert.deepEqual(view.range(none), [0, 30]);
  assert.deepEqual(view.range({ first: 0.02, latest: 5 }), [0, 30]);
  assert.deepEqual(view.range({ first: 222, latest: 230 }), [222, 252]);
  assert.deepEqual(view.range({ first: 222, latest: 300 }), [270, 300]);
});

test('one zooms, goes on and comes back', () => {
  const view = new TimeView(30, 300);
  const extent = { first: 0, latest: 100 };
  view.zoom(1, 0.5, extent);
  assert.deepEqual(view.range(extent), [85, 100]);
  assert.equal(view.isHeld, true);
  assert.deepEqual(view.range({ first: 0, latest: 110 }), [85, 100], 'it is held');
  view.pan(-1, extent);
  assert.deepEqual(view.range(extent), [70, 85]);
  view.pan(-100, extent);
  assert.deepEqual(view.range(extent), [0, 15], 'not before the first sample');
  view.pan(100, extent);
  assert.deepEqual(view.range(extent), [85, 100], 'nor behind the last');
  view.select(0.8, 0.2, extent);
  assert.deepEqual(view.range(extent), [88, 97]);
  view.zoom(0.5, 1000, extent);
  assert.deepEqual(view.range(extent), [0, 100], 'no more than there is');
  view.setWindow(10);
  assert.deepEqual(view.range(extent), [90, 100]);
  view.follow();
  assert.deepEqual(view.range({ first: 0, latest: 120 }), [110, 120]);
});

test('a zoom has an end', () => {
  const view = new TimeView(30, 300);
  const extent = { first: 0, latest: 1000 };
  view.zoom(0.5, 1e-9, extent);
  const [from, to] = view.range(extent);
  assert.ok(to - from > 0.01);
  view.zoom(0.5, 1e9, extent);
  const [begin, end] = view.range(extent);
  assert.ok(end - begin <= 300);
});
