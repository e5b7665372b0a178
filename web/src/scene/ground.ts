// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The ground without end, and its grid: lines every metre, stronger every 10 m; finer ones come as
 * the camera nears.
 *
 * Each pixel finds its distance to the next line, in pixels, so that lines stay one pixel wide and
 * smooth, and fade out where they would lie too close together. It is level, so all of it is lit
 * alike: one colour does, and no lamp need be asked for each pixel.
 */
import { Color, Mesh, PlaneGeometry, ShaderMaterial, Vector2 } from 'three';
import type { Fog } from 'three';
import type { Palette } from './theme';

const VERTEX = /* glsl */ `
  uniform vec2 middle;
  varying vec2 place;
  varying float depth;
  void main() {
    place = position.xy + middle;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    depth = -seen.z;
    gl_Position = projectionMatrix * seen;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 base;
  uniform vec3 minor;
  uniform vec3 major;
  uniform vec3 horizon;
  uniform vec2 fog;
  uniform float solid;
  uniform float ruled;
  uniform float width;
  varying vec2 place;
  varying float depth;

  /*
   * How much of this pixel a grid covers. Place and pixel are in cells; the grid fades away where
   * a cell is less than 1/dense pixels.
   */
  float lines(vec2 at, vec2 pixel, float dense) {
    vec2 away = abs(fract(at - 0.5) - 0.5);
    vec2 fade = clamp(1.333 - pixel / (0.75 * dense), 0.0, 1.0);
    vec2 cover = clamp(1.0 - away / pixel, 0.0, 1.0) * fade;
    return max(cover.x, cover.y);
  }

  void main() {
    float near = clamp((fog.y - depth) / (fog.y - fog.x), 0.0, 1.0);
    vec2 pixel = max(width * fwidth(place), vec2(1e-6));
    float strong = 0.0;
    float cover = 0.0;
    if (ruled * near > 0.0) {
      strong = lines(0.1 * place, 0.1 * pixel, 0.3);
      cover = max(strong, 0.8 * lines(place, pixel, 0.3));
      if (min(pixel.x, pixel.y) < 0.006) {
        cover = max(cover, 0.32 * lines(10.0 * place, 10.0 * pixel, 0.06));
      }
    }
    vec3 line = mix(minor, major, strong);
    vec3 ground = mix(horizon, mix(base, line, cover), near);
    gl_FragColor = solid > 0.5 ? vec4(ground, 1.0) : vec4(line, cover * near);
    #include <colorspace_fragment>
  }
`;

// Depth within one triangle of hundreds of metres is not exact enough to draw upon it.
const CELLS = 24;

export class Ground extends Mesh<PlaneGeometry, ShaderMaterial> {
  /** `extent` in m, from the middle to the edge. */
  constructor(extent: number, private readonly mist: Fog) {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      polygonOffset: true, // behind the trails, and slabs that lie on it
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: {
        base: { value: new Color() },
        minor: { value: new Color() },
        major: { value: new Color() },
        horizon: { value: new Color() },
        middle: { value: new Vector2() },
        fog: { value: new Vector2() },
        solid: { value: 0 },
        ruled: { value: 1 },
        width: { value: 1 }, // of a line, pixels
      },
    });
    super(planeOf(extent), material);
    this.raycast = () => {};
    this.renderOrder = 1; // after what hides it
    this.setSolid(false);
  }

  /** Be a ground, or a grid only, that one can look through. */
  setSolid(solid: boolean): void {
    this.material.uniforms.solid!.value = Number(solid);
    this.material.transparent = !solid;
    this.material.depthWrite = solid;
  }

  /** Draw lines of a CSS pixel, of which the picture has so many, but never less than one. */
  setPixels(pixels: number): void {
    this.material.uniforms.width!.value = Math.max(1, pixels);
  }

  showGrid(shown: boolean): void {
    this.material.uniforms.ruled!.value = Number(shown);
  }

  /** Have its middle below a point of the ground, m. */
  follow(x: number, y: number): void {
    const { middle, fog } = this.material.uniforms;
    this.position.set(x, y, 0);
    (middle!.value as Vector2).set(x, y);
    (fog!.value as Vector2).set(this.mist.near, this.mist.far);
  }

  setPalette(palette: Palette): void {
    const { base, minor, major, horizon } = this.material.uniforms;
    (base!.value as Color).set(palette.ground);
    (minor!.value as Color).set(palette.gridMinor);
    (major!.value as Color).set(palette.gridMajor);
    (horizon!.value as Color).set(palette.horizon);
  }
}

/** A square in cells that are the smaller the nearer they are to its middle, m. */
function planeOf(extent: number): PlaneGeometry {
  const geometry = new PlaneGeometry(2, 2, CELLS, CELLS);
  const points = geometry.getAttribute('position');
  const spread = (share: number): number => extent * Math.sign(share) * Math.abs(share) ** 4;
  for (let i = 0; i < points.count; i++) {
    points.setXY(i, spread(points.getX(i)), spread(points.getY(i)));
  }
  return geometry;
}
