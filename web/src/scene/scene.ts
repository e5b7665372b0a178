// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The 3-D view: robots, frames, world, trails and contacts in the fixed frame.
 *
 * Nothing is drawn but what changed: messages and states are taken over at once, and drawn once in
 * the next frame, however many came. All methods are cheap; none waits.
 */
import { Box3, Matrix4, Plane, Vector3 } from 'three';
import type { Place, Point } from '../navigation/gesture';
import type { Tool } from '../navigation/tool';
import type { GoalStatus, Layout, Model, SensorInfo, Vector, World } from '../protocol';
import type { Sample } from '../samples';
import type { LookOf } from '../sensors/looks';
import type { Footprint } from '../spawn/free_place';
import type { State } from '../state';
import { CameraRig } from './camera';
import { Grip, type Grasp, type Hands } from './grip';
import { Labels } from './labels';
import type { MarkNumbers } from './marks';
import type { FramedPlace, NavigationNumbers } from './navigation';
import { Painter } from './painter';
import { Picking, type Picked } from './picking';
import { Placing, type MarkedPlace } from './placing';
import { Picture, type SceneOptions } from './picture';
import type { RobotView } from './robot';
import type { SceneRobot } from './robot_marks';
import { Ruler } from './ruler';
import type { SensorNumbers } from './sensors';
import { PALETTES, type Theme } from './theme';
import type { Unseen } from './unseen';
import { massOf } from './urdf';
import { isSoftwareDrawn } from './webgl';

export type { SceneOptions } from './picture';
export { NoWebGL } from './webgl';

export class Scene {
  /** A frame of a robot was clicked; null: what is no robot's. */
  onSelect: (picked: { robot: string; frame: string } | null) => void = () => {};
  /** Something cannot be drawn: one line for the person before the page. */
  onProblem: (text: string) => void = () => {};
  /** What drags with Ctrl and Shift do; null: nothing. */
  hands: Hands | null = null;
  private readonly picture: Picture;
  private readonly picking: Picking;
  private readonly grip: Grip;
  private readonly labels: Labels;
  private readonly painter: Painter;
  private readonly rig: CameraRig;
  private readonly placing: Placing;
  private readonly ruler = new Ruler();
  private palette = PALETTES.light;
  private followed: string | null = null;
  private expected: string | null = null; // a robot that is to be in view as soon as it is there
  private isStale = true; // something other than the camera changed
  private framed: string | null = null; // the fixed frame in which the camera was pointed

  /** `lookOf`: how topics are drawn. Throws {@link NoWebGL} where there is no WebGL 2. */
  constructor(readonly canvas: HTMLCanvasElement, lookOf?: LookOf) {
    const isSoftware = isSoftwareDrawn();
    this.picture = new Picture(isSoftware, () => this.invalidate(), (text) => this.onProblem(text), lookOf);
    this.labels = new Labels(canvas);
    this.painter = new Painter(canvas, isSoftware, this.step, this.onResize);
    this.rig = new CameraRig(canvas, this.painter.dirty, () => this.resetView());
    const views = (): Iterable<[string, RobotView]> => this.picture.robots.views();
    // It listens for as long as there is a canvas.
    this.placing = new Placing(canvas, (x, y) => this.groundAt(x, y));
    this.picture.scene.add(this.placing.mark.object);
    this.placing.show(null);
    this.picking = new Picking(canvas, this.rig.camera, views, this.onPick, this.placing);
    this.grip = new Grip(canvas, this.rig.camera, this.grasp(), () => this.hands);
    this.picture.overlay.add(this.grip.object, this.ruler.object);
    this.setTheme('light');
    this.resize();
  }

  /** Draw a robot, in place of an earlier one of its name. */
  setModel(model: Model): void {
    const events = {
      changed: () => this.onMesh(model.robot),
      problem: (text: string) => this.onProblem(text),
    };
    try {
      this.picture.setModel(model, events, this.palette);
    } catch (error) {
      this.onProblem(error instanceof Error ? error.message : String(error));
    }
    this.invalidate();
  }

