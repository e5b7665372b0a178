// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The page: makes its parts and gives each what comes from the node. */
import { announce } from './announce';
import type { App } from './app';
import { Channels } from './channels';
import { keepChoice } from './choice';
import { Connection, socketUrl } from './connection';
import { h } from './dom';
import { listenToGamepads } from './drive/gamepad';
import { listenToKeys } from './drive/keys';
import { DrivePanel } from './drive/panel';
import { Pilot } from './drive/pilot';
import { Header } from './header';
import { inspect } from './inspect';
import { navigationBar } from './navigation/bar';
import { Past } from './past';
import { controlPanel } from './panels/control';
import { framesPanel } from './panels/frames';
import { graphPanel } from './panels/graph';
import { healthPanel, healthToLookAt } from './panels/health';
import { jointsPanel } from './panels/joints';
import { logPanel } from './panels/log';
import { findingsToLookAt, modelPanel } from './panels/model';
import { parametersPanel } from './panels/parameters';
import { sensorsPanel } from './panels/sensors';
import { servicesPanel } from './panels/services';
import { simulationPanel } from './panels/simulation';
import { topicsPanel } from './panels/topics';
import { PlotsPanel } from './plots/panel';
import { Recorder } from './plots/recorder';
import { seriesFeed, WholeRecording } from './recording/whole';
import { timeLine } from './recording/time_line';
import { isSample } from './samples';
import { Sensing } from './sensors/sensing';
import { arrange } from './shell';
import { StateStream } from './stream';
import { Store } from './store';
import { Tabs } from './tabs';
import { watchTheme } from './theme';
import { View } from './view';
import { Watcher } from './watcher';
import { Workspace } from './workspace';

const ALARMS = ['alarms'] as const;
const PULSE = 100; // ms between two updates of the numbers

const store = new Store();
const connection = new Connection(socketUrl(window.location));
const pilot = new Pilot({
  send: (message) => store.recording !== null || connection.send(message),
  rest: () => connection.rest(),
  now: () => performance.now(),
  after: (milliseconds, call) => {
    const timer = setTimeout(call, milliseconds);
    return () => clearTimeout(timer);
  },
});
const channels = new Channels();
const app: App = { store, connection, pilot, channels };
keepChoice(store);
const recorder = new Recorder((robot) => store.turningJoints(robot));
const stream = new StateStream(store);
const watcher = new Watcher(
  (message) => connection.send(message),
  () => document.visibilityState === 'visible',
);
const sensing = new Sensing(store);

const view = new View(app, sensing);
view.element.append(navigationBar(app, view.scene));
view.element.append(timeLine(app));
const series = seriesFeed(app);
const plots = new PlotsPanel(app, recorder, {
  plot: (...wish) => (store.recording === null ? channels : series).plot(...wish),
});
const past = new Past({
  state: (state) => view.apply(state, past.isShown),
  sample: (sample) => view.applySample(sample),
  over: () => view.setPast(null),
});
plots.onTime = (time) => {
  view.setPast(past.lookAt(pilot.driving ? null : time)); // nobody drives by what was
  stream.touch(); // pictures are drawn with states
};
view.onNow = () => plots.follow();
const sensors = sensorsPanel(app, sensing);
const workspace = new Workspace();
const drive = new DrivePanel(app, (small) => workspace.setDriveSmall(small));
const tabs = new Tabs('tab', workspace);
for (const panel of [
  modelPanel(app),
  jointsPanel(app),
  sensors,
  framesPanel(app, view.places),
  simulationPanel(app, () => view.scene),
  controlPanel(app),
  healthPanel(app),
  topicsPanel(app, plots),
  servicesPanel(app),
  logPanel(app),
  parametersPanel(app),
  graphPanel(app),
]) {
  tabs.add(panel);
}
const shell = arrange(app, { view, drive, plots, tabs, workspace });
workspace.onChange = () => {
  drive.setSmall(workspace.isDriveSmall);
  tabs.arrange();
};
drive.setSmall(workspace.isDriveSmall);
const theme = watchTheme((now) => {
  view.setTheme(now);
  plots.repaint();
});
const header = new Header(app, { flipTheme: theme.flip, openPanels: shell.openPanels, reset: shell.reset });
const skip = h('a', { class: 'skip', href: '#drive' }, 'Skip to driving');
document.body.prepend(skip, header.element);
document.body.append(announce(app));

