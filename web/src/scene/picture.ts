// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** All that is to be seen, where the last state has it, in the fixed frame. */
import { Box3, Matrix4, Scene as ThreeScene, Vector3 } from 'three';
import type { Layout, Model } from '../protocol';
import type { SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import { isKnownPose, type State } from '../state';
import { Axes, type PlacedFrame } from './axes';
import { differ } from './changes';
import { Contacts } from './contacts';
import { RobotEntry } from './entry';
import { StateHistory } from './history';
import { Placement, WORLD, type Body } from './placement';
import type { RobotEvents, RobotView } from './robot';
import { SensorLayer, type Locate } from './sensors';
import { Surroundings } from './surroundings';
import type { Palette } from './theme';
import { FrameTree, readPose } from './tree';
import { WorldView } from './world';

/** What is shown beside robots and world. */
export interface SceneOptions {
  frames: boolean;
  frameNames: boolean;
  trails: boolean;
  contacts: boolean;
  collisions: boolean;
  grid: boolean;
}

const AXIS_SHARE = 0.28; // of the robot's size
const NEAR = 12; // m; robots further away are not brought into view with the first
const EMPTY = { type: 'layout', id: -1, frames: [], robots: [] } satisfies Layout;

export class Picture {
  readonly scene = new ThreeScene();
  /** Drawn over the scene, seen through everything. */
  readonly overlay = new ThreeScene();
  readonly world: WorldView;
  readonly surroundings: Surroundings;
  readonly sensors = new SensorLayer();
  options: SceneOptions = {
    frames: true, frameNames: true, trails: true, contacts: true, collisions: false, grid: true,
  };
  /** The frame that was asked for; null: the one that suits. */
  chosenFrame: string | null = null;
  /** The frame that stands still, as of the last {@link place}. */
  fixedFrame = WORLD;
  /** The frames that have a place. */
  placed: readonly PlacedFrame[] = [];
  private readonly robots = new Map<string, RobotEntry>();
  private readonly placement = new Placement();
  private readonly axes = new Axes();
  private readonly contacts = new Contacts();
  private readonly history = new StateHistory();
  private layout: Layout = EMPTY;
  private tree = new FrameTree(EMPTY);
  private state: State | null = null;
  private drawn: State | null = null; // the last one that was
  private isWaiting = false; // for the first state of a new layout; what is drawn stays until then

  constructor(private readonly isSoftware: boolean) {
    this.world = new WorldView(!isSoftware);
    this.surroundings = new Surroundings(this.scene, isSoftware);
    this.scene.add(this.world.object, this.sensors.points);
    this.overlay.add(this.axes.object, this.contacts.object, this.sensors.marks);
  }

  /** Draw a robot, in place of an earlier one of its name. Throws BadModel. */
  setModel(model: Model, events: RobotEvents, palette: Palette): void {
    const before = this.robots.get(model.robot);
    const entry = new RobotEntry(model, !this.isSoftware, events, before);
    before?.view.dispose();
    this.robots.set(model.robot, entry);
    entry.view.setPalette(palette);
    entry.view.showCollisions(this.options.collisions);
    this.scene.add(entry.view.object, entry.trails.object);
  }

  removeRobot(robot: string): void {
    this.forgetAnchor(robot);
    this.robots.get(robot)?.dispose();
    this.robots.delete(robot);
  }

  setLayout(layout: Layout): void {
    this.layout = layout;
    this.tree = new FrameTree(layout);
    this.isWaiting = this.drawn !== null;
    this.state = this.drawn = null;
  }

  /** Take over a state of the last layout. Returns whether it looks other than what is drawn. */
  setState(state: State): boolean {
    if (state.layout.id !== this.layout.id) {
      return false;
    }
    this.state = state;
    this.history.add(state);
    this.isWaiting = false;
    for (const robot of state.robots) {
      if (this.robots.get(robot.id)?.trails.add(robot, state.time)) {
        this.forgetAnchor(robot.id);
      }
    }
    return this.sensors.expire(state.time) || differ(this.drawn, state);
  }

  setOptions(options: Partial<SceneOptions>): void {
    this.options = { ...this.options, ...options };
    this.surroundings.showGrid(this.options.grid);
    this.views().forEach((view) => view.showCollisions(this.options.collisions));
  }

  setPalette(palette: Palette): void {
    const { surroundings, world, axes, contacts, sensors } = this;
    for (const each of [surroundings, world, axes, contacts, sensors, ...this.views().values()]) {
      each.setPalette(palette);
    }
  }

  /** Take over a sample. */
  setSample(info: SensorInfo, sample: Sample): void {
    this.sensors.take(info, sample);
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

  trailSizes(): Record<string, [truth: number, odometry: number]> {
    const sizes = [...this.robots].map(([id, { trails }]) => [id, trails.counts] as const);
    return Object.fromEntries(sizes);
  }

  /** The robots by their names. */
  views(): Map<string, RobotView> {
    return new Map([...this.robots].map(([id, { view }]) => [id, view]));
  }

  /** The size of the largest robot, m; 1 where there is none. */
  get size(): number {
    return Math.max(0, ...[...this.robots.values()].map((entry) => entry.size)) || 1;
  }

  /** All frames there are. */
  frames(): string[] {
    const names = new Set(this.tree.names);
    for (const { body } of this.robots.values()) {
      if (body !== null) {
        names.add(body.base);
      }
    }
    return this.hasTruth() ? [WORLD, ...[...names].filter((name) => name !== WORLD)] : [...names];
  }

  /** The pose of a robot's base in the fixed frame; null: it has none. */
  poseOf(robot: string | null): Matrix4 | null {
    const body = robot === null ? null : this.robots.get(robot)?.body;
    return body ? this.placement.poseOfBody(body) : null;
  }

  /** The extent of the robots that are near the first one, m. */
  bounds(): Box3 {
    const box = new Box3();
    for (const view of this.views().values()) {
      const bounds = view.object.visible ? view.bounds() : new Box3();
      const isNear = box.isEmpty() || bounds.distanceToPoint(box.getCenter(new Vector3())) < NEAR;
      if (isNear) {
        box.union(bounds);
      }
    }
    return box;
  }

  /** Put everything where the last state has it. */
  place(): void {
    if (this.isWaiting) {
      return;
    }
    this.readState();
    const before = this.fixedFrame;
    this.fixedFrame = this.chosenFrame ?? this.defaultFrame();
    if (this.fixedFrame !== before) {
      this.sensors.unsettle();
    }
    const entries = [...this.robots.values()];
    const bodies = entries.flatMap(({ body }) => body ?? []);
    this.placement.update(this.tree, bodies, this.fixedFrame);
    const world = this.placement.poseOf(WORLD);
    this.world.place(world);
    this.surroundings.setGround(this.world.hasGround ? world : null);
    entries.forEach((entry) => entry.place(this.placement, world, this.options.trails));
    this.placeFrames();
    this.placeContacts();
    this.sensors.place(this.locator());
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
    this.placed = this.frames().flatMap((name) => {
      const pose = this.placement.poseOf(name);
      const parent = this.tree.parentOf(name);
      const above = parent === null ? null : this.placement.poseOf(parent);
      return pose === null ? [] : { name, pose, parent: above };
    });
    this.axes.object.visible = this.options.frames;
    this.axes.draw(this.placed, AXIS_SHARE * this.size);
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

  private hasTruth(): boolean {
    return this.state?.robots.some(({ truth }) => isKnownPose(truth)) ?? false;
  }

  private defaultFrame(): string {
    if (this.hasTruth()) {
      return WORLD;
    }
    const base = [...this.robots.values()].find(({ body }) => body !== null)?.body?.base;
    const [first] = this.tree.names;
    return base !== undefined ? this.tree.rootOf(base) : (first ?? WORLD);
  }
}
