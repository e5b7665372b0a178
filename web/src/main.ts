// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The page: makes its parts and gives each what comes from the node. */
import { announce } from './announce';
import type { App } from './app';
import { Connection, socketUrl } from './connection';
import { h } from './dom';
import { listenToGamepads } from './drive/gamepad';
import { listenToKeys } from './drive/keys';
import { DrivePanel } from './drive/panel';
import { Pilot } from './drive/pilot';
import { Header } from './header';
import { inspect } from './inspect';
import { ControlPanel } from './panels/control';
import { FramesPanel } from './panels/frames';
import { HealthPanel } from './panels/health';
import { JointsPanel } from './panels/joints';
import { ModelPanel } from './panels/model';
import { SensorsPanel } from './panels/sensors';
import { SimulationPanel } from './panels/simulation';
import { PlotsPanel } from './plots/panel';
import { Recorder } from './plots/recorder';
import { isSample } from './samples';
import { Sensing } from './sensors/sensing';
import { arrange } from './shell';
import { StateStream } from './stream';
import { Store } from './store';
import { Tabs } from './tabs';
import { watchTheme } from './theme';
import { View } from './view';
import { Watcher } from './watcher';

const PULSE = 100; // ms between two updates of the numbers

const store = new Store();
const connection = new Connection(socketUrl(window.location));
const pilot = new Pilot({
  send: (message) => connection.send(message),
  now: () => performance.now(),
  after: (milliseconds, call) => {
    const timer = setTimeout(call, milliseconds);
    return () => clearTimeout(timer);
  },
});
const app: App = { store, connection, pilot };
const recorder = new Recorder((robot) => store.turningJoints(robot));
const stream = new StateStream(store);
const watcher = new Watcher(
  (message) => connection.send(message),
  () => document.visibilityState === 'visible',
);
const sensing = new Sensing(store);

const view = new View(app, sensing);
const drive = new DrivePanel(app);
const plots = new PlotsPanel(app, recorder);
const model = new ModelPanel(app);
const health = new HealthPanel(app);
const sensors = new SensorsPanel(app, sensing);
const tabs = new Tabs('tab');
for (const panel of [
  model,
  new JointsPanel(app),
  sensors,
  new FramesPanel(app, () => view.scene?.frames() ?? []),
  new SimulationPanel(app),
  new ControlPanel(app),
  health,
]) {
  tabs.add(panel);
}
const shell = arrange(app, { view, drive, plots, tabs });
const theme = watchTheme((now) => {
  view.setTheme(now);
  plots.repaint();
});
const header = new Header(app, { flipTheme: theme.flip, openPanels: shell.openPanels });
const skip = h('a', { class: 'skip', href: '#drive' }, 'Skip to driving');
document.body.prepend(skip, header.element);
document.body.append(announce(store));

store.watch(['graph', 'robot', 'model', 'diagnostics'], () => {
  tabs.setBadge('model', model.toLookAt, 'warning');
  tabs.setBadge('health', health.toLookAt, 'warning');
});
store.watch(['graph'], () => recorder.keep((store.graph?.robots ?? []).map(({ id }) => id)));
store.watch(['reset'], () => recorder.clear());
store.watch(['driver', 'robot', 'graph'], () => {
  const { driver } = store;
  pilot.setTaken(driver !== null && !driver.me);
});
pilot.onRefused = () => {
  store.note('warning', `${store.driver?.name} drives; STOP stops it for everybody.`);
};

listenToKeys(pilot);
listenToGamepads(pilot, (name) => drive.showPad(name));

connection.onLink = (link) => {
  if (link.state !== 'open') {
    pilot.halt();
    watcher.forget();
  }
  store.setLink(link);
};
connection.onMessage = (message) => {
  if (message.type === 'driver' && message.stopped !== null && message.stopped === store.client) {
    pilot.halt();
  }
  store.take(message);
};
connection.onBinary = (buffer) => {
  if (isSample(buffer)) {
    const sample = stream.takeSample(buffer);
    if (sample !== null) {
      view.applySample(sample);
    }
    return;
  }
  pilot.keepUp();
  const state = stream.take(buffer);
  if (state !== null) {
    view.apply(state);
    recorder.record(state, store.simulation?.real_factor ?? null);
  }
};

/** Tell the node what can be seen: at once when it is nothing any more, as timers sleep then. */
function watch(): void {
  watcher.show([...tabs.watches, ...view.watches], [...tabs.topics, ...view.topics]);
}

document.addEventListener('visibilitychange', watch);
setInterval(() => {
  watch();
  const state = stream.fresh();
  if (state !== null) {
    for (const part of [header, drive, tabs, shell]) {
      part.pulse(state);
    }
  }
}, PULSE);

inspect({ app, stream, recorder, view, sensors });
connection.open();
