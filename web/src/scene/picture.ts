// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** All that is to be seen, where the last state has it, in the fixed frame. */
import { Matrix4, Scene as ThreeScene, Vector3 } from 'three';
import type { Layout, Model, SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import { firstLook, type LookOf } from '../sensors/looks';
import type { State } from '../state';
import { Axes, labelsOf, type PlacedFrame } from './axes';
import { differ } from './changes';
import { Contacts } from './contacts';
import { RobotEntry } from './entry';
import { linkFacts } from '../links';
import { StateHistory } from './history';
import type { Label } from './labels';
import { LinkMarks } from './link_marks';
import { MarkLayer } from './marks';
import { NavigationLayer } from './navigation';
import type { LocateFrame } from './grids';
import { automaticFrame, isMap, namesOfFrames, Placement, WORLD, type Body } from './placement';
import type { RobotEvents } from './robot';
import { RobotMarks, type SceneRobot } from './robot_marks';
import { Robots } from './robots';
import { SensorLayer, type Locate } from './sensors';
import { Surroundings } from './surroundings';
import { PALETTES, type Palette } from './theme';
import { FrameTree, readPose } from './tree';
import type { Unseen } from './unseen';
import { WorldView } from './world';

/** What is shown beside robots and world. */
export interface SceneOptions {
  frames: boolean;
  frameNames: boolean;
  trails: boolean;
  contacts: boolean;
  collisions: boolean;
  grid: boolean;
  maps: boolean;
  paths: boolean;
}

const CHOSEN_SHARE = 1.8; // how much longer axes of the chosen frame are
const EMPTY = { type: 'layout', id: -1, frames: [], robots: [] } satisfies Layout;

export class Picture {
  readonly scene = new ThreeScene();
  /** Drawn over the scene, seen through everything. */
  readonly overlay = new ThreeScene();
  readonly world: WorldView;
  readonly surroundings: Surroundings;
  readonly sensors: SensorLayer;
  readonly navigation: NavigationLayer;
  readonly marks: MarkLayer;
  options: SceneOptions = {
    frames: true, frameNames: true, trails: true, contacts: true, collisions: false, grid: true,
    maps: true, paths: true,
  };
  /** The frame that was asked for; null: the one that suits. */
  chosenFrame: string | null = null;
  /** The frame that is lit up. */
  selected: string | null = null;
  /** The frame that stands still, as of the last {@link place}. */
  fixedFrame = WORLD;
  /** The frames that have a place. */
  placed: readonly PlacedFrame[] = [];
  readonly robots = new Robots();
  private readonly placement = new Placement();
  private readonly axes = new Axes();
  private readonly contacts = new Contacts();
  private readonly links = new LinkMarks();
  private readonly robotMarks = new RobotMarks();
  private palette = PALETTES.light;
  private readonly history = new StateHistory();
  private layout: Layout = EMPTY;
  private tree = new FrameTree(EMPTY);
  private state: State | null = null;
  private drawn: State | null = null; // the last one that was
  private hasRoute = false; // trails are of a whole recording
  private isWaiting = false; // for the first state of a new layout; what is drawn stays until then

  /** `changed`: something is there that had to be made; `failed`: it cannot be, in one line. */
  constructor(
    private readonly isSoftware: boolean,
    changed: () => void = () => {},
    failed: (text: string) => void = () => {},
    lookOf: LookOf = ({ kind }) => firstLook(kind),
  ) {
    this.sensors = new SensorLayer(lookOf);
    this.navigation = new NavigationLayer(changed, failed, (topic) => lookOf({ topic, kind: 'map' }));
    this.marks = new MarkLayer(changed, failed, lookOf);
    this.world = new WorldView(!isSoftware);
    this.surroundings = new Surroundings(this.scene, isSoftware);
    this.scene.add(this.world.object, this.sensors.points, this.navigation.object, this.marks.object);
    const { axes, contacts, sensors, links, navigation } = this;
    this.overlay.add(navigation.marks, axes.object, contacts.object, sensors.marks, links.object);
  }

  /** Draw a robot, in place of an earlier one of its name. Throws BadModel. */
  setModel(model: Model, events: RobotEvents, palette: Palette): void {
    const before = this.robots.get(model.robot);
    const entry = new RobotEntry(model, !this.isSoftware, events, before);
    before?.view.dispose();
    this.robots.set(model.robot, entry);
    entry.view.setPalette(palette);
    entry.view.showCollisions(this.options.collisions);
    before?.mark.dispose();
    this.scene.add(entry.view.object, entry.trails.object, entry.mark.object);
    this.mark();
  }

  /** Mark these robots, each by a colour of its own where there are several. */
  setRobots(robots: readonly SceneRobot[]): void {
    this.robotMarks.keep(robots);
    this.mark();
  }

  private mark(): void {
    this.robotMarks.dress(this.robots, this.palette);
  }

  /** The names of robots where there are several, and of frames. */
  labels(): Label[] {
    const areShown = this.options.frames && this.options.frameNames;
    const named = this.placed.filter(({ name }) => areShown || name === this.selected);
    return [
      ...this.robotMarks.labels(this.robots, this.palette),
      ...labelsOf(named, this.selected ?? this.fixedFrame),
    ];
  }

  /** Light up a frame: its axes and name, and the link that it is; null: none. */
  select(robot: string | null, frame: string | null): void {
    this.selected = frame;
    const chosen = this.robots.choose(robot, frame, this.palette.highlight);
    const facts = chosen && linkFacts(chosen.entry.view.model.urdf, chosen.link);
    this.links.show(chosen?.entry.view ?? null, facts, CHOSEN_SHARE * (chosen?.entry.axisLength ?? 0));
  }

  removeRobot(robot: string): void {
    this.forgetAnchor(robot);
    this.robots.remove(robot);
  }

  setLayout(layout: Layout): void {
    this.layout = layout;
    this.tree = new FrameTree(layout);
    this.isWaiting = this.drawn !== null;
    this.state = this.drawn = null;
  }

  /**
   * Take over a state of the last layout; with one of the past, trails do not go on. Returns whether it
   * looks other than what is drawn.
   */
  setState(state: State, isPast = false): boolean {
    if (state.layout.id !== this.layout.id) {
      return false;
    }
    this.state = state;
    this.history.add(state);
    this.isWaiting = false;
    if (!isPast) {
      this.goOn(state);
    }
    return this.sensors.expire(state.time) || differ(this.drawn, state);
  }

  /** Draw the trails of these states, and no others any more. None: those of what comes. */
  setRoute(states: readonly State[]): void {
    this.clearTrails();
    states.forEach((state) => this.extendTrails(state));
    this.hasRoute = states.length > 0;
  }

  /** Have trails go on with a state, which need not be shown. */
  goOn(state: State): void {
    if (!this.hasRoute && state.layout.id === this.layout.id) {
      this.extendTrails(state);
    }
  }

  private extendTrails(state: State): void {
    for (const robot of state.robots) {
      if (this.robots.get(robot.id)?.trails.add(robot, state.time)) {
        this.forgetAnchor(robot.id);
      }
    }
  }

  setOptions(options: Partial<SceneOptions>): void {
    this.options = { ...this.options, ...options };
    this.surroundings.showGrid(this.options.grid);
    this.navigation.show(this.options);
    this.robots.views().forEach((view) => view.showCollisions(this.options.collisions));
  }

  setPalette(palette: Palette): void {
    const { surroundings, world, axes, contacts, sensors, links, navigation } = this;
    this.palette = palette;
    for (const each of [surroundings, world, axes, contacts, sensors, links, navigation, ...this.robots.views().values()]) {
      each.setPalette(palette);
    }
    this.mark();
  }

  /** Take over a sample. */
  setSample(info: SensorInfo, sample: Sample): void {
    if (!this.navigation.take(info, sample) && !this.marks.take(info, sample)) {
      this.sensors.take(info, sample);
    }
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    this.sensors.restyle(topic);
    this.navigation.restyle(topic);
    this.marks.restyle(topic);
  }

  /** A robot's mesh has come. */
  measure(robot: string): void {
    const entry = this.robots.get(robot);
    if (entry !== undefined) {
      entry.measure();
      this.contacts.forget(entry.view);
    }
  }

  clearTrails(): void {
    this.placement.clear();
    this.robots.forEach(({ trails }) => trails.clear());
  }

  /** Where odometry and truth agreed: the pose in world of the root of each TF tree. */
  get anchors(): Map<string, Matrix4> {
    return this.placement.anchors;
  }

  /** Where `world` is in the fixed frame; null: nowhere. */
  get worldPose(): Matrix4 | null {
    return this.placement.poseOf(WORLD);
  }

  /** The pose of a robot's base in the fixed frame; null: it has none. */
  poseOf(robot: string | null): Matrix4 | null {
    const body = robot === null ? null : this.robots.get(robot)?.body;
    return body ? this.placement.poseOfBody(body) : null;
  }

  /** Why nothing of a robot is to be seen; null: something is, or nothing is known of it yet. */
  unseen(robot: string): Unseen | null {
    const entry = this.robots.get(robot);
    if (entry === undefined || entry.body === null || this.isWaiting) {
      return null;
    }
    if (this.placement.poseOfBody(entry.body) === null) {
      return { reason: 'place', base: entry.body.base, frame: this.fixedFrame };
    }
    const problems = entry.view.whyBare;
    return problems === null ? null : { reason: 'shapes', problems };
  }

  /** Let one look through what hides a robot from the eye; null: through nothing. */
  reveal(eye: Vector3, robot: string | null): void {
    const entry = robot === null ? undefined : this.robots.get(robot);
    this.world.reveal(eye, entry?.middles(eye) ?? []);
  }

  /** Put everything where the last state has it. */
  place(): void {
    if (this.isWaiting) {
      return;
    }
    this.readState();
    const before = this.fixedFrame;
    const { bodies } = this;
    const isBare = bodies.length === 0 && this.world.hasGround; // a world without robots
    this.fixedFrame = this.chosenFrame ?? (isBare ? WORLD : automaticFrame(this.tree, bodies));
    if (this.fixedFrame !== before) {
      this.sensors.unsettle();
      this.marks.unsettle();
    }
    const entries = [...this.robots.values()];
    this.placement.update(this.tree, bodies, this.fixedFrame);
    const world = this.placement.poseOf(WORLD);
    this.world.place(world);
    this.surroundings.setGround(this.world.hasGround ? world : null);
    entries.forEach((entry) => entry.place(this.placement, world, this.options.trails));
    this.links.place();
    this.placeFrames();
    this.placeContacts();
    const locate = this.locator();
    this.sensors.place(locate);
    this.marks.place(locate, this.locateFrame);
    this.navigation.place(this.locateFrame, this.believed());
  }

  /** Where a frame of a robot is in the scene; of a map that is no robot's, any frame of its name. */
  readonly locateFrame: LocateFrame = (frame, robot) => {
    const others = [...this.tree.names].filter((name) => robot === '' && name.endsWith(`/${frame}`));
    const names = [`${robot.slice(1)}/${frame}`, frame, ...others].filter((name) => this.tree.has(name));
    if (names.length === 0) {
      // Whoever ties the map to TF waits for a pose; until then it lies where the scene begins.
      return this.placement.poseOf(frame) ?? this.worldPose ?? new Matrix4();
    }
    return this.placement.poseOf(names[0]!);
  };

  /** Where robots are as their TF has it, where the truth is known as well. */
  private believed(): Matrix4[] {
    return this.bodies.flatMap(({ base, truth }) => {
      const root = this.tree.rootOf(base);
      const [place, inRoot] = [this.placement.poseOf(root), this.tree.inRoot(base)];
      return truth === null || !isMap(root) || place === null || inRoot === null ? [] : place.clone().multiply(inRoot);
    });
  }

  /** Where sensors were: what is asked more than once of a state is worked out once. */
  private locator(): Locate {
    const known = new Map<State, Placement>();
    return (frame, robot, stamp) => {
      const state = this.history.nearest(stamp);
      if (state === null) {
        return { pose: null, isSettled: false };
      }
      const placement = known.get(state) ?? this.placementAt(state);
      known.set(state, placement);
      const own = `${robot.slice(1)}/${frame}`; // of a robot with a TF of its own
      const pose = placement.poseOf(own) ?? placement.poseOf(frame);
      return { pose, isSettled: pose !== null && this.history.isSettled(stamp) };
    };
  }

  private placementAt(state: State): Placement {
    const tree = new FrameTree(state.layout);
    tree.read(state.poses);
    const bodies = [...this.robots.values()].flatMap(({ id, body }): Body[] => {
      const values = state.robots.find((robot) => robot.id === id)?.truth;
      const truth = values === undefined ? null : readPose(values, 0, new Matrix4());
      // Its links are where TF had them then.
      return body === null ? [] : [{ ...body, truth, links: new Map([[body.base, new Matrix4()]]) }];
    });
    return this.placement.at(tree, bodies, this.fixedFrame);
  }

  /** Let odometry and truth of a robot agree anew. */
  private forgetAnchor(robot: string): void {
    const base = this.robots.get(robot)?.body?.base;
    if (base !== undefined) {
      this.placement.forget(this.tree.rootOf(base));
    }
  }

  private readState(): void {
    const { state } = this;
    if (state !== null) {
      this.tree.read(state.poses);
    }
    for (const entry of this.robots.values()) {
      const at = this.layout.robots.findIndex(({ id }) => id === entry.id);
      entry.read(this.tree, this.layout.robots[at]?.joints ?? [], state?.robots[at] ?? null);
    }
    this.drawn = state;
  }

  private placeFrames(): void {
    this.placed = namesOfFrames(this.tree, this.bodies).flatMap((name) => {
      const pose = this.placement.poseOf(name);
      const parent = this.tree.parentOf(name);
      const above = parent === null ? null : this.placement.poseOf(parent);
      return pose === null ? [] : { name, pose, parent: above, length: this.axisLengthOf(name) };
    });
    this.axes.draw(this.placed.filter(({ name }) => this.options.frames || name === this.selected));
  }

  private axisLengthOf(frame: string): number {
    const entries = [...this.robots.values()];
    const owner = entries.find(({ body }) => body?.links.has(frame));
    const length = owner?.axisLength ?? Math.max(0, ...entries.map((each) => each.axisLength));
    return (length || 0.3) * (frame === this.selected ? CHOSEN_SHARE : 1);
  }

  private placeContacts(): void {
    this.contacts.begin();
    this.layout.robots.forEach(({ id, wheels }, at) => {
      const view = this.robots.get(id)?.view;
      const state = this.state?.robots[at];
      if (this.options.contacts && view?.object.visible && state) {
        this.contacts.add(view, wheels, state);
      }
    });
    this.contacts.commit();
  }

  private get bodies(): readonly Body[] {
    return [...this.robots.values()].flatMap(({ body }) => body ?? []);
  }
}
