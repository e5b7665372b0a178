// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The 3-D view: robots, frames, world, trails and contacts in the fixed frame.
 *
 * Nothing is drawn but what changed: messages and states are taken over at once, and drawn once in
 * the next frame, however many came. All methods are cheap; none waits.
 */
import type { Layout, Model, SensorInfo, World } from '../protocol';
import type { Sample } from '../samples';
import type { State } from '../state';
import { labelsOf } from './axes';
import { CameraRig } from './camera';
import { Labels } from './labels';
import { Painter } from './painter';
import { Picking, type Picked } from './picking';
import { Picture, type SceneOptions } from './picture';
import type { RobotView } from './robot';
import type { SensorNumbers } from './sensors';
import { PALETTES, type Theme } from './theme';
import { isSoftwareDrawn } from './webgl';

export type { SceneOptions } from './picture';
export { ODOMETRY_COLOUR, TRUTH_COLOUR } from './theme';
export { NoWebGL } from './webgl';

export class Scene {
  /** A link was clicked; null: nothing of this robot is chosen any more. */
  onSelect: (robot: string, link: string | null) => void = () => {};
  /** Something cannot be drawn: one line for the person before the page. */
  onProblem: (text: string) => void = () => {};
  private readonly picture: Picture;
  private readonly labels: Labels;
  private readonly painter: Painter;
  private readonly rig: CameraRig;
  private palette = PALETTES.light;
  private followed: string | null = null;
  private picked: Picked | null = null;
  private isStale = true; // something other than the camera changed
  private framed: string | null = null; // the fixed frame in which the camera was pointed

  /** Throws {@link NoWebGL} where there is no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    const isSoftware = isSoftwareDrawn();
    this.picture = new Picture(isSoftware);
    this.labels = new Labels(canvas);
    this.painter = new Painter(canvas, isSoftware, this.step, this.onResize);
    this.rig = new CameraRig(canvas, this.painter.dirty, () => this.resetView());
    const views = (): Iterable<[string, RobotView]> => this.picture.views();
    // It listens for as long as there is a canvas.
    new Picking(canvas, this.rig.camera, views, this.onPick);
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

  removeRobot(robot: string): void {
    this.picture.removeRobot(robot);
    if (this.followed === robot) {
      this.follow(null);
    }
    if (this.picked?.robot === robot) {
      this.picked = null;
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

  /** Take over a state. Those of another layout than the last are left out. */
  applyState(state: State): void {
    if (this.picture.setState(state)) {
      this.invalidate();
    }
  }

  /** Take over a sample of a sensor. */
  takeSample(info: SensorInfo, sample: Sample): void {
    this.picture.setSample(info, sample);
    this.invalidate();
  }

  /** Draw no other sensors than these topics. */
  retainSensors(topics: ReadonlySet<string>): void {
    this.picture.sensors.retain(topics);
    this.invalidate();
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

  /** The frames to choose from. */
  frames(): string[] {
    return this.picture.frames();
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
    this.followed = robot;
    this.rig.stopFollowing();
    if (robot !== null) {
      this.resetView();
    }
  }

  /** Bring the robots into view: the one that is followed, or all that are near one another. */
  resetView(): void {
    const pose = this.picture.poseOf(this.followed);
    const view = this.picture.views().get(this.followed ?? '');
    if (pose !== null && view !== undefined) {
      this.rig.startFollowing(pose, view.bounds());
    } else {
      this.rig.frame(this.picture.bounds());
    }
    this.painter.dirty();
  }

  /** Light up a link, as a click does; null: none. */
  select(robot: string, link: string | null): void {
    this.picked = { robot, link };
    for (const [id, view] of this.picture.views()) {
      view.choose(id === robot ? link : null, this.palette.highlight);
    }
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
    const { min, max } = this.picture.bounds();
    return [...min.toArray(), ...max.toArray()];
  }

  /** How many points the trails have, by robot: of the truth's, and of the odometry's. */
  trailSizes(): Record<string, [truth: number, odometry: number]> {
    return this.picture.trailSizes();
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
    this.picture.measure(robot);
    if (!this.rig.isMoved) {
      this.framed = null; // it may be larger than it was
    }
    this.invalidate();
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
    const { picture, rig } = this;
    if (this.isStale) {
      this.isStale = false;
      picture.place();
      this.pointCamera();
    }
    const goesOn = rig.update(dt, picture.poseOf(this.followed));
    picture.surroundings.follow(rig.camera.position, rig.target, rig.distance, picture.size);
    this.painter.paint(picture.scene, picture.overlay, rig.camera);
    const { frames, frameNames } = picture.options;
    const labels = frames && frameNames ? labelsOf(picture.placed, picture.fixedFrame) : [];
    this.labels.draw(labels, rig.camera, this.palette);
    return goesOn;
  };

  /** Point the camera at the robots when the first one comes, and in another fixed frame. */
  private pointCamera(): void {
    const isAnyThere = [...this.picture.views().values()].some(({ object }) => object.visible);
    if (isAnyThere && this.framed !== this.picture.fixedFrame) {
      this.framed = this.picture.fixedFrame;
      this.resetView();
    }
  }
}
