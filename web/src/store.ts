// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The state of the page: the messages of the node, and what the user chose. Written only here. */
import type {
  Controllers, Diagnostics, Graph, Hello, Layout, Model, Notice, RobotInfo, ServerMessage,
  SimulationStatus, SimulatorInfo, World,
} from './protocol';
import type { Link } from './connection';

/** What can change; a listener is called for the topics that it subscribed to. */
export type Topic =
  | 'link' | 'hello' | 'graph' | 'model' | 'world' | 'layout' | 'simulation' | 'reset'
  | 'controllers' | 'diagnostics' | 'driver' | 'notice' | 'robot' | 'frame' | 'selection';

export interface NoticeEntry extends Notice {
  count: number; // how often it came in a row
  at: Date;
}

export interface Selection {
  robot: string;
  frame: string | null;
}

const MOST_NOTICES = 50;

export class Store {
  link: Link = { state: 'connecting' };
  hello: Hello | null = null;
  graph: Graph | null = null;
  layout: Layout | null = null;
  fixedFrame: string | null = null; // null: the root of the tree
  selection: Selection | null = null;
  readonly models = new Map<string, Model>();
  readonly worlds = new Map<string, World>();
  readonly simulations = new Map<string, SimulationStatus>();
  readonly controllers = new Map<string, Controllers>();
  readonly diagnostics = new Map<string, Diagnostics>();
  readonly drivers = new Map<string, string | null>();
  readonly notices: NoticeEntry[] = []; // the latest first

  /** Called with each model and each world, as the scene takes them one by one. */
  onModel: (model: Model) => void = () => {};
  onWorld: (world: World) => void = () => {};

  private chosen: string | null = null;
  private readonly listeners = new Map<Topic, Set<() => void>>();

  /** Call back on each change of one of the topics, and once now. */
  watch(topics: readonly Topic[], call: () => void): void {
    for (const topic of topics) {
      const calls = this.listeners.get(topic) ?? new Set();
      this.listeners.set(topic, calls.add(call));
    }
    call();
  }

  /**
   * The robot that the panels show and the keys drive: the chosen one while it is there, else the
   * first that can be driven. (A fleet has a description of its own, of where its robots stand.)
   */
  get robot(): RobotInfo | null {
    const robots = this.graph?.robots ?? [];
    const chosen = robots.find(({ id }) => id === this.chosen);
    return chosen ?? robots.find(({ command }) => command !== null) ?? robots[0] ?? null;
  }

  /** The name of this page, as the node knows it. */
  get client(): string | null {
    return this.hello?.client ?? null;
  }

  get simulator(): SimulatorInfo | null {
    return this.graph?.simulators[0] ?? null;
  }

  /** Status of the simulator; null while there is none, or none was received. */
  get simulation(): SimulationStatus | null {
    return this.simulator === null ? null : (this.simulations.get(this.simulator.id) ?? null);
  }

  get model(): Model | null {
    return this.robot === null ? null : (this.models.get(this.robot.id) ?? null);
  }

  /** The continuous joints of a robot, such as wheels. */
  turningJoints(robot: string): string[] {
    const joints = this.models.get(robot)?.joints ?? [];
    return joints.filter(({ kind }) => kind === 'continuous').map(({ name }) => name);
  }

  /** Which page drives the robot: this one, another one by its name, or none. */
  get driver(): { me: boolean; name: string } | null {
    const name = this.robot === null ? null : (this.drivers.get(this.robot.id) ?? null);
    return name === null ? null : { me: name === this.client, name };
  }

  /** The controller that takes the commands, if it is known and not active. */
  get deafController(): { name: string; state: string } | null {
    const topic = this.robot?.command?.topic.split('/') ?? [];
    const here = this.robot === null ? undefined : this.controllers.get(this.robot.id);
    const [name] = topic.slice(-2); // ~/cmd_vel of the controller of that name
    const found = here?.controllers.find((controller) => controller.name === name);
    return found === undefined || found.state === 'active' ? null : found;
  }