  /** Why nothing of a robot is to be seen; null: something is, or nothing is known of it yet. */
  unseen(robot: string): Unseen | null {
    return this.picture.unseen(robot);
  }

  removeRobot(robot: string): void {
    this.picture.removeRobot(robot);
    if (this.followed === robot) {
      this.follow(null);
    }
    this.invalidate();
  }

  setWorld(world: World): void {
    this.picture.world.set(world);
    this.invalidate();
  }

  setLayout(layout: Layout): void {
    this.picture.setLayout(layout);
  }

  /** Take over a state, of now or of the past. Those of another layout than the last are left out. */
  applyState(state: State, isPast: boolean): void {
    if (this.picture.setState(state, isPast)) {
      this.invalidate();
    }
  }

  /** Have trails go on with a state that is not shown. */
  goOn(state: State): void {
    this.picture.goOn(state);
    this.invalidate();
  }

  /** Draw the trails of all of a recording; states that come do not go on with them. */
  setRoute(states: readonly State[]): void {
    this.picture.setRoute(states);
    this.invalidate();
  }

  /** Take over a sample of a sensor. */
  takeSample(info: SensorInfo, sample: Sample): void {
    this.picture.setSample(info, sample);
    this.invalidate();
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    this.picture.restyle(topic);
    this.invalidate();
  }

  /** Draw no other sensors than these topics. */
  retainSensors(topics: ReadonlySet<string>): void {
    this.picture.sensors.retain(topics);
    this.picture.navigation.retain(topics);
    this.picture.marks.retain(topics);
    this.invalidate();
  }

  /** What is drawn of maps, paths and goals. */
  navigationNumbers(): NavigationNumbers {
    return this.picture.navigation.numbers();
  }

  /** What others draw. */
  markNumbers(): Record<string, MarkNumbers> {
    return this.picture.marks.numbers();
  }

  /** What is drawn of each sensor. */
  sensorNumbers(): Record<string, SensorNumbers> {
    return this.picture.sensors.numbers();
  }

  /** Choose the frame that stands still; null: `world` where there is truth, else TF's root. */
  setFixedFrame(name: string | null): void {
    this.picture.chosenFrame = name;
    this.invalidate();
  }

  /** Where odometry and truth agreed: the pose in world of the root of each TF tree. */
  get anchors(): Map<string, Matrix4> {
    return this.picture.anchors;
  }

  show(options: Partial<SceneOptions>): void {
    this.picture.setOptions(options);
    this.invalidate();
  }

  /** Whether a layer is shown. */
  shows(option: keyof SceneOptions): boolean {
    return this.picture.options[option];
  }

  /** Let the camera go with a robot; null: stay where it is. */
  follow(robot: string | null): void {
    if (robot === this.followed) {
      return; // whoever has turned the view would find it turned back
    }
    this.followed = robot;
    this.rig.stopFollowing();
    if (robot !== null) {
      this.resetView();
    }
  }

  /** Have a robot in view, now or as soon as it comes, and what is in view with it. */
  bringIntoView(robot: string): void {
    this.expected = robot;
    this.invalidate();
  }

  /** The robots that stand in `world`, from above. */
  footprints(): Footprint[] {
    return this.picture.robots.footprints();
  }

  /** The radius of the circle that a robot takes on the ground, m; null: it was never drawn. */
  radiusOf(robot: string): number | null {
    return this.picture.robots.radiusOf(robot);
  }

  /** Mark a place on the ground; null: none. */
  markPlace(place: MarkedPlace | null): void {
    this.placing.show(place);
    this.painter.dirty();
  }

  /** Have a place pointed at: `pointed` is told of each, `chosen` that one was clicked. */
  askForPlace(pointed: ((x: number, y: number) => void) | null, chosen: () => void = () => {}): void {
    this.placing.ask(pointed);
    this.placing.onChosen = chosen;
  }

