// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The view of the scene: its canvas, what is shown in it, and words where nothing can be. */
import type { Matrix4 } from 'three';
import type { App } from './app';
import type { Link } from './connection';
import { commands } from './commands';
import { button, h, setText, toggle } from './dom';
import { keycaps } from './drive/keycaps';
import { robotName, timeText } from './format';
import { showOverflow } from './overflow';
import type { Model, Part, SensorInfo } from './protocol';
import type { State } from './state';
import { acceptUrdf } from './drop';
import { handsOf } from './hands';
import { pointTools } from './pointing';
import { recall, remember } from './remember';
import type { Sample } from './samples';
import { Places } from './scene/places';
import { NoWebGL, Scene } from './scene/scene';
import { unseenWords, type Unseen } from './scene/unseen';
import type { Sensing } from './sensors/sensing';
import type { Theme } from './theme';

const LAYERS = [
  { name: 'frames', label: 'Frames', on: false, title: 'Axes of the TF frames' },
  { name: 'frameNames', label: 'Names', on: false, title: 'Names of the frames' },
  { name: 'trails', label: 'Trails', on: true, title: 'Where the robot went: truth and odometry' },
  { name: 'contacts', label: 'Contacts', on: false, title: 'Load and slip of the wheels' },
  { name: 'collisions', label: 'Collisions', on: false, title: 'Shapes that touch' },
  { name: 'maps', label: 'Map', on: true, title: 'Maps and costmaps; which ones, Sensors says' },
  { name: 'paths', label: 'Path', on: true, title: 'Paths of who navigates; which ones, Sensors says' },
  { name: 'grid', label: 'Grid', on: true, title: 'Squares of 1 m' },
] as const;

const LOOK = 500; // ms between two looks for the chosen robot
const UNSEEN_LOOKS = 4; // a transform or a mesh may still be on its way
const NOT_SPAWNED =
  'A robot is described, but the simulator has none: it was deleted, or is not spawned yet. The tab Simulation spawns one.';

export class View {
  readonly element: HTMLElement;
  readonly scene: Scene | null;
  /** Where frames are, in numbers. */
  readonly places: Places;
  private whyBlind = '';
  private readonly canvas = h('canvas', {
    class: 'scene',
    tabindex: 0,
    role: 'application',
    'aria-label': 'The robot in its world',
    'aria-describedby': 'view-keys',
  });
  private readonly keys = h(
    'p',
    { class: 'view-keys', id: 'view-keys' },
    'Shift and arrow keys turn the view, + and − zoom, Home resets it.',
  );
  private readonly words = h('div', { class: 'view-words' });
  private readonly hint = h(
    'div',
    { class: 'view-hint', hidden: true },
    'Hold ',
    ...keycaps('KeyW', 'KeyA', 'KeyS', 'KeyD'),
    ' or the arrow keys to drive',
  );
  private readonly paused = h('div', { class: 'view-paused', hidden: true }, 'Paused: robots stand');
  private readonly pastTime = h('span');
  private readonly past = h(
    'div',
    { class: 'view-past', hidden: true },
    this.pastTime,
    button('Now', () => this.onNow(), { title: 'Show what is now, and what comes' }),
  );
  /** Somebody wants to see what is now. */
  onNow: () => void = () => {};
  private unseen: Unseen | null = null; // why there has been nothing of the chosen robot for a while
  private looks = 0; // at which there was nothing of it, in a row
  private lookedAt = 0; // ms
  private following = recall('follow') !== 'no';

  constructor(
    private readonly app: App,
    private readonly sensing: Sensing,
  ) {
    const foot = h('div', { class: 'view-foot' }, this.hint, this.paused, this.past);
    this.element = h('main', { class: 'view', id: 'view' }, this.canvas, this.keys, this.words, foot);
    this.scene = this.makeScene();
    this.places = new Places(app.store, this.scene?.anchors ?? new Map<string, Matrix4>());
    if (this.scene === null) {
      this.canvas.remove();
      this.keys.remove();
    } else {
      this.element.append(this.tools(this.scene));
      foot.append(legend(app));
      this.connect(this.scene);
    }
    app.store.watch(['graph', 'link', 'robot'], () => this.showWords());
    app.store.watch(['graph', 'simulation'], () => {
      this.paused.hidden = app.store.simulation?.state !== 'paused';
    });
  }

  /** What is shown of the parts that come only on demand. */
  get watches(): readonly Part[] {
    return this.scene?.shows('contacts') === true ? ['wheels'] : [];
  }

