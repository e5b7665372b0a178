// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The state of the page: the messages of the node, and what the user chose. Written only here.
 *
 * What is read of it in a component, or in an `effect`, is followed: it runs again on each change.
 * Maps and lists are replaced, never modified.
 */
import { batch, effect, signal, untracked, type Signal } from '@preact/signals';
import type {
  BagWriting, Commanders, Controllers, Diagnostics, EmergencyStop, EntityInfo, Findings, GoalProgress, GoalStatus, Graph,
  Hello, Layout, LogLine, Model, Notice, Playhead, Recording, RobotInfo, ServerMessage, Services, SimulationStatus,
  SimulatorInfo, Topics, Transforms, World,
} from './protocol';
import type { Asked, Link } from './connection';
import { Freshness } from './freshness';

/** What can change; a listener is called for the topics that it subscribed to. */
export type Topic =
  | 'link' | 'hello' | 'graph' | 'model' | 'world' | 'layout' | 'simulation' | 'reset'
  | 'controllers' | 'diagnostics' | 'topics' | 'services' | 'progress' | 'transforms' | 'log' | 'findings'
  | 'driver' | 'commanders' | 'stops' | 'goal'
  | 'silence' | 'notice' | 'robot' | 'frame' | 'selection' | 'recording' | 'playhead' | 'writing';

export interface NoticeEntry extends Notice {
  number: number; // of this entry, which is another one's never
  count: number; // how often it came in a row
  at: Date;
  again: Asked | null; // what tries again what has failed
}

export interface Selection {
  robot: string;
  frame: string | null;
}

const MOST_NOTICES = 50;
const NO_STOP: EmergencyStop = { type: 'emergency_stop', client: null, since: null, robots: [] };
const MOST_LINES = 2000;
const MOST_GOALS = 20; // of which progress is kept

export class Store {
  /** Called with each world, as the scene takes them one by one. */
  onWorld: (world: World) => void = () => {};
  /** How old is what is shown. */
  readonly freshness = new Freshness();

  private lastReason = '';
  private readonly cells = {
    link: signal<Link>({ state: 'connecting' }),
    hello: signal<Hello | null>(null),
    graph: signal<Graph | null>(null),
    layout: signal<Layout | null>(null),
    frame: signal<string | null>(null),
    selection: signal<Selection | null>(null),
    robot: signal<string | null>(null), // the chosen one
    model: byName<Model>(),
    world: byName<World>(),
    simulation: byName<SimulationStatus>(),
    controllers: byName<Controllers>(),
    diagnostics: byName<Diagnostics>(),
    driver: byName<string | null>(),
    commanders: byName<Commanders>(),
    goal: byName<GoalStatus>(),
    stops: signal<EmergencyStop>(NO_STOP),
    recording: signal<Recording | null>(null),
    playhead: signal<Playhead | null>(null),
    writing: signal<BagWriting | null>(null),
    silence: signal(''),
    notice: signal<readonly NoticeEntry[]>([]),
    topics: signal<Topics | null>(null),
    services: signal<Services | null>(null),
    progress: signal<ReadonlyMap<number, GoalProgress>>(new Map()),
    transforms: signal<Transforms | null>(null),
    findings: signal<Findings | null>(null),
    log: signal<readonly LogLine[]>([]),
    reset: signal(0), // how often time has jumped back
  } satisfies Record<Topic, Signal<unknown>>;

  /** The bag that is shown in place of a ROS graph; null: there is a graph. */
  get recording(): Recording | null {
    return this.cells.recording.value;
  }

  /** What time of the bag is shown. */
  get playhead(): Playhead | null {
    return this.cells.playhead.value;
  }

  /** What the node records; null: nothing was recorded yet. */
  get writing(): BagWriting | null {
    return this.cells.writing.value;
  }

  get link(): Link {
    return this.cells.link.value;
  }

  get hello(): Hello | null {
    return this.cells.hello.value;
  }

  get graph(): Graph | null {
    return this.cells.graph.value;
  }

  get layout(): Layout | null {
    return this.cells.layout.value;
  }

  /** The frame that poses are shown in; null: the root of the tree. */
  get fixedFrame(): string | null {
    return this.cells.frame.value;
  }

  get selection(): Selection | null {
    return this.cells.selection.value;
  }

  get models(): ReadonlyMap<string, Model> {
    return this.cells.model.value;
  }

  get worlds(): ReadonlyMap<string, World> {
    return this.cells.world.value;
  }

  get simulations(): ReadonlyMap<string, SimulationStatus> {
    return this.cells.simulation.value;
  }

  get controllers(): ReadonlyMap<string, Controllers> {
    return this.cells.controllers.value;
  }

  get diagnostics(): ReadonlyMap<string, Diagnostics> {
    return this.cells.diagnostics.value;
  }

  /** Nodes and topics; null: they have not come since somebody looked. */
  get topics(): Topics | null {
    return this.cells.topics.value;
  }

  /** Services and actions; null: they have not come since somebody looked. */
  get services(): Services | null {
    return this.cells.services.value;
  }