  /** Have a point of the page pointed at, as {@link askForPlace} does a place. */
  askForPoint(pointed: ((clientX: number, clientY: number) => void) | null, chosen: () => void): void {
    this.placing.askAt(pointed);
    this.placing.onChosen = chosen;
  }

  /** Where the nearest thing, or the ground, is in the scene under a point of the page; null: nowhere. */
  surfaceAt(clientX: number, clientY: number): Vector3 | null {
    const { world, worldPose } = this.picture;
    const thing = this.picking.surfaceAt(clientX, clientY, world.object.visible ? world.object.children : []);
    const plane = new Plane(new Vector3(0, 0, 1)).applyMatrix4(worldPose ?? new Matrix4());
    const ray = this.picking.rayAt(clientX, clientY);
    const ground = ray.intersectPlane(plane, new Vector3());
    const far = (point: Vector3 | null): number => point?.distanceToSquared(ray.origin) ?? Infinity;
    return far(thing) < far(ground) ? thing : ground;
  }

  /** Draw the way between two points of the scene, with words at its middle; null: none. */
  measure(from: Vector3 | null, to: Vector3 | null, text: string): void {
    this.ruler.set(from, to, text);
    this.painter.dirty();
  }

  /** The frame that stands still. */
  get fixedFrame(): string {
    return this.picture.fixedFrame;
  }

  /** Where a frame of TF is in the scene; null: not known. */
  poseOfFrame(frame: string): Matrix4 | null {
    return this.picture.locateFrame(frame, '');
  }

  /** Look straight down, from as far as now. */
  lookDown(): void {
    this.rig.lookDown();
  }

  /** Bring the robots into view: the one that is followed, or all that are near one another. */
  resetView(): void {
    const pose = this.picture.poseOf(this.followed);
    const view = this.picture.robots.views().get(this.followed ?? '');
    if (pose !== null && view !== undefined) {
      this.rig.startFollowing(pose, view.bounds());
    } else {
      const bounds = this.picture.robots.bounds();
      this.rig.frame(bounds.isEmpty() ? new Box3().setFromObject(this.picture.world.object) : bounds);
    }
    this.painter.dirty();
  }

  /** Light up a frame of TF, and the link of a robot that it is; null: none. */
  select(robot: string | null, frame: string | null): void {
    this.picture.select(robot, frame);
    this.invalidate();
  }

  /** Mark robots by names and colours where there are several, and their fronts. */
  setRobots(robots: readonly SceneRobot[]): void {
    this.picture.setRobots(robots);
    this.invalidate();
  }

  /** Begin trails anew, and let odometry and truth agree anew: after a reset. */
  clearTrails(): void {
    this.picture.clearTrails();
    this.invalidate();
  }

