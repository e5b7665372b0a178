// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What there is of navigation in the scene: maps, paths, goals, and where robots believe they are. */
import { BufferGeometry, Float32BufferAttribute, Group, Matrix4, Mesh, MeshBasicMaterial } from 'three';
import type { Place } from '../navigation/gesture';
import type { Tool } from '../navigation/tool';
import type { GoalStatus, OccupancyGrid, Route, SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import { Grids, type LocateFrame } from './grids';
import { Routes } from './routes';
import type { Palette } from './theme';

const LIFT = 0.02; // m
const LENGTH = 0.6; // m, of an arrow

/** A pose in a frame of TF. */
export interface FramedPlace extends Place {
  frame: string;
}

/** What is drawn of it, for tests: cells and points, by topic, and how many arrows. */
export interface NavigationNumbers {
  maps: Record<string, number>;
  paths: Record<string, number>;
  arrows: number;
}

type Arrow = Mesh<BufferGeometry, MeshBasicMaterial>;

export class NavigationLayer {
  /** Hidden by what is before it. */
  readonly object = new Group();
  /** Seen through everything. */
  readonly marks = new Group();
  private readonly grids: Grids;
  private readonly routes = new Routes();
  private readonly shape = arrow();
  private readonly goalLook = look();
  private readonly poseLook = look();
  private readonly draft = this.newArrow(this.goalLook);
  private drafted: FramedPlace | null = null;
  private goals: readonly GoalStatus[] = [];
  private readonly goalArrows: Arrow[] = [];
  private readonly believed: Arrow[] = [];

  /** `lookOf`: of a map, by its topic. */
  constructor(changed: () => void, failed: (text: string) => void, lookOf?: ConstructorParameters<typeof Grids>[2]) {
    this.grids = new Grids(changed, failed, lookOf);
    this.object.add(this.grids.object, this.routes.object);
  }

  setPalette({ path, pose, gridMajor }: Palette): void {
    this.routes.setColours(path, gridMajor);
    this.goalLook.color.set(path);
    this.poseLook.color.set(pose);
  }

  /** Take over a sample; false: it is none of a map or a path. */
  take(info: SensorInfo, sample: Sample): boolean {
    if (sample.head.type === 'map') {
      this.grids.take(info, sample as Sample<OccupancyGrid>);
    } else if (sample.head.type === 'path') {
      this.routes.take(info, sample as Sample<Route>);
    } else {
      return false;
    }
    return true;
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    this.grids.restyle(topic);
  }

  retain(topics: ReadonlySet<string>): void {
    this.grids.retain(topics);
    this.routes.retain(topics);
  }

  show({ maps, paths }: { maps: boolean; paths: boolean }): void {
    this.grids.object.visible = maps;
    this.routes.object.visible = paths;
  }

  /** Mark these goals; the paths to those that have ended fade. */
  setGoals(goals: readonly GoalStatus[]): void {
    const robots = new Set(goals.map(({ robot }) => robot));
    this.goals.filter(({ robot }) => !robots.has(robot)).forEach(({ robot }) => this.routes.fade(robot));
    this.goals = goals;
  }

  /** Mark what a tool would give; null: nothing. */
  setDraft(tool: Tool, place: FramedPlace | null): void {
    this.draft.material = tool === 'goal' ? this.goalLook : this.poseLook;
    this.drafted = place;
  }

  /** `believed`: where robots are as their localisation has it, in the scene. */
  place(locate: LocateFrame, believed: readonly Matrix4[]): void {
    this.grids.place(locate);
    this.routes.place(locate);
    this.set(this.draft, this.drafted === null ? null : poseOf(this.drafted, '', locate));
    this.setAll(this.goalArrows, this.goalLook, this.goals.map((goal) => poseOf(goal, goal.robot, locate)));
    this.setAll(this.believed, this.poseLook, believed);
  }

  numbers(): NavigationNumbers {
    const arrows = this.marks.children.filter(({ visible }) => visible).length;
    return { maps: this.grids.numbers(), paths: this.routes.numbers(), arrows };
  }

  private setAll(arrows: Arrow[], material: MeshBasicMaterial, poses: readonly (Matrix4 | null)[]): void {
    while (arrows.length < poses.length) {
      arrows.push(this.newArrow(material));
    }
    arrows.forEach((each, index) => this.set(each, poses[index] ?? null));
  }

  private set(mark: Arrow, pose: Matrix4 | null): void {
    mark.visible = pose !== null;
    if (pose !== null) {
      mark.matrix.copy(pose);
      mark.matrixWorldNeedsUpdate = true;
    }
  }

  private newArrow(material: MeshBasicMaterial): Arrow {
    const mesh = new Mesh(this.shape, material);
    mesh.matrixAutoUpdate = false;
    mesh.visible = false;
    mesh.renderOrder = 5;
    mesh.raycast = () => {};
    this.marks.add(mesh);
    return mesh;
  }
}

function poseOf({ frame, x, y, yaw }: FramedPlace, robot: string, locate: LocateFrame): Matrix4 | null {
  const pose = locate(frame, robot);
  return pose && new Matrix4().makeRotationZ(yaw).setPosition(x, y, LIFT).premultiply(pose);
}

function look(): MeshBasicMaterial {
  return new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.9 });
}

/** A flat arrow from the origin ahead, m. */
function arrow(): BufferGeometry {
  const [shaft, neck, head] = [0.04 * LENGTH, 0.62 * LENGTH, 0.17 * LENGTH];
  const points = [
    0, -shaft, 0, neck, -shaft, 0, neck, shaft, 0, 0, shaft, 0,
    neck, -head, 0, LENGTH, 0, 0, neck, head, 0,
  ];
  const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3, 4, 5, 6]);
  return geometry;
}