  /** The topics of sensors that are drawn. */
  get topics(): readonly string[] {
    const { scene } = this;
    const isHidden = ({ kind }: SensorInfo): boolean =>
      (kind === 'map' && scene?.shows('maps') === false) || (kind === 'path' && scene?.shows('paths') === false);
    return scene === null ? [] : this.sensing.inScene.filter((each) => !isHidden(each)).map(({ topic }) => topic);
  }

  /** Show a sample. */
  applySample(sample: Sample): void {
    const info = this.sensing.take(sample);
    if (info !== null && info.kind !== 'picture') {
      this.scene?.takeSample(info, sample);
    }
  }

  /** A state has come, while one of the past is shown. */
  keep(state: State): void {
    this.scene?.goOn(state);
  }

  /** Say which time of the past is shown, s; null: it is now. */
  setPast(time: number | null): void {
    this.past.hidden = time === null;
    if (time !== null) {
      setText(this.pastTime, `As it was at ${timeText(time)}`);
    }
  }

  /** Show a state, of now or of the past. */
  apply(state: State, isPast = false): void {
    if (this.scene === null) {
      this.places.update(state); // from the first state on: there odometry and truth agree
    } else {
      this.scene.applyState(state, isPast);
      this.lookForRobot(this.scene, performance.now());
    }
  }

  /** Say why nothing of the chosen robot is to be seen, once that has lasted. */
  private lookForRobot(scene: Scene, now: number): void {
    if (now - this.lookedAt < LOOK) {
      return;
    }
    this.lookedAt = now;
    const { robot } = this.app.store;
    const unseen = robot?.present === true ? scene.unseen(robot.id) : null;
    this.looks = unseen === null ? 0 : this.looks + 1;
    const said = this.looks > UNSEEN_LOOKS ? unseen : null;
    if (JSON.stringify(said) !== JSON.stringify(this.unseen)) {
      this.unseen = said;
      this.showWords();
    }
  }

  setTheme(theme: Theme): void {
    this.scene?.setTheme(theme);
  }

  private makeScene(): Scene | null {
    try {
      return new Scene(this.canvas, (info) => this.sensing.looks.of(info));
    } catch (error) {
      if (error instanceof NoWebGL) {
        this.whyBlind = error.message;
        document.body.classList.add('blind'); // the place is for the plots
        return null;
      }
      throw error;
    }
  }

  private connect(scene: Scene): void {
    const { store } = this.app;
    const shown = new Map<string, Model>();
    store.watch(['model', 'graph'], () => {
      const present = new Set(store.robots.map(({ id }) => id));
      for (const id of [...shown.keys()].filter((one) => !present.has(one) || !store.models.has(one))) {
        scene.removeRobot(id);
        shown.delete(id);
      }
      for (const [id, model] of store.models) {
        if (present.has(id) && shown.get(id) !== model) {
          scene.setModel(model);
          shown.set(id, model);
        }
      }
    });
    store.watch(['layout'], () => {
      if (store.layout !== null) {
        scene.setLayout(store.layout);
      }
    });
    store.watch(['frame'], () => scene.setFixedFrame(store.fixedFrame));
    store.watch(['reset'], () => scene.clearTrails());
    this.sensing.looks.onChange = (topic) => scene.restyle(topic);
    this.sensing.onChange = () => scene.retainSensors(new Set(this.sensing.latest.keys()));
    store.watch(['robot', 'graph'], () => this.follow(scene));
    store.onWorld = (world) => scene.setWorld(world);
    store.watch(['graph'], () => {
      if (store.worlds.size === 0) {
        scene.setWorld({ type: 'world', simulator: '', shapes: [] });
      }
    });
    scene.onProblem = (text) => store.note('warning', text);
    scene.onSelect = (picked) => {
      if (picked !== null) {
        store.choose(picked.robot);
      }
      store.select(picked);
    };
    store.watch(['selection', 'model', 'graph'], () => {
      const { selection } = store;
      scene.select(selection?.robot ?? null, selection?.frame ?? null);
    });
    store.watch(['graph', 'robot', 'model'], () => {
      scene.setRobots(
        store.robots.map((each) => ({
          id: each.id,
          name: robotName(each),
          isChosen: each.id === store.robot?.id,
          drives: each.command !== null,
        })),
      );
    });
    store.watch(['graph'], () => {
      scene.hands = handsOf(this.app);
    });
    acceptUrdf(
      this.app,
      this.element,
      (x, y) => scene.groundAt(x, y),
      () => scene.footprints(),
    );
    new ResizeObserver(() => scene.resize()).observe(this.canvas);
  }

  private follow(scene: Scene): void {
    scene.follow(this.following ? (this.app.store.robot?.id ?? null) : null);
  }