  setTheme(theme: Theme): void {
    this.palette = PALETTES[theme];
    this.picture.setPalette(this.palette);
    this.grip.setPalette(this.palette);
    this.ruler.setPalette(this.palette);
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

  /** The extent of the robots that are near the first one, m: least x, y, z, then greatest. */
  extent(): number[] {
    const { min, max } = this.picture.robots.bounds();
    return [...min.toArray(), ...max.toArray()];
  }

  /** How many points the trails have, by robot: of the truth's, and of the odometry's. */
  trailSizes(): Record<string, [truth: number, odometry: number]> {
    return this.picture.robots.trailSizes();
  }

  /** The point of the ground, m in `world`, under a point of the page; null: there is none. */
  groundAt(clientX: number, clientY: number): Vector | null {
    const world = this.picture.worldPose;
    if (world === null) {
      return null;
    }
    const ray = this.picking.rayAt(clientX, clientY).applyMatrix4(world.clone().invert());
    const ground = new Plane(new Vector3(0, 0, 1));
    return ray.intersectPlane(ground, new Vector3())?.toArray() ?? null;
  }

  /** The point of the ground of a frame, such as a map, under a point of the page; null: none. */
  groundIn(frame: string, clientX: number, clientY: number): Point | null {
    const pose = this.picture.locateFrame(frame, '');
    if (pose === null) {
      return null;
    }
    const ray = this.picking.rayAt(clientX, clientY).clone().applyMatrix4(pose.clone().invert());
    return ray.intersectPlane(new Plane(new Vector3(0, 0, 1)), new Vector3());
  }

  /** Where a robot is in a frame, from above; null: not known. */
  placeIn(frame: string, robot: string): Place | null {
    const [pose, base] = [this.picture.locateFrame(frame, ''), this.picture.poseOf(robot)];
    if (pose === null || base === null) {
      return null;
    }
    const { elements } = new Matrix4().copy(pose).invert().multiply(base);
    return { x: elements[12], y: elements[13], yaw: Math.atan2(elements[1], elements[0]) };
  }

  /** Mark goals. */
  showGoals(goals: readonly GoalStatus[]): void {
    this.picture.navigation.setGoals(goals);
    this.invalidate();
  }

  /** Mark what a tool would give; null: nothing. */
  showDraft(tool: Tool, place: FramedPlace | null): void {
    this.picture.navigation.setDraft(tool, place);
    this.invalidate();
  }

  private grasp(): Grasp {
    const { picture, picking } = this;
    return {
      hit: (x, y) => picking.at(x, y),
      ray: (x, y) => picking.rayAt(x, y),
      link: (robot, link) => picture.robots.views().get(robot)?.object.links[link] ?? null,
      base: (robot) => picture.poseOf(robot),
      world: () => picture.worldPose,
      mass: (robot) => massOf(picture.robots.views().get(robot)?.model.urdf ?? ''),
      changed: this.painter.dirty,
    };
  }

  private invalidate(): void {
    this.isStale = true;
    this.painter.dirty();
  }

  private readonly onResize = (width: number, height: number): void => {
    this.rig.resize(width / Math.max(1, height));
    this.labels.resize();
  };

  private onMesh(robot: string): void {
    this.picture.measure(robot);
    if (!this.rig.isMoved) {
      this.framed = null; // it may be larger than it was
    }
    this.invalidate();
  }

  private readonly onPick = (what: Picked | null): void => {
    const isLink = what !== null && what.link !== null;
    const frame = isLink ? this.picture.robots.frameOf(what.robot, what.link as string) : null;
    this.onSelect(frame === null || what === null ? null : { robot: what.robot, frame });
  };

  /** Draw a frame; `dt` s after the last one. */
  private readonly step = (dt: number): boolean => {
    const { picture, rig } = this;
    if (this.isStale) {
      this.isStale = false;
      picture.place();
      this.placing.world = picture.worldPose;
      this.placing.settle();
      this.pointCamera();
      this.include();
    }
    const goesOn = rig.update(dt, picture.poseOf(this.followed));
    picture.surroundings.setPixels(this.painter.pixels);
    picture.surroundings.follow(rig.camera.position, rig.target, rig.distance, picture.robots.largest);
    picture.reveal(rig.camera.position, this.followed);
    this.grip.draw();
    this.painter.paint(picture.scene, picture.overlay, rig.camera);
    this.labels.draw([...picture.labels(), ...this.ruler.labels()], rig.camera, this.palette);
    return goesOn;
  };

  /** Step back until a robot that was waited for is in view. */
  private include(): void {
    const bounds = this.expected === null ? null : this.picture.robots.boundsOf(this.expected);
    if (bounds === null) {
      return; // it has not come yet
    }
    this.expected = null;
    if (this.followed === null) {
      this.rig.frame(this.picture.robots.bounds().union(bounds));
    } else {
      this.rig.include(bounds);
    }
  }

  /** Point the camera at the robots when the first one comes, and in another fixed frame. */
  private pointCamera(): void {
    const isAnyThere = [...this.picture.robots.views().values()].some(({ object }) => object.visible);
    if (isAnyThere && this.framed !== this.picture.fixedFrame) {
      this.framed = this.picture.fixedFrame;
      this.resetView();
    }
  }
}