store.watch(['graph', 'robot', 'model', 'diagnostics', 'findings'], () => {
  tabs.setBadge('model', findingsToLookAt(store));
  tabs.setBadge('health', healthToLookAt(store));
});
store.watch(['graph'], () => recorder.keep((store.graph?.robots ?? []).map(({ id }) => id)));
store.watch(['reset'], () => {
  recorder.clear();
  past.forget();
});
store.watch(['recording'], () => {
  recorder.setSpan(store.recording?.length ?? 0);
  view.scene?.setRoute([]);
});
new WholeRecording(app, (states) => {
  states.forEach((state) => recorder.record(state, null));
  view.scene?.setRoute(states);
  plots.showWhole();
});
store.watch(['driver', 'robot', 'graph'], () => {
  const { driver } = store;
  pilot.setTaken(driver !== null && !driver.me);
});
let stopIsDue = false; // it was pressed while there was no connection
pilot.onUnsent = () => {
  stopIsDue = true;
  store.note('error', 'There is no connection: STOP did not reach the node; it is sent as soon as it answers.');
};
pilot.onRefused = () => {
  store.note('warning', `${store.driver?.name} drives; STOP holds every robot, whoever drives.`);
};

listenToKeys(pilot, () => pilot.driving || store.isDriven, () => store.recording !== null);
listenToGamepads(pilot, (name) => drive.showPad(name));

connection.onLink = (link) => {
  if (link.state !== 'open') {
    pilot.halt();
    watcher.forget();
    channels.forget();
  } else if (stopIsDue) {
    stopIsDue = false;
    pilot.stop();
  }
  store.setLink(link);
};
connection.onMessage = (message) => {
  if (message.type === 'driver' && message.stopped !== null && message.stopped === store.client) {
    pilot.halt();
  }
  store.take(message);
};
connection.onLeft = (seconds) => {
  if (pilot.halt()) {
    const busy = `The page was busy for ${seconds.toFixed(1)} s`;
    store.note('warning', `${busy}: the robot was stopped. Let go and hold again.`);
  }
};
connection.onBinary = (buffer) => {
  if (isSample(buffer)) {
    const sample = stream.takeSample(buffer);
    const isSensed = sample !== null && stream.attempt(() => channels.take(sample)) === false;
    if (isSensed && (store.recording !== null || past.takeSample(sample))) {
      view.applySample(sample);
    }
    return;
  }
  const state = stream.take(buffer);
  if (state !== null && store.recording !== null) {
    view.apply(state); // all of it is kept already
  } else if (state !== null) {
    if (pilot.driving) {
      past.lookAt(null);
    }
    if (past.takeState(state)) {
      view.apply(state);
    } else {
      view.keep(state);
    }
    recorder.record(state, store.simulation?.real_factor ?? null);
  }
};

/** Tell the node what can be seen: at once when it is nothing any more, as timers sleep then. */
function watch(): void {
  watcher.show({
    // Errors are counted on the tab of who does not look at them, too.
    parts: [...(tabs.watches.includes('findings') ? [] : ALARMS), ...tabs.watches, ...view.watches, ...plots.watches],
    topics: [...tabs.topics, ...view.topics],
    messages: tabs.watches.includes('topics') ? channels.messages : [], // of the panel topics
    fields: channels.fields,
    whole: sensing.whole,
  });
}

document.addEventListener('visibilitychange', watch);
setInterval(() => {
  connection.here();
  watch();
  const now = performance.now() / 1000;
  header.tick(now);
  drive.tick(now);
  const state = stream.fresh();
  if (state !== null) {
    for (const part of [header, drive, tabs, shell]) {
      part.pulse(state);
    }
  }
}, PULSE);

inspect({ app, stream, recorder, view, sensors });
connection.open();
