// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A line through points, some CSS pixels wide, whole or dashed, in one draw call.
 *
 * Four corners a piece and one colour: cheap enough where the processor draws, too. (The lines of
 * three.js, with round ends and a colour for each point, took it five times as long.)
 */
import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  ShaderMaterial,
  Sphere,
  Vector2,
  Color,
} from 'three';

const BIAS = -800; // of depth, so that the ground does not take half of a flat line's width

const VERTEX = /* glsl */ `
  uniform vec2 size;
  uniform float width;
  uniform float dash;
  attribute vec3 start;
  attribute vec3 end;
  const float NEAR = -0.06;

  void main() {
    vec4 a = modelViewMatrix * vec4(start, 1.0);
    vec4 b = modelViewMatrix * vec4(end, 1.0);
    bool isGap = dash > 0.0 && mod(float(gl_InstanceID), dash) >= 0.6 * dash;
    if (isGap || (a.z > NEAR && b.z > NEAR)) {
      gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // outside
      return;
    }
    // What lies behind the eye has no place in the picture.
    if (a.z > NEAR) a = mix(b, a, (NEAR - b.z) / (a.z - b.z));
    if (b.z > NEAR) b = mix(a, b, (NEAR - a.z) / (b.z - a.z));
    vec4 p = projectionMatrix * a;
    vec4 q = projectionMatrix * b;
    vec2 along = (q.xy / q.w - p.xy / p.w) * size;
    float far = length(along);
    along = far > 1e-4 ? along / far : vec2(1.0, 0.0);
    vec2 aside = 0.5 * width * position.y * vec2(-along.y, along.x);
    vec2 ahead = 0.25 * width * (2.0 * position.x - 1.0) * along; // closes gaps in bends
    gl_Position = position.x < 0.5 ? p : q;
    gl_Position.xy += 2.0 * (aside + ahead) / size * gl_Position.w;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 colour;
  void main() {
    gl_FragColor = vec4(colour, 1.0);
    #include <colorspace_fragment>
  }
`;

export class Ribbon {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly buffer: InstancedInterleavedBuffer;

  /**
   * `points`: x, y, z of each, m; `width` in CSS pixels; `dash`: points from one dash to the next,
   * 0: none; `uploaded` is called when the card has what was changed.
   */
  constructor(points: Float32Array, width: number, dash: number, uploaded: () => void) {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute(
      'position', new BufferAttribute(new Float32Array([0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0]), 3),
    );
    geometry.setIndex([0, 2, 1, 1, 2, 3]);
    this.buffer = new InstancedInterleavedBuffer(points, 3, 1);
    this.buffer.setUsage(DynamicDrawUsage);
    this.buffer.onUpload(uploaded);
    // Each point is the end of one piece and the start of the next: the two overlap.
    geometry.setAttribute('start', new InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute('end', new InterleavedBufferAttribute(this.buffer, 3, 3));
    geometry.boundingSphere = new Sphere();
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      polygonOffset: true,
      polygonOffsetUnits: BIAS,
      uniforms: {
        size: { value: new Vector2(1, 1) },
        width: { value: width },
        dash: { value: dash },
        colour: { value: new Color() },
      },
    });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false; // its extent is not followed
    this.object.raycast = () => {};
    this.object.onBeforeRender = (renderer) => {
      renderer.getSize(material.uniforms.size!.value as Vector2);
      material.uniformsNeedUpdate = true;
    };
  }

  setColour(colour: string): void {
    (this.object.material.uniforms.colour!.value as Color).set(colour);
  }

  /** Draw the first `count` points, of which those from `firstChanged` on are new. */
  draw(count: number, firstChanged: number): void {
    this.object.geometry.instanceCount = Math.max(0, count - 1);
    this.object.visible = count > 1;
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(3 * firstChanged, 3 * (count - firstChanged));
    this.buffer.needsUpdate = true;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
