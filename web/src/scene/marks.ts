// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What others draw: markers, poses, polygons and points, each in its frame, at its time. */
import {
  BoxGeometry,
  BufferGeometry,
  CanvasTexture,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  MeshPhongMaterial,
  Points,
  PointsMaterial,
  Quaternion,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
  Vector3,
} from 'three';
import type { Object3D } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { MarkBatch, Marks, MarkText, SensorInfo } from '../protocol';
import { batchesOf, type Sample } from '../samples';
import type { LocateFrame } from './grids';
import { firstLook, type LookOf } from '../sensors/looks';
import { loadMesh, managerOf } from './meshes';
import { isMap } from './placement';
import type { Locate } from './sensors';

const THIN = 2; // CSS pixels, of lines and points without a width
const LETTERS = 48; // pixels of a letter of a text
const FINE = 500; // balls that are round
/** Of points in m: three.js has their size as if half the view's height were seen at 1 m. */
const TO_METRES = 1 / Math.tan((40 / 2) * (Math.PI / 180));

/** What is drawn of a topic, for tests: how many of each kind, and where the first is. */
export interface MarkNumbers {
  kinds: Record<string, number>;
  texts: string[];
  hidden: number; // batches and texts whose frame has no place
}

interface Part {
  frame: string;
  stamp: number | null;
  kind: string;
  count: number;
  object: Object3D;
}

interface Shown {
  info: SensorInfo;
  sample: Sample;
  group: Group;
  parts: Part[];
  /** Where frames were: what is there stays there, however old it becomes. */
  settled: Map<string, Matrix4>;
}

export class MarkLayer {
  readonly object = new Group();
  private readonly shown = new Map<string, Shown>();
  private readonly meshes = new Map<string, Object3D | null>(); // null: on its way, or not there
  private readonly shapes = {
    box: new BoxGeometry(1, 1, 1),
    sphere: new SphereGeometry(0.5, 24, 16),
    speck: new SphereGeometry(0.5, 8, 6),
    cylinder: new CylinderGeometry(0.5, 0.5, 1, 24).rotateX(Math.PI / 2),
    cone: new ConeGeometry(0.5, 1, 24).rotateX(Math.PI / 2).translate(0, 0, 0.5),
  };

  /** `changed`: a mesh is there; `failed`: it cannot be, in one line. */
  constructor(
    private readonly changed: () => void,
    private readonly failed: (text: string) => void,
    private readonly lookOf: LookOf = ({ kind }) => firstLook(kind),
    private readonly read: typeof loadMesh = loadMesh,
  ) {}

  /** Take over a sample; false: it is none of marks. */
  take(info: SensorInfo, sample: Sample): boolean {
    if (sample.head.type !== 'marks') {
      return false;
    }
    const settled = this.shown.get(info.topic)?.settled ?? new Map<string, Matrix4>();
    this.drop(info.topic);
    const group = new Group();
    const { opacity: share, order } = this.lookOf(info);
    group.renderOrder = order;
    const parts = batchesOf(sample as Sample<Marks>).map(([batch, rows]) =>
      this.partOf({ ...batch, opacity: share * batch.opacity }, rows),
    );
    parts.push(...sample.head.texts.map((text) => textOf(text, share)));
    group.add(...parts.map(({ object }) => object));
    this.object.add(group);
    const used = new Set(parts.map(keyOf));
    const kept = [...settled].filter(([key]) => used.has(key));
    this.shown.set(info.topic, { info, sample, group, parts, settled: new Map(kept) });
    this.forgetMeshes();
    return true;
  }

  /** A topic is drawn otherwise from now on. */
  restyle(topic: string): void {
    const shown = this.shown.get(topic);
    if (shown !== undefined) {
      this.take(shown.info, shown.sample);
    }
  }

  retain(topics: ReadonlySet<string>): void {
    [...this.shown.keys()].filter((topic) => !topics.has(topic)).forEach((topic) => this.drop(topic));
    this.forgetMeshes();
  }

  /** Find the places anew: another frame stands still. */
  unsettle(): void {
    this.shown.forEach(({ settled }) => settled.clear());
  }

  /** `locateMap`: of a map that TF does not have yet. */
  place(locate: Locate, locateMap: LocateFrame): void {
    for (const { info, parts, settled } of this.shown.values()) {
      for (const part of parts) {
        const known = settled.get(keyOf(part));
        const found = known ? { pose: known, isSettled: true } : locate(part.frame, info.robot, part.stamp ?? Infinity);
        const pose = found.pose ?? (isMap(part.frame) ? locateMap(part.frame, info.robot) : null);
        if (found.pose !== null && part.stamp !== null && (found.isSettled || part.stamp === 0)) {
          settled.set(keyOf(part), found.pose);
        }
        part.object.visible = pose !== null;
        if (pose !== null) {
          part.object.matrix.copy(pose);
          part.object.matrixWorldNeedsUpdate = true;
        }
      }
    }
  }