  private tools(scene: Scene): HTMLElement {
    const follow = toggle('Follow', this.following, (on) => {
      this.following = on;
      remember('follow', on ? 'yes' : 'no');
      this.follow(scene);
    }, 'The camera goes with the robot');
    const toggles = new Map<string, HTMLButtonElement>();
    const limit = (): void => {
      const names = toggles.get('frameNames');
      if (names !== undefined) {
        names.disabled = !scene.shows('frames');
        names.title = names.disabled ? 'Names of the frames, where Frames are shown' : 'Names of the frames';
      }
    };
    const layers = LAYERS.map(({ name, label, on, title }) => {
      const kept = recall(`show.${name}`);
      const now = kept === null ? on : kept === 'yes';
      scene.show({ [name]: now });
      const flip = (shown: boolean): void => {
        remember(`show.${name}`, shown ? 'yes' : 'no');
        scene.show({ [name]: shown });
        limit();
      };
      const element = toggle(label, now, flip, title);
      toggles.set(name, element);
      return element;
    });
    limit();
    const clear = button('Clear trails', () => scene.clearTrails(), { kind: 'quiet' });
    const pointing = pointTools(this.app, scene);
    this.element.querySelector('.view-foot')?.append(pointing.words);
    this.element.append(pointing.cross);
    const tools = h(
      'div',
      { class: 'view-tools', role: 'toolbar', 'aria-label': 'View' },
      button('Reset view', () => scene.resetView(), { kind: 'quiet' }),
      button('Top view', () => scene.lookDown(), { kind: 'quiet', title: 'Look straight down' }),
      follow,
      h('span', { class: 'rule', 'aria-hidden': 'true' }),
      ...layers,
      clear,
      h('span', { class: 'rule', 'aria-hidden': 'true' }),
      ...pointing.buttons,
    );
    showOverflow(tools);
    // Where nothing moves, or no wheel is measured, these would do nothing.
    this.app.store.watch(['graph', 'robot'], () => {
      const { graph, robots } = this.app.store;
      const moves = robots.some(({ truth, odometry }) => truth !== null || odometry !== null);
      for (const element of [toggles.get('trails'), follow, clear]) {
        element?.toggleAttribute('hidden', graph !== null && !moves);
      }
      const measured = robots.some(({ wheels }) => wheels !== null);
      toggles.get('contacts')?.toggleAttribute('hidden', graph !== null && !measured);
      for (const [name, kind] of [['maps', 'map'], ['paths', 'path']] as const) {
        toggles.get(name)?.toggleAttribute('hidden', !this.sensing.here.some((each) => each.kind === kind));
      }
    });
    return tools;
  }

  private showWords(): void {
    const { link, graph, robot, robots } = this.app.store;
    const lost = link.state !== 'open';
    const empty = !lost && graph !== null && robots.length === 0;
    this.hint.hidden = lost || robot === null || robot.command === null;
    this.words.replaceChildren();
    if (lost) {
      this.sayLost(link);
    } else if (empty) {
      this.say('No robot', graph.hint ?? NOT_SPAWNED);
    } else if (this.scene === null) {
      this.say('No 3-D view', this.whyBlind);
    } else if (robot !== null && this.unseen !== null) {
      this.say(...unseenWords(robotName(robot), this.unseen));
    }
  }

  private sayLost(link: Link): void {
    if (link.state === 'waiting') {
      const reason = link.reason === '' ? 'The viewer does not answer.' : `${link.reason}.`;
      const text =
        `${reason} If the launch has ended, start it again. ` +
        'This page connects by itself as soon as there is a viewer.';
      this.say('No connection', text);
    } else {
      this.say('Connecting …', '');
    }
  }

  private say(title: string, text: string): void {
    const words = h('h2', {});
    setText(words, title);
    const sentence = text.charAt(0).toUpperCase() + text.slice(1);
    this.words.append(h('div', { class: 'card' }, words, h('p', {}, ...commands(sentence))));
  }
}

/** What the trails are of; those that there are. Of several robots each has its own colour. */
function legend({ store }: App): HTMLElement {
  const entry = (kind: string, word: string): HTMLElement =>
    h('span', {}, h('i', { class: `swatch trail ${kind}` }), word);
  const truth = entry('truth', 'Truth');
  const odometry = entry('odometry', 'Odometry');
  const element = h('div', { class: 'view-legend', 'aria-hidden': 'true' }, truth, odometry);
  store.watch(['graph', 'robot'], () => {
    truth.hidden = (store.robot?.truth ?? null) === null;
    odometry.hidden = (store.robot?.odometry ?? null) === null;
    element.hidden = truth.hidden && odometry.hidden;
    element.classList.toggle('of-many', store.robots.length > 1);
  });
  return element;
}
