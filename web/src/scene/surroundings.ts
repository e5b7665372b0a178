// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Ground, sky, sun and shadows: what is there before any world. */
import {
  BackSide,
  Color,
  DirectionalLight,
  Float32BufferAttribute,
  Fog,
  Group,
  HemisphereLight,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  Scene as ThreeScene,
  ShadowMaterial,
  SphereGeometry,
  Vector3,
} from 'three';
import { Ground } from './ground';
import type { Palette } from './theme';

const FAR = 400; // m, the radius of the sky
const IDENTITY = new Matrix4();
const SUN = new Vector3(-0.9, -0.45, 1.5); // towards it
const SHADOW_PIXELS = { hardware: 2048, software: 512 };
const WIDEST = 24; // m, half of the side of what shadows fall on

export class Surroundings {
  private readonly floor = new Group(); // at z = 0 of `world`, or of the fixed frame
  private readonly fog = new Fog(0, 10, 100);
  private readonly ground = new Ground(FAR, this.fog);
  private readonly shadows = new Mesh(
    new PlaneGeometry(2, 2),
    new ShadowMaterial({ depthWrite: false }),
  );
  private readonly sky: Mesh<SphereGeometry, MeshBasicMaterial>;
  private readonly sun = new DirectionalLight();
  private readonly dome = new HemisphereLight();
  private readonly horizon = new Color();

  /**
   * Where the processor draws, pixels are dear: the sky is of one colour, and shadows fall only
   * on the ground about the robot.
   */
  constructor(scene: ThreeScene, private readonly isSoftware: boolean) {
    this.sky = new Mesh(
      new SphereGeometry(FAR, 16, 12).rotateX(Math.PI / 2),
      new MeshBasicMaterial({ vertexColors: true, side: BackSide, fog: false, depthWrite: false }),
    );
    this.sky.renderOrder = 2; // after what hides it
    this.sky.visible = !isSoftware;
    this.shadows.receiveShadow = true;
    this.shadows.renderOrder = 2; // on the ground
    this.shadows.raycast = () => {};
    this.floor.matrixAutoUpdate = false;
    this.floor.add(this.ground, this.shadows);
    this.shadows.material.polygonOffset = true; // on the ground, not in it
    this.shadows.material.polygonOffsetUnits = -20;
    this.castShadows(isSoftware ? SHADOW_PIXELS.software : SHADOW_PIXELS.hardware);
    scene.fog = this.fog;
    scene.background = this.horizon;
    scene.add(this.sky, this.floor, this.sun, this.sun.target, this.dome);
  }

  /** Where the world's ground is; null: it has none, and there is only the grid. */
  setGround(pose: Matrix4 | null): void {
    this.ground.setSolid(pose !== null);
    this.floor.matrix.copy(pose ?? IDENTITY);
    this.floor.matrixWorldNeedsUpdate = true;
  }

  /** Pixels of the picture to a CSS pixel. */
  setPixels(pixels: number): void {
    this.ground.setPixels(pixels);
  }

  showGrid(shown: boolean): void {
    this.ground.showGrid(shown);
  }

  /**
   * Follow the camera: its place, what it looks at, and how far that is; m. `size`: of the robot
   * there, m.
   */
  follow(eye: Vector3, target: Vector3, distance: number, size: number): void {
    const { x, y } = target.clone().applyMatrix4(this.floor.matrix.clone().invert());
    this.fog.near = 8 + distance;
    this.fog.far = Math.min(38 + 4 * distance, 0.9 * FAR);
    this.ground.follow(x, y);
    this.sky.position.copy(eye);
    const wide = 2 ** Math.ceil(Math.log2(Math.min(Math.max(1.2 * distance, 1), WIDEST)));
    const extent = this.isSoftware ? Math.min(size, wide) : wide;
    this.shadows.position.set(x, y, 0);
    this.shadows.scale.setScalar(extent);
    this.aimSun(target, extent);
  }

  setPalette(palette: Palette): void {
    this.horizon.set(palette.horizon);
    this.fog.color.set(palette.horizon);
    this.ground.setPalette(palette);
    this.shadows.material.opacity = palette.shadow;
    this.sun.intensity = palette.sun;
    this.dome.intensity = palette.sky;
    this.dome.groundColor.set(palette.ground).lerp(new Color('#808080'), 0.5);
    const colours: number[] = [];
    const points = this.sky.geometry.getAttribute('position');
    const zenith = new Color(palette.zenith);
    const between = new Color();
    for (let i = 0; i < points.count; i++) {
      const height = Math.max(0, points.getZ(i) / FAR);
      between.copy(this.horizon).lerp(zenith, Math.sqrt(height)).toArray(colours, 3 * i);
    }
    this.sky.geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  }

  private castShadows(pixels: number): void {
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(pixels, pixels);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    this.sun.shadow.radius = 3;
  }

  /** Light what the camera looks at; shadows are the finer the nearer it is. */
  private aimSun(target: Vector3, extent: number): void {
    // In whole pixels of the shadow map, so that edges do not swim as the camera goes.
    const pixel = (16 * extent) / this.sun.shadow.mapSize.x;
    const snap = (value: number): number => pixel * Math.round(value / pixel);
    this.sun.target.position.set(snap(target.x), snap(target.y), snap(target.z));
    this.sun.position.copy(SUN).multiplyScalar(2 * extent).add(this.sun.target.position);
    const { camera } = this.sun.shadow;
    const half = 1.5 * extent; // the square lies askew in the sun's view
    if (camera.right !== half) {
      camera.left = camera.bottom = -half;
      camera.right = camera.top = half;
      camera.near = 0.1;
      camera.far = 6 * extent;
      camera.updateProjectionMatrix();
    }
  }
}
