// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The 3-D view: robots, frames, world, trails and contacts in the fixed frame.
 *
 * Nothing is drawn but what changed: messages and states are taken over at once, and drawn once in
 * the next frame, however many came. All methods are cheap; none waits.
 */
import { Box3, Scene as ThreeScene, Vector3 } from 'three';
import type { Layout, Model, World } from '../protocol';
import { isKnownPose, type State } from '../state';
import { Axes, labelsOf, type PlacedFrame } from './axes';
import { CameraRig } from './camera';
import { differ } from './changes';
import { Contacts } from './contacts';
import { RobotEntry } from './entry';
import { Labels } from './labels';
import { Painter } from './painter';
import { Picking, type Picked } from './picking';
import { Placement, WORLD } from './placement';
import { Surroundings } from './surroundings';
import { PALETTES, type Theme } from './theme';
import { FrameTree } from './tree';
import { isSoftwareDrawn } from './webgl';
import { WorldView } from './world';

export { NoWebGL } from './webgl';
export { ODOMETRY_COLOUR, TRUTH_COLOUR } from './theme';

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

export class Scene {
  /** A link was clicked; null: the robot as a whole is no longer chosen. */
  onSelect: (robot: string, link: string | null) => void = () => {};
  /** Something cannot be drawn: one line for the person before the page. */
  onProblem: (text: string) => void = () => {};
  private readonly scene = new ThreeScene();
  private readonly overlay = new ThreeScene();
  private readonly robots = new Map<string, RobotEntry>();
  private readonly placement = new Placement();
  private readonly axes = new Axes();
  private readonly contacts = new Contacts();
  private readonly world: WorldView;
  private readonly surroundings: Surroundings;
  private readonly labels: Labels;
  private readonly painter: Painter;
  private readonly isShaded: boolean; // shadows fall on all, not on the ground alone
  private readonly rig: CameraRig;
  private readonly picking: Picking;
  private options: SceneOptions = {
    frames: true, frameNames: true, trails: true, contacts: true, collisions: false, grid: true,
  };
  private layout: Layout = EMPTY;
  private tree = new FrameTree(EMPTY);
  private state: State | null = null;
  private drawn: State | null = null; // the last one that was
  private chosenFrame: string | null = null;
  private fixedFrame = WORLD;
  private placed: PlacedFrame[] = [];
  private followed: string | null = null;
  private picked: Picked | null = null;
  private palette = PALETTES.light;
  private isStale = true; // something other than the camera changed
  private isFramed = false; // the camera has been pointed at what is there

  /** Throws {@link NoWebGL} where there is no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    const isSoftware = isSoftwareDrawn();
    this.isShaded = !isSoftware;
    this.world = new WorldView(this.isShaded);
    this.labels = new Labels(canvas);
    this.painter = new Painter(canvas, isSoftware, this.step, this.onResize);
    this.rig = new CameraRig(canvas, this.painter.dirty, () => this.resetView());
    this.surroundings = new Surroundings(this.scene, isSoftware);
    this.picking = new Picking(canvas, this.rig.camera, () => this.views(), this.onPick);
    this.scene.add(this.world.object);
    this.overlay.add(this.axes.object, this.contacts.object);
    this.setTheme('light');
    this.resize();
  }

  /** Draw a robot, in place of an earlier one of its name. */
  setModel(model: Model): void {
    const before = this.robots.get(model.robot);
    const events = {
      changed: () => this.onMesh(model.robot),
      problem: (text: string) => this.onProblem(text),
    };
    try {
      const entry = new RobotEntry(model, this.isShaded, events, before);
      before?.view.dispose();
      this.robots.set(model.robot, entry);
      entry.view.setPalette(this.palette);
      entry.view.showCollisions(this.options.collisions);
      this.scene.add(entry.view.object, entry.trails.object);
      this.invalidate();
    } catch (error) {
      this.onProblem(error instanceof Error ? error.message : String(error));
    }
  }

  removeRobot(robot: string): void {
    this.robots.get(robot)?.dispose();
    this.robots.delete(robot);
    if (this.followed === robot) {
      this.follow(null);
    }
    if (this.picked?.robot === robot) {
      this.picked = null;
    }
    this.invalidate();
  }

  setWorld(world: World): void {
    this.world.set(world);
    this.invalidate();
  }

  setLayout(layout: Layout): void {
    this.layout = layout;
    this.tree = new FrameTree(layout);
    this.state = null; // of another layout; what it showed stays until the next one
  }

  /** Take over a state. Those of another layout than the last are left out. */
  applyState(state: State): void {
    if (state.layout.id !== this.layout.id) {
      return;
    }
    this.state = state;
    for (const robot of state.robots) {
      this.robots.get(robot.id)?.trails.add(robot, state.time);
    }
    if (differ(this.drawn, state)) {
      this.invalidate();
    }
  }

  /** Choose the frame that stands still; null: `world` where there is truth, else TF's root. */
  setFixedFrame(name: string | null): void {
    this.chosenFrame = name;
    this.invalidate();
  }

  /** The frames to choose from. */
  frames(): string[] {
    const names = new Set(this.tree.names);
    for (const { body } of this.robots.values()) {
      if (body !== null) {
        names.add(body.base);
      }
    }
    return this.hasTruth() ? [WORLD, ...[...names].filter((name) => name !== WORLD)] : [...names];
  }

  /** The frame that stands still now. */
  currentFixedFrame(): string {
    return this.fixedFrame;
  }

