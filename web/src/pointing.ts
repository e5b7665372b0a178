// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Tools that point at what is in the view: measure between two points, publish one as RViz does. */
import { Matrix4, Vector3 } from 'three';
import { ask, type App } from './app';
import { h, setText, toggle } from './dom';
import { fixed } from './format';
import { mapFrameOf } from './navigation/words';
import type { Scene } from './scene/scene';

const TOPIC = '/clicked_point'; // RViz's
const MESSAGE = 'geometry_msgs/msg/PointStamped';

type Pointer = 'measure' | 'point';

/** The buttons of the tools, the words that say how and what, and a mark of the middle of the view. */
export function pointTools(app: App, scene: Scene): Record<'words' | 'cross', HTMLElement> & { buttons: HTMLElement[] } {
  const words = h('output', { class: 'view-pointing' });
  const cross = h('div', { class: 'view-cross', 'aria-hidden': 'true' });
  let held: Pointer | null = null;
  let from: Vector3 | null = null;
  let at: Vector3 | null = null; // what is pointed at

  const say = (text: string): void => {
    setText(words, text);
    words.hidden = text === '';
  };
  const take = (tool: Pointer | null): void => {
    held = tool;
    from = at = null;
    scene.measure(null, null, '');
    scene.askForPoint(tool === null ? null : pointed, chosen);
    measure.setAttribute('aria-pressed', String(tool === 'measure'));
    point.setAttribute('aria-pressed', String(tool === 'point'));
    cross.hidden = tool === null;
    const how = 'Click it, or Enter takes the middle of the view; Esc leaves';
    say(tool === null ? '' : tool === 'measure' ? `From where? ${how}` : `Which point? ${how}`);
    if (tool !== null) {
      scene.canvas.focus();
    }
  };
  const pointed = (x: number, y: number): void => {
    at = scene.surfaceAt(x, y);
    if (held === 'measure' && from !== null && at !== null) {
      show(from, at);
    }
  };
  const show = (one: Vector3, other: Vector3): void => {
    const { x, y, z } = other.clone().sub(one);
    const text = `${fixed(one.distanceTo(other), 3)} m`;
    scene.measure(one, other, text);
    say(`${text} (x ${fixed(x, 3)}, y ${fixed(y, 3)}, z ${fixed(z, 3)})`);
  };
  const chosen = (): void => {
    if (at === null) {
      say('There is nothing to point at: no ground, no shape');
    } else if (held === 'point') {
      void publish(at);
      take(null);
    } else if (from === null) {
      from = at;
      scene.measure(from, from, '');
      say('To where?');
    } else {
      show(from, at);
      scene.askForPoint(null, chosen); // what was measured stays until the tool is put down
      from = null;
      held = null;
    }
  };
  const publish = async (place: Vector3): Promise<void> => {
    const frame = frameOf(app, scene);
    const pose = scene.poseOfFrame(frame) ?? new Matrix4();
    const [x, y, z] = place.clone().applyMatrix4(pose.clone().invert()).toArray();
    const values = { header: { stamp: 'now', frame_id: frame }, point: { x, y, z } };
    if (await ask(app, { type: 'publish', topic: TOPIC, message: MESSAGE, values, rate: 0 })) {
      const where = [x, y, z].map((each) => fixed(each, 3)).join(', ');
      app.store.note('info', `Published on ${TOPIC}: ${where} in ${frame}`);
    }
  };
  const measure = toggle('Measure', false, (on) => take(on ? 'measure' : null), 'The distance between two points');
  const point = toggle('Publish point', false, (on) => take(on ? 'point' : null), `Publish what is clicked, on ${TOPIC}`);
  app.store.watch(['recording'], () => {
    point.hidden = app.store.recording !== null;
  });
  scene.canvas.addEventListener('keydown', (event) => {
    if (event.key === 'Enter' && held !== null) {
      const { left, top, width, height } = scene.canvas.getBoundingClientRect();
      pointed(left + width / 2, top + height / 2);
      chosen();
    }
  });
  window.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && !words.hidden) {
      take(null);
      if (!app.store.isDriven) {
        event.preventDefault();
        event.stopImmediatePropagation(); // who hits Escape while nothing moves does not want STOP
      }
    }
  }, { capture: true });
  take(null);
  return { buttons: [measure, point], words, cross };
}

/** The frame that points are given in: the map's, else the one that stands still, of those in TF. */
function frameOf({ store }: App, scene: Scene): string {
  const frames = store.layout?.frames ?? [];
  const names = new Set(frames.flatMap(({ name, parent }) => [name, parent]));
  const wanted = [mapFrameOf(store.layout, store.robot?.id ?? '/'), scene.fixedFrame];
  return wanted.find((name) => names.has(name)) ?? frames[0]?.parent ?? scene.fixedFrame;
}