  /** How the last goals go that this page has sent, by the ids of the requests. */
  get progress(): ReadonlyMap<number, GoalProgress> {
    return this.cells.progress.value;
  }

  get transforms(): Transforms | null {
    return this.cells.transforms.value;
  }

  /** What the doctor finds; null: it has not come since somebody looked. */
  get findings(): Findings | null {
    return this.cells.findings.value;
  }

  /** Lines of /rosout, the oldest first. */
  get log(): readonly LogLine[] {
    return this.cells.log.value;
  }

  get drivers(): ReadonlyMap<string, string | null> {
    return this.cells.driver.value;
  }

  /** The stops that are held. */
  get stops(): EmergencyStop {
    return this.cells.stops.value;
  }

  /** What is said when nothing new comes, "No data for 3 s"; empty: it comes. */
  get silence(): string {
    return this.cells.silence.value;
  }

  setSilence(text: string): void {
    this.cells.silence.value = text;
  }

  /** Whether STOP holds any robot, or will hold those that come. */
  get isStopped(): boolean {
    return this.stops.client !== null || this.stops.robots.length > 0;
  }

  /** Who commands a robot besides pages; null: not told. */
  commanders(robot: string): Commanders | null {
    return this.cells.commanders.value.get(robot) ?? null;
  }

  /** How the last goal that a page gave to a robot goes; null: none was given. */
  goal(robot: string): GoalStatus | null {
    return this.cells.goal.value.get(robot) ?? null;
  }

  /** Whether anybody drives anything, a page or another node. */
  get isDriven(): boolean {
    const others = [...this.cells.commanders.value.values()];
    return [...this.drivers.values()].some((page) => page !== null) || others.some(({ rate }) => rate > 0);
  }

  /** The latest first. */
  get notices(): readonly NoticeEntry[] {
    return this.cells.notice.value;
  }

  /**
   * Call back on each change of one of the topics, and once now, for parts that are no components.
   * What the call itself reads is not followed.
   */
  watch(topics: readonly Topic[], call: () => void): void {
    effect(() => {
      for (const topic of topics) {
        void this.cells[topic].value;
      }
      untracked(call);
    });
  }

  /** The robots that are there: one that is only described was deleted, or was never spawned. */
  get robots(): readonly RobotInfo[] {
    return (this.graph?.robots ?? []).filter(({ present }) => present);
  }

  /** The robot that a frame is of: the one whose namespace stands before its name, else the shown one. */
  robotOf(frame: string): string | null {
    const own = this.robots.find(({ id }) => frame.startsWith(`${id.slice(1)}/`));
    return own?.id ?? this.robot?.id ?? null;
  }

  /** The robot that another one is made like: the shown one, else one that is described. */
  get pattern(): RobotInfo | null {
    const described = this.graph?.robots.filter(({ id }) => this.models.has(id)) ?? [];
    const drawn = described.find(({ id }) => isDrawn(this.models.get(id)));
    return this.robot ?? drawn ?? null;
  }