  /** Frames that have no place in the fixed frame, and are not drawn. */
  unconnectedFrames(): string[] {
    return this.frames().filter((name) => this.placement.poseOf(name) === null);
  }

  show(options: Partial<SceneOptions>): void {
    this.options = { ...this.options, ...options };
    this.surroundings.showGrid(this.options.grid);
    for (const { view } of this.robots.values()) {
      view.showCollisions(this.options.collisions);
    }
    this.invalidate();
  }

  /** Let the camera go with a robot; null: stay where it is. */
  follow(robot: string | null): void {
    this.followed = robot;
    this.rig.stopFollowing();
    if (robot !== null) {
      this.lookAtRobots();
    }
    this.painter.dirty();
  }

  /** Bring the robots into view: the one that is followed, or all that are near one another. */
  resetView(): void {
    this.lookAtRobots();
    this.painter.dirty();
  }

  /** Light up a link, as a click does; null: none. */
  select(robot: string, link: string | null): void {
    this.picked = { robot, link };
    for (const [id, { view }] of this.robots) {
      view.choose(id === robot ? link : null, this.palette.highlight);
    }
    this.invalidate();
  }

  /** Begin trails anew, and let odometry and truth agree anew: after a reset. */
  clearTrails(): void {
    this.placement.clear();
    for (const { trails } of this.robots.values()) {
      trails.clear();
    }
    this.invalidate();
  }

  setTheme(theme: Theme): void {
    this.palette = PALETTES[theme];
    const views = [...this.robots.values()].map(({ view }) => view);
    for (const each of [this.surroundings, this.world, this.axes, this.contacts, ...views]) {
      each.setPalette(this.palette);
    }
    this.invalidate();
  }

  /** Take the canvas's size on the page. */
  resize(): void {
    this.painter.resize();
  }

  /** Frames drawn so far, and triangles of the last one. */
  stats(): { frames: number; triangles: number } {
    return { frames: this.painter.frames, triangles: this.painter.triangles };
  }

  dispose(): void {
    for (const robot of [...this.robots.keys()]) {
      this.removeRobot(robot);
    }
    for (const each of [
      this.picking, this.rig, this.labels, this.axes, this.contacts, this.world,
      this.surroundings, this.painter,
    ]) {
      each.dispose();
    }
  }

  private *views(): Iterable<[string, RobotEntry['view']]> {
    for (const [id, { view }] of this.robots) {
      yield [id, view];
    }
  }

  private invalidate(): void {
    this.isStale = true;
    this.painter.dirty();
  }

  private readonly onResize = (width: number, height: number, ratio: number): void => {
    this.rig.resize(width / Math.max(1, height));
    this.labels.resize(ratio);
  };

  private onMesh(robot: string): void {
    const entry = this.robots.get(robot);
    if (entry !== undefined) {
      entry.measure();
      this.contacts.forget(entry.view);
      this.invalidate();
    }
  }

  private readonly onPick = (what: Picked | null): void => {
    const { robot, link } = what ?? { robot: this.picked?.robot ?? '', link: null };
    if (robot !== '') {
      this.select(robot, link);
      this.onSelect(robot, link);
    }
  };

  /** Draw a frame; `dt` s after the last one. */
  private readonly step = (dt: number): boolean => {
    if (this.isStale) {
      this.isStale = false;
      this.place();
    }
    const followed = this.robots.get(this.followed ?? '')?.body;
    const goes = this.rig.update(dt, followed ? this.placement.poseOfBody(followed) : null);
    const { camera, target, distance } = this.rig;
    this.surroundings.follow(camera.position, target, distance);
    this.painter.paint(this.scene, this.overlay, camera);
    const { frames, frameNames } = this.options;
    const named = frames && frameNames ? labelsOf(this.placed, this.fixedFrame) : [];
    this.labels.draw(named, camera, this.palette);
    return goes;
  };

  /** Put everything where the last state has it. */
  private place(): void {
    this.readState();
    const before = this.fixedFrame;
    this.fixedFrame = this.chosenFrame ?? this.defaultFrame();
    const entries = [...this.robots.values()];
    const bodies = entries.flatMap(({ body }) => body ?? []);
    this.placement.update(this.tree, bodies, this.fixedFrame);
    const world = this.placement.poseOf(WORLD);
    this.world.place(world);
    this.surroundings.setGround(this.world.hasGround ? world : null);
    entries.forEach((entry) => entry.place(this.placement, world, this.options.trails));
    this.placeFrames();
    this.placeContacts();
    const isSomethingThere = entries.some(({ view }) => view.object.visible);
    if (isSomethingThere && (!this.isFramed || before !== this.fixedFrame)) {
      this.isFramed = true;
      this.lookAtRobots();
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
    const size = Math.max(0, ...[...this.robots.values()].map((entry) => entry.size)) || 1;
    this.axes.object.visible = this.options.frames;
    this.axes.draw(this.placed, AXIS_SHARE * size);
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

  private lookAtRobots(): void {
    const followed = this.robots.get(this.followed ?? '');
    const pose = followed?.body && this.placement.poseOfBody(followed.body);
    if (followed && pose) {
      this.rig.startFollowing(pose, followed.view.bounds());
      return;
    }
    const box = new Box3();
    for (const { view } of this.robots.values()) {
      const bounds = view.object.visible ? view.bounds() : new Box3();
      const isNear = box.isEmpty() || bounds.distanceToPoint(box.getCenter(new Vector3())) < NEAR;
      if (isNear) {
        box.union(bounds);
      }
    }
    this.rig.frame(box);
  }
}
