// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A document without a browser for tests of panels, and an app whose node is the test. */
import { Window } from 'happy-dom';
import { options } from 'preact';
import type { App, Panel } from '../src/app';
import { Channels } from '../src/channels';
import { Connection, type Socket } from '../src/connection';
import { Pilot } from '../src/drive/pilot';
import {
  COMMAND_FLOATS, MOTION_FLOATS, POSE_FLOATS, WHEEL_FLOATS,
  type ClientMessage, type Graph, type Layout, type RobotInfo, type ServerMessage,
} from '../src/protocol';
import type { State } from '../src/state';
import { Store } from '../src/store';

const page = new Window({ url: 'http://127.0.0.1:8080/' });
Object.assign(globalThis, {
  window: page,
  document: page.document,
  HTMLElement: page.HTMLElement,
  Event: page.Event,
  localStorage: page.localStorage,
  DOMParser: page.DOMParser,
  Document: page.XMLDocument, // which is what its parser returns
  Element: page.Element,
  ResizeObserver: page.ResizeObserver,
  MutationObserver: page.MutationObserver,
  requestAnimationFrame: (call: FrameRequestCallback) => page.requestAnimationFrame(call),
  getSelection: () => page.getSelection(),
});

// Effects come after a frame of the screen; here as soon as all that is waiting was done.
options.requestAnimationFrame = (call) => void setTimeout(call);

export interface TestApp extends App {
  /** What the page has sent, the oldest first. */
  sent: ClientMessage[];
  /** The node says something. */
  say(message: ServerMessage): void;
}

/** A page that is connected with the test. */
export function connectedApp(): TestApp {
  const sent: ClientMessage[] = [];
  const socket: Socket = {
    isOpen: true,
    onOpen: () => {},
    onClose: () => {},
    onMessage: () => {},
    onLeft: () => {},
    send: (text) => void sent.push(JSON.parse(text) as ClientMessage),
    rest: () => {},
    here: () => {},
  };
  const connection = new Connection('ws://test', { open: () => socket, after: () => () => {} });
  const store = new Store();
  connection.onMessage = (message) => store.take(message);
  connection.onLink = (link) => store.setLink(link);
  connection.open();
  socket.onOpen();
  const pilot = new Pilot({
    send: () => true,
    rest: () => {},
    now: () => 0,
    after: () => () => {},
  });
  const say = (message: ServerMessage): void => socket.onMessage(JSON.stringify(message));
  return { store, connection, pilot, channels: new Channels(), sent, say };
}

/** Have the page's address end with a fragment. */
export function atFragment(hash: string): void {
  page.location.hash = hash;
}

/** The texts of the elements that a selector finds in a panel. */
export function texts(panel: Pick<Panel, 'element'>, selector: string): string[] {
  return [...panel.element.querySelectorAll(selector)].map((each) => each.textContent);
}

/** Wait until components have been drawn anew, with what their effects have changed. */
export async function drawn(): Promise<void> {
  for (let turn = 0; turn < 4; turn += 1) {
    await new Promise((resolve) => setTimeout(resolve));
  }
}

/** A robot of which nothing is known but its name, or what is said. */
export function robotInfo(known: Partial<RobotInfo> = {}): RobotInfo {
  return {
    id: '/', name: 'amr', present: true, command: null, odometry: null, truth: null, wheels: null,
    joint_states: null, joint_publisher: null, manager: null, entity: null, ...known,
  };
}

export function graphOf(robots: readonly RobotInfo[], known: Partial<Graph> = {}): Graph {
  return { type: 'graph', robots: [...robots], simulators: [], hint: null, sensors: [], navigators: [], ...known };
}

/** A state of a layout in which nothing is known. */
export function unknownState(layout: Layout): State {
  const unknown = (count: number): Float32Array => new Float32Array(count).fill(NaN);
  return {
    layout,
    sequence: 0,
    time: 0,
    poses: unknown(POSE_FLOATS * layout.frames.length),
    robots: layout.robots.map(({ id, joints, wheels }) => ({
      id,
      positions: unknown(joints.length),
      velocities: unknown(joints.length),
      commanded: unknown(joints.length),
      odometry: unknown(MOTION_FLOATS),
      truth: unknown(MOTION_FLOATS),
      command: unknown(COMMAND_FLOATS),
      wheels: unknown(WHEEL_FLOATS * wheels.length),
    })),
  };
}

/** The element that a selector finds in a panel; a test fails where there is none. */
export function find(panel: Pick<Panel, 'element'>, selector: string): HTMLElement {
  const found = panel.element.querySelector<HTMLElement>(selector);
  if (found === null) {
    throw new Error(`there is no ${selector} in ${panel.element.innerHTML}`);
  }
  return found;
}