  /**
   * The robot that the panels show and the keys drive: the chosen one while it is there, else the
   * first that can be driven.
   */
  get robot(): RobotInfo | null {
    const { robots } = this;
    const chosen = robots.find(({ id }) => id === this.cells.robot.value);
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

  /** What a robot is in a simulator's world, as the node says; null: it is not known to be there. */
  entityOf(robot: string): EntityInfo | null {
    return this.graph?.robots.find(({ id }) => id === robot)?.entity ?? null;
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

  /** The robot that was chosen, which need not be there; null: none was. */
  get chosen(): string | null {
    return this.cells.robot.value;
  }

  choose(robot: string): void {
    this.cells.robot.value = robot;
  }

  setLink(link: Link): void {
    const before = this.lastReason;
    if (link.state === 'waiting' && link.attempt === 1) {
      this.lastReason = link.reason;
    }
    // Why the connection was lost says more than why the next attempt has failed.
    const isRetry = link.state === 'waiting' && link.attempt > 1 && this.hello !== null;
    this.cells.link.value = isRetry ? { ...link, reason: before } : link;
  }

  setFixedFrame(name: string | null): void {
    this.cells.frame.value = name;
  }

  select(selection: Selection | null): void {
    this.cells.selection.value = selection;
  }

  /** Show the user a notice; equal ones in a row are counted. */
  note(level: Notice['level'], text: string, again: Asked | null = null): void {
    const before = this.cells.notice.peek();
    const [latest, ...older] = before;
    const isSame = latest !== undefined && latest.text === text && latest.level === level;
    const count = isSame ? latest.count + 1 : 1;
    const number = isSame ? latest.number : (latest?.number ?? 0) + 1;
    const entry: NoticeEntry = { type: 'notice', level, text, number, count, at: new Date(), again };
    this.cells.notice.value = [entry, ...(isSame ? older : before)].slice(0, MOST_NOTICES);
  }

  clearNotices(): void {
    this.cells.notice.value = [];
  }

  /** Handle a message of the node. Unknown types are of a newer node, and ignored. */
  take(message: ServerMessage): void {
    batch(() => this.handle(message));
  }

  private handle(message: ServerMessage): void {
    const { cells } = this;
    switch (message.type) {
      case 'hello':
        return this.begin(message);
      case 'graph':
        return this.setGraph(message);
      case 'model':
        return put(cells.model, message.robot, message);
      case 'world':
        put(cells.world, message.simulator, message);
        return this.onWorld(message);
      case 'layout':
        cells.layout.value = message;
        return;
      case 'simulation':
        return put(cells.simulation, message.simulator, message);
      case 'reset':
        cells.reset.value += 1;
        return;
      case 'controllers':
        return put(cells.controllers, message.robot, message);
      case 'diagnostics':
        return put(cells.diagnostics, message.robot, message);
      case 'driver':
        return put(cells.driver, message.robot, message.client);
      case 'commanders':
        return put(cells.commanders, message.robot, message);
      case 'goal':
        return put(cells.goal, message.robot, message);
      case 'emergency_stop':
        cells.stops.value = message;
        return;
      case 'ages':
        this.freshness.take(message, performance.now() / 1000);
        return;
      case 'recording':
        cells.recording.value = message;
        return;
      case 'playhead':
        cells.playhead.value = message;
        return;
      case 'bag_writing':
        cells.writing.value = message;
        return;
      case 'topics':
        cells.topics.value = message;
        return;
      case 'services':
        cells.services.value = message;
        return;
      case 'goal_progress':
        cells.progress.value = new Map([...cells.progress.peek(), [message.goal, message] as const].slice(-MOST_GOALS));
        return;
      case 'transforms':
        cells.transforms.value = message;
        return;
      case 'findings':
        cells.findings.value = message;
        return;
      case 'log':
        return this.addLines(message.lines);
      case 'reply':
        return message.ok ? undefined : this.note('error', message.message);
      case 'notice':
        return this.note(message.level, message.text);
    }
  }

  /** Add lines that are not there yet: who looks again gets the last warnings again. */
  private addLines(lines: readonly LogLine[]): void {
    const before = this.cells.log.peek();
    const last = before.at(-1)?.number ?? 0;
    const known = new Set(before.map(({ number }) => number));
    const added = lines.filter(({ number }) => number > last || !known.has(number));
    const all = [...before, ...added].sort((one, other) => one.number - other.number);
    this.cells.log.value = all.slice(-MOST_LINES);
  }

  /** A new connection: the node sends everything again, and older messages are void. */
  private begin(hello: Hello): void {
    const before = this.cells.hello.peek();
    this.cells.hello.value = hello;
    this.setGraph({ type: 'graph', robots: [], simulators: [], hint: null, sensors: [], navigators: [] });
    this.cells.layout.value = null;
    this.cells.recording.value = this.cells.playhead.value = this.cells.writing.value = null;
    this.cells.stops.value = NO_STOP;
    this.freshness.take(null, 0);
    this.cells.topics.value = this.cells.services.value = null;
    for (const [goal, each] of this.cells.progress.peek()) {
      if (each.state === 'active') { // the node cancels what its page has left
        this.take({ ...each, goal, state: 'lost', text: 'The connection to the node was lost.' });
      }
    }
    this.cells.transforms.value = null;
    this.cells.findings.value = null;
    this.cells.log.value = []; // another node counts anew
    if (before !== null && before.version !== hello.version) {
      const versions = `${before.version} → ${hello.version}`;
      this.note('warning', `The node was updated (${versions}): reload this page to match it.`);
    }
  }

  private setGraph(graph: Graph): void {
    const { cells } = this;
    cells.graph.value = graph;
    const robots = new Set(graph.robots.map((robot) => robot.id));
    const simulators = new Set(graph.simulators.map((simulator) => simulator.id));
    retain(cells.model, robots);
    retain(cells.controllers, robots);
    retain(cells.diagnostics, robots);
    retain(cells.driver, robots);
    retain(cells.commanders, robots);
    retain(cells.goal, robots);
    retain(cells.world, simulators);
    retain(cells.simulation, simulators);
    const selection = cells.selection.peek();
    if (selection !== null && !this.robots.some(({ id }) => id === selection.robot)) {
      cells.selection.value = null;
    }
  }
}

/** Whether a description is more than one of frames, such as that of where the robots of a fleet began. */
function isDrawn(model: Model | undefined): boolean {
  return model !== undefined && /<visual\b/.test(model.urdf);
}

type ByName<T> = Signal<ReadonlyMap<string, T>>;

function byName<T>(): ByName<T> {
  return signal<ReadonlyMap<string, T>>(new Map());
}

function put<T>(cell: ByName<T>, name: string, value: T): void {
  cell.value = new Map(cell.peek()).set(name, value);
}

/** Keep those of these names. */
function retain<T>(cell: ByName<T>, names: ReadonlySet<string>): void {
  const kept = [...cell.peek()].filter(([name]) => names.has(name));
  if (kept.length < cell.peek().size) {
    cell.value = new Map(kept);
  }
}