  numbers(): Record<string, MarkNumbers> {
    const pairs = [...this.shown].map(([topic, { parts }]) => {
      const kinds: Record<string, number> = {};
      for (const { kind, count } of parts.filter((part) => part.kind !== 'text')) {
        kinds[kind] = (kinds[kind] ?? 0) + count;
      }
      const texts = parts.filter(({ kind }) => kind === 'text').map(({ object }) => object.name);
      return [topic, { kinds, texts, hidden: parts.filter(({ object }) => !object.visible).length }] as const;
    });
    return Object.fromEntries(pairs);
  }

  private drop(topic: string): void {
    const shown = this.shown.get(topic);
    shown?.group.traverse((each) => this.free(each));
    shown?.group.removeFromParent();
    this.shown.delete(topic);
  }

  private free(each: Object3D): void {
    if (each instanceof Sprite) {
      each.material.map?.dispose();
      each.material.dispose();
    } else if (each instanceof InstancedMesh) {
      (each.material as MeshLambertMaterial).dispose();
      each.dispose(); // its geometry is that of all
    } else if (each instanceof Points || each instanceof LineSegments2 || (each instanceof Mesh && each.userData.own === true)) {
      (each.geometry as BufferGeometry).dispose();
      (each.material as MeshLambertMaterial).dispose();
    }
  }

  private partOf(batch: MarkBatch, rows: Float32Array): Part {
    const object = this.objectOf(batch, rows);
    object.matrixAutoUpdate = false;
    object.traverse((each) => {
      each.frustumCulled = false; // its extent is not followed
      each.raycast = () => {};
    });
    const { frame, stamp, kind, count } = batch;
    return { frame, stamp, kind, count, object };
  }

  private objectOf(batch: MarkBatch, rows: Float32Array): Object3D {
    switch (batch.kind) {
      case 'lines':
        return linesOf(batch, rows);
      case 'points':
        return new Points(geometryOf(rows), pointsLook(batch));
      case 'triangles': {
        const mesh = new Mesh(geometryOf(rows), solidLook(batch, { vertexColors: true, flatShading: true, side: DoubleSide }));
        mesh.userData.own = true;
        return mesh;
      }
      case 'mesh':
        return this.meshesOf(batch, rows);
      default: {
        const shape = batch.kind === 'sphere' && batch.count > FINE ? 'speck' : batch.kind;
        const mesh = new InstancedMesh(this.shapes[shape], solidLook(batch), batch.count);
        forEachShape(rows, (index, matrix, colour) => {
          mesh.setMatrixAt(index, matrix);
          mesh.setColorAt(index, colour);
        });
        return mesh;
      }
    }
  }

  /** A group with the mesh at each of its places, as soon as it has come. */
  private meshesOf(batch: MarkBatch, rows: Float32Array): Object3D {
    const group = new Group();
    const mesh = this.meshes.get(batch.address);
    if (mesh === undefined) {
      void this.load(batch);
    }
    // Whoever waits for it draws it with `changed`, as the sample is taken again then.
    const source = mesh ?? null;
    forEachShape(rows, (_, matrix, colour) => {
      const place = new Group();
      place.matrixAutoUpdate = false;
      place.matrix.copy(matrix);
      place.userData.colour = colour.clone();
      group.add(place);
      if (source !== null) {
        dress(place, source, batch);
      }
    });
    group.userData.batch = batch;
    return group;
  }

  /** Free the meshes that no mark has any more: there may be new ones all the time. */
  private forgetMeshes(): void {
    const parts = [...this.shown.values()].flatMap((shown) => shown.parts);
    const named = new Set(parts.map(({ object }) => (object.userData.batch as MarkBatch | undefined)?.address));
    for (const [address, mesh] of this.meshes) {
      if (!named.has(address)) {
        this.meshes.delete(address);
        mesh?.traverse((each) => (each as Partial<Mesh>).geometry?.dispose());
      }
    }
  }

  private async load(batch: MarkBatch): Promise<void> {
    const { address, resource } = batch;
    this.meshes.set(address, null);
    const files = { [resource]: address };
    try {
      const mesh = await this.read(resource, files, managerOf(files), new MeshPhongMaterial({ color: '#b0b0b0' }));
      if (!this.meshes.has(address)) {
        return; // nobody waits for it any more
      }
      this.meshes.set(address, mesh);
      for (const part of [...this.shown.values()].flatMap(({ parts }) => parts)) {
        const waiting = part.object.userData.batch as MarkBatch | undefined;
        if (waiting?.address === address) {
          part.object.children.forEach((place) => dress(place, mesh, waiting));
        }
      }
      this.changed();
    } catch (error) {
      this.failed(error instanceof Error ? error.message : String(error));
    }
  }
}

