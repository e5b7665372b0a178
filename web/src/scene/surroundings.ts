// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The ground without end and its grid, the sky, the sun: what is there before any world. */
import {
  BackSide,
  BufferGeometry,
  Color,
  DirectionalLight,
  Float32BufferAttribute,
  Fog,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  Scene as ThreeScene,
  ShadowMaterial,
  SphereGeometry,
  Vector3,
} from 'three';
import type { Palette } from './theme';

const CELLS = 60; // of the grid, from its middle to its edge
const MAJOR = 10; // cells
const FAR = 400; // m, the radius of the sky
const IDENTITY = new Matrix4();

export class Surroundings {
  /** Ground and grid, at z = 0 of whatever it is put into. */
  readonly ground = new Group();
  private readonly plane = new Mesh(new PlaneGeometry(2 * FAR, 2 * FAR));
  private readonly opaque = new MeshLambertMaterial();
  private readonly shadowsOnly = new ShadowMaterial({ opacity: 0.22 });
  private readonly minor = new LineSegments(gridLines(false), new LineBasicMaterial());
  private readonly major = new LineSegments(gridLines(true), new LineBasicMaterial());
  private readonly sky: Mesh<SphereGeometry, MeshBasicMaterial>;
  private readonly sun = new DirectionalLight();
  private readonly dome = new HemisphereLight();
  private readonly fog = new Fog(0, 10, 100);

  constructor(scene: ThreeScene, shadowPixels: number) {
    this.sky = new Mesh(
      new SphereGeometry(FAR, 16, 12).rotateX(Math.PI / 2),
      new MeshBasicMaterial({ vertexColors: true, side: BackSide, fog: false, depthWrite: false }),
    );
    this.sky.renderOrder = -1;
    for (const material of [this.opaque, this.shadowsOnly]) {
      material.polygonOffset = true; // behind the grid, the trails, and slabs that lie on it
      material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    }
    this.plane.receiveShadow = true;
    this.ground.add(this.plane, this.minor, this.major);
    this.castShadows(shadowPixels);
    scene.fog = this.fog;
    scene.add(this.sky, this.ground, this.sun, this.sun.target, this.dome);
    this.ground.matrixAutoUpdate = false;
    this.setGround(null);
  }

  /** Where the world's ground is; null: it has none, and the fixed frame's floor gets shadows. */
  setGround(pose: Matrix4 | null): void {
    this.plane.material = pose === null ? this.shadowsOnly : this.opaque;
    this.ground.matrix.copy(pose ?? IDENTITY);
    this.ground.matrixWorldNeedsUpdate = true;
  }

  showGrid(shown: boolean): void {
    this.minor.visible = this.major.visible = shown;
  }

  /** Follow the camera: its place, what it looks at, and how far that is; m. */
  follow(eye: Vector3, target: Vector3, distance: number): void {
    const { x, y } = target.clone().applyMatrix4(this.ground.matrix.clone().invert());
    const cell = distance > 40 ? 10 : 1;
    const step = cell * MAJOR;
    for (const grid of [this.minor, this.major]) {
      grid.position.set(step * Math.round(x / step), step * Math.round(y / step), 0);
      grid.scale.setScalar(cell);
    }
    this.plane.position.set(x, y, 0);
    this.sky.position.copy(eye);
    this.fog.near = 8 + distance;
    this.fog.far = Math.min(38 + 4 * distance, 0.9 * FAR);
    this.aimSun(target, distance);
  }

  setPalette(palette: Palette): void {
    this.fog.color.set(palette.horizon);
    this.opaque.color.set(palette.ground);
    this.minor.material.color.set(palette.gridMinor);
    this.major.material.color.set(palette.gridMajor);
    this.sun.intensity = palette.sun;
    this.dome.intensity = palette.sky;
    this.dome.color.set('#ffffff');
    this.dome.groundColor.set(palette.ground).lerp(new Color('#808080'), 0.5);
    const colours: number[] = [];
    const points = this.sky.geometry.getAttribute('position');
    const low = new Color(palette.horizon);
    const high = new Color(palette.zenith);
    const between = new Color();
    for (let i = 0; i < points.count; i++) {
      const height = Math.max(0, points.getZ(i) / FAR);
      between.copy(low).lerp(high, Math.sqrt(height)).toArray(colours, 3 * i);
    }
    this.sky.geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  }

  dispose(): void {
    for (const each of [this.sky, this.plane, this.minor, this.major]) {
      each.geometry.dispose();
    }
    for (const each of [this.sky, this.minor, this.major]) {
      each.material.dispose();
    }
    this.opaque.dispose();
    this.shadowsOnly.dispose();
    this.sun.dispose();
  }

  private castShadows(pixels: number): void {
    this.sun.up.set(0, 0, 1);
    this.sun.castShadow = pixels > 0;
    this.sun.shadow.mapSize.set(pixels, pixels);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    this.sun.shadow.radius = 3;
  }

  /** Light what the camera looks at; shadows are the finer the nearer it is. */
  private aimSun(target: Vector3, distance: number): void {
    const extent = 2 ** Math.ceil(Math.log2(Math.min(Math.max(1.2 * distance, 1.5), 24)));
    const pixel = (2 * extent) / Math.max(1, this.sun.shadow.mapSize.x);
    const snap = (value: number): number => 8 * pixel * Math.round(value / (8 * pixel));
    this.sun.target.position.set(snap(target.x), snap(target.y), snap(target.z));
    this.sun.position.set(-0.45, 0.65, 1.25).multiplyScalar(2 * extent);
    this.sun.position.add(this.sun.target.position);
    const { camera } = this.sun.shadow;
    if (camera.right !== extent) {
      camera.left = camera.bottom = -extent;
      camera.right = camera.top = extent;
      camera.near = 0.1;
      camera.far = 6 * extent;
      camera.updateProjectionMatrix();
    }
  }
}

function gridLines(major: boolean): BufferGeometry {
  const points: number[] = [];
  for (let i = -CELLS; i <= CELLS; i++) {
    if ((i % MAJOR === 0) === major) {
      points.push(i, -CELLS, 0, i, CELLS, 0, -CELLS, i, 0, CELLS, i, 0);
    }
  }
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
}