  /** Whether an active controller of the robot can take it sideways, by its type. */
  get goesSideways(): boolean {
    const here = this.robot === null ? undefined : this.controllers.get(this.robot.id);
    const active = here?.controllers.filter(({ state }) => state === 'active') ?? [];
    return active.some(({ kind }) => /mecanum|omni|planar/i.test(kind));
  }

  /** The joints that pages can move by active controllers, each with its controller. */
  get movedJoints(): ReadonlyMap<string, string> {
    const here = this.robot === null ? undefined : this.controllers.get(this.robot.id);
    const pairs = here?.controllers.flatMap(({ name, moves }) => moves.map((joint) => [joint, name]));
    return new Map(pairs as [string, string][] | undefined);
  }

  choose(robot: string): void {
    this.chosen = robot;
    this.tell('robot');
  }

  setLink(link: Link): void {
    this.link = link;
    this.tell('link');
  }

  setFixedFrame(name: string | null): void {
    this.fixedFrame = name;
    this.tell('frame');
  }

  select(selection: Selection | null): void {
    this.selection = selection;
    this.tell('selection');
  }

  /** Show the user a notice; equal ones in a row are counted. */
  note(level: Notice['level'], text: string): void {
    const [latest] = this.notices;
    if (latest !== undefined && latest.text === text && latest.level === level) {
      latest.count += 1;
      latest.at = new Date();
    } else {
      this.notices.unshift({ type: 'notice', level, text, count: 1, at: new Date() });
      this.notices.length = Math.min(this.notices.length, MOST_NOTICES);
    }
    this.tell('notice');
  }

  clearNotices(): void {
    this.notices.length = 0;
    this.tell('notice');
  }

  /** Handle a message of the node. Unknown types are of a newer node, and ignored. */
  take(message: ServerMessage): void {
    switch (message.type) {
      case 'hello':
        return this.begin(message);
      case 'graph':
        return this.setGraph(message);
      case 'model':
        this.models.set(message.robot, message);
        this.onModel(message);
        return this.tell('model');
      case 'world':
        this.worlds.set(message.simulator, message);
        this.onWorld(message);
        return this.tell('world');
      case 'layout':
        this.layout = message;
        return this.tell('layout');
      case 'simulation':
        this.simulations.set(message.simulator, message);
        return this.tell('simulation');
      case 'reset':
        return this.tell('reset');
      case 'controllers':
        this.controllers.set(message.robot, message);
        return this.tell('controllers');
      case 'diagnostics':
        this.diagnostics.set(message.robot, message);
        return this.tell('diagnostics');
      case 'driver':
        this.drivers.set(message.robot, message.client);
        return this.tell('driver');
      case 'reply':
        return message.ok ? undefined : this.note('error', message.message);
      case 'notice':
        return this.note(message.level, message.text);
    }
  }

  /** A new connection: the node sends everything again, and older messages are void. */
  private begin(hello: Hello): void {
    const before = this.hello;
    this.hello = hello;
    this.setGraph({ type: 'graph', robots: [], simulators: [], hint: null, sensors: [] });
    this.layout = null;
    this.tell('layout');
    this.tell('hello');
    if (before !== null && before.version !== hello.version) {
      const versions = `${before.version} → ${hello.version}`;
      this.note('warning', `The node was updated (${versions}): reload this page to match it.`);
    }
  }

  private setGraph(graph: Graph): void {
    this.graph = graph;
    const robots = new Set(graph.robots.map((robot) => robot.id));
    const simulators = new Set(graph.simulators.map((simulator) => simulator.id));
    for (const map of [this.models, this.controllers, this.diagnostics, this.drivers]) {
      keep(map, robots);
    }
    for (const map of [this.worlds, this.simulations]) {
      keep(map, simulators);
    }
    if (this.selection !== null && !robots.has(this.selection.robot)) {
      this.selection = null;
    }
    this.tell('graph');
  }

  private tell(topic: Topic): void {
    for (const call of this.listeners.get(topic) ?? []) {
      call();
    }
  }
}

function keep(map: Map<string, unknown>, names: ReadonlySet<string>): void {
  for (const name of [...map.keys()]) {
    if (!names.has(name)) {
      map.delete(name);
    }
  }
}
