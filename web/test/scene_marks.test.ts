// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Box3, Matrix4, Vector3, type Color } from 'three';
import { axisLength } from '../src/scene/axes';
import { NavigationLayer } from '../src/scene/navigation';
import type { Ribbon } from '../src/scene/ribbon';
import { RobotMark } from '../src/scene/robot_mark';
import { Slots } from '../src/scene/slots';
import { PALETTES } from '../src/scene/theme';

/** The contrast of two colours of a style sheet, as WCAG 2 defines it. */
function contrast(one: string, other: string): number {
  const luminance = (colour: string): number => {
    const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => {
      const share = parseInt(colour.slice(at, at + 2), 16) / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const [low = 0, high = 0] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

for (const [theme, palette] of Object.entries(PALETTES)) {
  test(`trails and robots can be seen on the ground of a ${theme} page`, () => {
    for (const colour of [palette.truth, palette.odometry, ...palette.robots]) {
      assert.ok(contrast(colour, palette.ground) >= 3, `${colour} on ${palette.ground}`);
    }
    assert.ok(contrast(palette.truth, palette.odometry) >= 1.4, 'one is lighter than the other');
  });

  test(`names of robots can be read on a ${theme} page`, () => {
    for (const colour of palette.robots) {
      assert.ok(contrast(colour, palette.robotText) >= 4.5, colour);
    }
    assert.equal(new Set(palette.robots).size, palette.robots.length);
  });
}

test('a name keeps its number, and what it leaves is given to the next', () => {
  const slots = new Slots();
  slots.keep(['/robot1', '/robot2', '/robot3']);
  assert.deepEqual(['/robot1', '/robot2', '/robot3'].map((name) => slots.of(name)), [0, 1, 2]);
  slots.keep(['/robot2', '/robot3']);
  slots.keep(['/another', '/robot2', '/robot3']);
  assert.deepEqual(['/another', '/robot2', '/robot3'].map((name) => slots.of(name)), [0, 1, 2]);
});

test("axes of an arm's frames are shorter than its links, and those of a robot of one link are seen", () => {
  const arm = axisLength([0, 0.1, 0.12, 0.1, 0.1, 0, 0.08], 1.2);
  assert.ok(Math.abs(arm - 0.045) < 1e-9, String(arm));
  assert.equal(axisLength([0], 0.6), 0.28 * 0.6);
  assert.equal(axisLength([], 2), 0.28 * 2);
  assert.equal(axisLength([0.02, 0.02], 1), 0.035, 'never too short to be seen');
});

test('the arrow stands ahead of the robot, on what the robot stands on', () => {
  const mark = new RobotMark();
  mark.setLook({ colour: '#123456', hasRing: true, hasFront: true, isChosen: false });
  mark.measure(new Box3(new Vector3(-0.3, -0.2, -0.05), new Vector3(0.5, 0.2, 0.4)));
  mark.place(new Matrix4().makeTranslation(2, 0, 0.05));
  mark.object.updateMatrixWorld(true);
  const [ring, arrow] = mark.object.children.map((each) => new Box3().setFromObject(each));
  assert.ok(ring !== undefined && arrow !== undefined);
  assert.ok(arrow.min.x > 2.5 && arrow.max.x > arrow.min.x, 'ahead is along x');
  assert.ok(ring.min.x < 1.7 && ring.max.x > 2.5, 'around it');
  for (const { min, max } of [ring, arrow]) {
    assert.ok(min.z > 0 && max.z < 0.02);
  }
  mark.place(null);
  assert.equal(mark.object.visible, false);
});

test('the path to a goal that has ended fades, until the next one comes', () => {
  const layer = new NavigationLayer(() => {}, (text) => assert.equal(text, ''));
  layer.setPalette(PALETTES.light);
  const head = { type: 'path', origin: { topic: '/plan', frame: 'map', stamp: 0 } };
  const info = { topic: '/plan', robot: '/', kind: 'path' };
  const plan = (): void => {
    const floats = new Float32Array([0, 0, 0, 1, 0, 0]);
    layer.take(info as never, { head, floats } as never);
  };
  plan();
  const [, routes] = layer.object.children;
  const colour = (): string => {
    const { material } = routes!.children[0] as Ribbon['object'];
    return `#${(material.uniforms as { colour: { value: Color } }).colour.value.getHexString()}`;
  };
  layer.setGoals([{ robot: '/', frame: 'map', x: 1, y: 0, yaw: 0 } as never]);
  assert.equal(colour(), PALETTES.light.path);
  layer.setGoals([]);
  assert.equal(colour(), PALETTES.light.gridMajor);
  plan();
  assert.equal(colour(), PALETTES.light.path);
});