function keyOf({ frame, stamp }: Part): string {
  return `${frame}\n${stamp}`;
}

/** Put a mesh below a place, in its colour or its own. */
function dress(place: Object3D, mesh: Object3D, { is_tinted: isTinted, opacity }: MarkBatch): void {
  const copy = mesh.clone();
  const colour = place.userData.colour as Color;
  copy.traverse((each) => {
    each.frustumCulled = false;
    each.raycast = () => {};
    if (each instanceof Mesh && isTinted) {
      each.material = new MeshPhongMaterial({
        color: colour, opacity, transparent: opacity < 1, depthWrite: opacity === 1, side: DoubleSide,
      });
    }
  });
  place.add(copy);
}

function solidLook({ opacity }: MarkBatch, more: object = {}): MeshLambertMaterial {
  return new MeshLambertMaterial({ opacity, transparent: opacity < 1, depthWrite: opacity === 1, ...more });
}

function pointsLook({ opacity, size }: MarkBatch): PointsMaterial {
  return new PointsMaterial({
    size: size > 0 ? size * TO_METRES : THIN,
    sizeAttenuation: size > 0,
    vertexColors: true,
    opacity,
    transparent: opacity < 1,
  });
}

function linesOf({ opacity, size }: MarkBatch, rows: Float32Array): LineSegments2 {
  const count = rows.length / 12;
  const positions = new Float32Array(6 * count);
  const colours = new Float32Array(6 * count);
  const colour = new Color();
  for (let at = 0; at < count; at += 1) {
    positions.set(rows.subarray(12 * at, 12 * at + 6), 6 * at);
    for (const end of [0, 3]) {
      linear(colour, rows, 12 * at + 6 + end).toArray(colours, 6 * at + end);
    }
  }
  const geometry = new LineSegmentsGeometry().setPositions(positions).setColors(colours);
  const look = new LineMaterial({ linewidth: size > 0 ? size : THIN, worldUnits: size > 0, vertexColors: true });
  Object.assign(look, { opacity, transparent: opacity < 1 });
  return new LineSegments2(geometry, look);
}

function geometryOf(rows: Float32Array): BufferGeometry {
  const count = rows.length / 6;
  const positions = new Float32Array(3 * count);
  const colours = new Float32Array(3 * count);
  const colour = new Color();
  for (let at = 0; at < count; at += 1) {
    positions.set(rows.subarray(6 * at, 6 * at + 3), 3 * at);
    linear(colour, rows, 6 * at + 3).toArray(colours, 3 * at);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
  geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  return geometry;
}

function linear(colour: Color, rows: Float32Array, at: number): Color {
  return colour.setRGB(rows[at]!, rows[at + 1]!, rows[at + 2]!, SRGBColorSpace);
}

function forEachShape(rows: Float32Array, call: (index: number, matrix: Matrix4, colour: Color) => void): void {
  const [position, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
  const [matrix, colour] = [new Matrix4(), new Color()];
  for (let at = 0; at + 13 <= rows.length; at += 13) {
    matrix.compose(position.fromArray(rows, at), turn.fromArray(rows, at + 3), scale.fromArray(rows, at + 7));
    call(at / 13, matrix, linear(colour, rows, at + 10));
  }
}

/** A text that faces the viewer; its middle is its place. */
function textOf({ text, frame, stamp, position, height, colour: [r, g, b, a] }: MarkText, share: number): Part {
  const sprite = new Sprite(new SpriteMaterial({ opacity: share * a, depthWrite: false }));
  const canvas = document.createElement('canvas');
  const pen = canvas.getContext('2d');
  const font = `600 ${LETTERS}px system-ui, sans-serif`;
  if (pen !== null) {
    const lines = text.split('\n');
    pen.font = font;
    canvas.width = Math.min(2048, Math.ceil(Math.max(...lines.map((line) => pen.measureText(line).width))) + 8);
    canvas.height = Math.min(2048, Math.ceil(1.25 * LETTERS * lines.length));
    pen.font = font; // a canvas of another size has forgotten it
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillStyle = `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(' ')})`;
    lines.forEach((line, index) => pen.fillText(line, canvas.width / 2, 1.25 * LETTERS * (index + 0.5)));
    sprite.material.map = new CanvasTexture(canvas);
    sprite.material.map.colorSpace = SRGBColorSpace;
  }
  sprite.position.fromArray(position);
  sprite.scale.set((height * canvas.width) / LETTERS, (height * canvas.height) / LETTERS, 1);
  sprite.frustumCulled = false;
  sprite.raycast = () => {};
  const object = new Group();
  object.name = text;
  object.matrixAutoUpdate = false;
  object.add(sprite);
  return { frame, stamp, kind: 'text', count: 1, object };
}
