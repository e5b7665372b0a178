// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The view of the scene: its canvas, what is shown in it, and words where nothing can be. */
import type { App } from './app';
import type { Link } from './connection';
import { button, h, setText, toggle } from './dom';
import type { Part } from './protocol';
import type { State } from './state';
import { recall, remember } from './remember';
import type { Sample } from './samples';
import { NoWebGL, Scene } from './scene/scene';
import type { Sensing } from './sensors/sensing';
import type { Theme } from './theme';

const LAYERS = [
  { name: 'frames', label: 'Frames', on: false, title: 'Axes of the TF frames' },
  { name: 'frameNames', label: 'Names', on: false, title: 'Names of the frames' },
  { name: 'trails', label: 'Trails', on: true, title: 'Where the robot went: truth and odometry' },
  { name: 'contacts', label: 'Contacts', on: false, title: 'Load and slip of the wheels' },
  { name: 'collisions', label: 'Collisions', on: false, title: 'Shapes that touch' },
  { name: 'grid', label: 'Grid', on: true, title: 'Squares of 1 m' },
] as const;

export class View {
  readonly element: HTMLElement;
  readonly scene: Scene | null;
  private whyBlind = '';
  private readonly canvas = h('canvas', {
    class: 'scene',
    'aria-label': 'The robot in its world',
  });
  private readonly words = h('div', { class: 'view-words' });
  private readonly hint = h('div', { class: 'view-hint', hidden: true });
  private following = recall('follow') !== 'no';

  constructor(
    private readonly app: App,
    private readonly sensing: Sensing,
  ) {
    this.element = h('main', { class: 'view', id: 'view' }, this.canvas, this.words, this.hint);
    this.scene = this.makeScene();
    if (this.scene === null) {
      this.canvas.remove();
    } else {
      this.element.append(this.tools(this.scene), legend(app));
      this.connect(this.scene);
    }
    app.store.watch(['graph', 'link', 'robot'], () => this.showWords());
  }

  /** What is shown of the parts that come only on demand. */
  get watches(): readonly Part[] {
    return this.scene?.shows('contacts') === true ? ['wheels'] : [];
  }

  /** The topics of sensors that are drawn. */
  get topics(): readonly string[] {
    return this.scene === null ? [] : this.sensing.inScene.map(({ topic }) => topic);
  }

  /** Show a sample. */
  applySample(sample: Sample): void {
    const info = this.sensing.take(sample);
    if (info !== null && info.kind !== 'picture') {
      this.scene?.takeSample(info, sample);
    }
  }

  /** Show a state. */
  apply(state: State): void {
    this.scene?.applyState(state);
  }

  setTheme(theme: Theme): void {
    this.scene?.setTheme(theme);
  }

  private makeScene(): Scene | null {
    try {
      return new Scene(this.canvas);
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
    const shown = new Set<string>();
    store.watch(['model', 'graph'], () => {
      for (const id of [...shown].filter((robot) => !store.models.has(robot))) {
        scene.removeRobot(id);
        shown.delete(id);
      }
    });
    store.watch(['layout'], () => {
      if (store.layout !== null) {
        scene.setLayout(store.layout);
      }
    });
    store.watch(['frame'], () => scene.setFixedFrame(store.fixedFrame));
    store.watch(['reset'], () => scene.clearTrails());
    this.sensing.onChange = () => scene.retainSensors(new Set(this.sensing.latest.keys()));
    store.watch(['robot', 'graph'], () => this.follow(scene));
    store.onModel = (model) => {
      scene.setModel(model);
      shown.add(model.robot);
    };
    store.onWorld = (world) => scene.setWorld(world);
    store.watch(['graph'], () => {
      if (store.worlds.size === 0) {
        scene.setWorld({ type: 'world', simulator: '', shapes: [] });
      }
    });
    scene.onProblem = (text) => store.note('warning', text);
    scene.onSelect = (robot: string, link: string | null) => {
      store.choose(robot);
      store.select({ robot, frame: link });
    };
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
    const layers = LAYERS.map(({ name, label, on, title }) => {
      const kept = recall(`show.${name}`);
      const now = kept === null ? on : kept === 'yes';
      scene.show({ [name]: now });
      const flip = (shown: boolean): void => {
        remember(`show.${name}`, shown ? 'yes' : 'no');
        scene.show({ [name]: shown });
      };
      return toggle(label, now, flip, title);
    });
    return h(
      'div',
      { class: 'view-tools', role: 'toolbar', 'aria-label': 'View' },
      button('Reset view', () => scene.resetView(), { kind: 'quiet' }),
      follow,
      h('span', { class: 'rule', 'aria-hidden': 'true' }),
      ...layers,
      button('Clear trails', () => scene.clearTrails(), { kind: 'quiet' }),
    );
  }

  private showWords(): void {
    const { link, graph, robot } = this.app.store;
    const lost = link.state !== 'open';
    const empty = !lost && graph !== null && graph.robots.length === 0;
    this.hint.hidden = lost || robot === null || robot.command === null;
    this.hint.replaceChildren('Hold ', ...keys(), ' or the arrow keys to drive');
    this.words.replaceChildren();
    if (lost) {
      this.sayLost(link);
    } else if (empty) {
      this.say('Nothing to see yet', graph.hint ?? 'Nobody publishes a robot description.');
    } else if (this.scene === null) {
      this.say('No 3-D view', this.whyBlind);
    }
  }

  private sayLost(link: Link): void {
    if (link.state === 'waiting') {
      const reason = link.reason === '' ? 'The viewer does not answer.' : `${link.reason}.`;
      const text = `${reason} This page connects again by itself as soon as it does.`;
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

function keys(): HTMLElement[] {
  return ['W', 'A', 'S', 'D'].map((key) => h('kbd', {}, key));
}

/** What stands between back-quotes in a text is a command. */
function commands(text: string): Node[] {
  return text.split('`').map((part, index) =>
    index % 2 === 1 ? h('code', {}, part) : document.createTextNode(part),
  );
}

/** What the trails are of; those that there are. */
function legend({ store }: App): HTMLElement {
  const entry = (kind: string, word: string): HTMLElement =>
    h('span', {}, h('i', { class: `swatch ${kind}` }), word);
  const truth = entry('truth', 'Truth');
  const odometry = entry('odometry', 'Odometry');
  const element = h('div', { class: 'view-legend', 'aria-hidden': 'true' }, truth, odometry);
  store.watch(['graph', 'robot'], () => {
    truth.hidden = (store.robot?.truth ?? null) === null;
    odometry.hidden = (store.robot?.odometry ?? null) === null;
    element.hidden = truth.hidden && odometry.hidden;
  });
  return element;
}
