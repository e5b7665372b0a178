// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Maps and costmaps: flat, just above the ground, in their own frames. */
import {
  DataTexture, Group, LinearMipmapLinearFilter, Matrix4, Mesh, MeshBasicMaterial, NearestFilter,
  PlaneGeometry, Quaternion, RGBAFormat, SRGBColorSpace, Vector3,
} from 'three';
import { coloured, inflate, schemeOf } from '../navigation/cells';
import type { OccupancyGrid, SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import type { Look } from '../sensors/looks';

const LIFT = { map: 0.002, costmap: 0.003 }; // m
const ANISOTROPY = 8; // sharp where one looks along the ground
const ONES = new Vector3(1, 1, 1);

/** Where a frame of a robot is in the scene; null: nowhere. */
export type LocateFrame = (frame: string, robot: string) => Matrix4 | null;

interface Shown {
  robot: string;
  head: OccupancyGrid;
  mesh: Mesh<PlaneGeometry, MeshBasicMaterial> | null; // null: its cells are still deflated
  turn: number; // of the sample that is shown, or on its way
}

export class Grids {
  readonly object = new Group();
  private readonly shown = new Map<string, Shown>();

  /** `changed`: one is there that was not; `failed`: one cannot be drawn, in one line. */
  constructor(
    private readonly changed: () => void,
    private readonly failed: (text: string) => void,
    private readonly lookOf: (topic: string) => Pick<Look, 'opacity' | 'order'> = () => ({ opacity: 1, order: 0 }),
  ) {}

  take({ topic, robot }: SensorInfo, { head, bytes }: Sample<OccupancyGrid>): void {
    const before = this.shown.get(topic);
    const each = before ?? { robot, head, mesh: null, turn: 0 };
    each.turn += 1;
    this.shown.set(topic, each);
    const { turn } = each;
    const isLatest = (): boolean => this.shown.get(topic) === each && each.turn === turn;
    void inflate(bytes, head.width * head.height).then(
      (cells) => {
        if (isLatest()) {
          each.head = head;
          this.draw(topic, each, cells);
          this.changed();
        }
      },
      (error: unknown) => this.failed(`${topic}: ${error instanceof Error ? error.message : String(error)}`),
    );
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    const mesh = this.shown.get(topic)?.mesh;
    if (mesh) {
      this.dress(mesh, topic);
    }
  }

  /** On the ground, below the marks of robots, costmaps over maps where nothing else was said. */
  private dress(mesh: NonNullable<Shown['mesh']>, topic: string): void {
    const { opacity, order } = this.lookOf(topic);
    mesh.material.opacity = opacity;
    const usual = schemeOf(topic) === 'map' ? 2 : 2.5;
    mesh.renderOrder = Math.min(2.95, Math.max(1.05, usual + order / 10));
  }

  /** Draw no others than these. */
  retain(topics: ReadonlySet<string>): void {
    for (const [topic, each] of [...this.shown]) {
      if (!topics.has(topic)) {
        dispose(each.mesh);
        this.shown.delete(topic);
      }
    }
  }

  place(locate: LocateFrame): void {
    for (const { robot, head, mesh } of this.shown.values()) {
      const pose = mesh && locate(head.origin.frame, robot);
      if (mesh !== null) {
        mesh.visible = pose !== null;
      }
      if (mesh !== null && pose !== null) {
        const origin = new Vector3(...head.position);
        mesh.matrix.compose(origin, new Quaternion(...head.orientation).normalize(), ONES).premultiply(pose);
        mesh.matrixWorldNeedsUpdate = true;
      }
    }
  }

  /** The cells of each map that is drawn. */
  numbers(): Record<string, number> {
    const drawn = [...this.shown].filter(([, { mesh }]) => mesh?.visible === true);
    return Object.fromEntries(drawn.map(([topic, { head }]) => [topic, head.width * head.height]));
  }

  private draw(topic: string, each: Shown, cells: Int8Array): void {
    const { width, height, resolution } = each.head;
    const scheme = schemeOf(topic);
    const texture = new DataTexture(coloured(cells, scheme), width, height, RGBAFormat);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = NearestFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.generateMipmaps = true;
    texture.anisotropy = ANISOTROPY;
    texture.needsUpdate = true;
    const geometry = new PlaneGeometry(width * resolution, height * resolution);
    geometry.translate((width * resolution) / 2, (height * resolution) / 2, LIFT[scheme]);
    const material = new MeshBasicMaterial({
      map: texture, transparent: true, depthWrite: false, toneMapped: false,
      polygonOffset: true, polygonOffsetUnits: scheme === 'map' ? -8 : -16, // before the ground
    });
    dispose(each.mesh);
    const mesh = new Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.visible = false; // until it has its place
    mesh.raycast = () => {};
    this.dress(mesh, topic);
    each.mesh = mesh;
    this.object.add(mesh);
  }
}

function dispose(mesh: Shown['mesh']): void {
  mesh?.removeFromParent();
  mesh?.geometry.dispose();
  mesh?.material.map?.dispose();
  mesh?.material.dispose();
}
