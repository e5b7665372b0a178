// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Points that change all the time, of some pixels' size, in one draw call. */
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, PointsMaterial, Sphere } from 'three';
import type { Look } from '../sensors/looks';

const NEARER = 0.985; // of the way to the camera: points on a surface are seen whole
const NEARER_YET = 0.001; // for each step of the order

export class DynamicPoints {
  readonly object: Points<BufferGeometry, PointsMaterial>;
  positions = new Float32Array(0);
  colours = new Uint8Array(0);
  private readonly nearer = { value: NEARER };

  /** `size` in CSS pixels. */
  constructor(size: number) {
    const material = new PointsMaterial({ size, sizeAttenuation: false, vertexColors: true });
    // Towards the camera along the line of sight: on the screen they stay where they are.
    material.onBeforeCompile = (shader) => {
      shader.uniforms.nearer = this.nearer;
      shader.vertexShader = `uniform float nearer;\n${shader.vertexShader}`.replace(
        '#include <project_vertex>',
        `#include <project_vertex>
         gl_Position = projectionMatrix * vec4(mvPosition.xyz * nearer, 1.0);`,
      );
    };
    this.object = new Points(new BufferGeometry(), material);
    this.object.geometry.boundingSphere = new Sphere();
    this.object.frustumCulled = false; // its extent is not followed
    this.object.matrixAutoUpdate = false;
    this.object.raycast = () => {};
  }

  /** `size` in CSS pixels; opacity 0..1; those of a greater order lie over the others. */
  setLook({ size, opacity, order }: Pick<Look, 'size' | 'opacity' | 'order'>): void {
    const { material } = this.object;
    this.object.renderOrder = order;
    this.nearer.value = NEARER - NEARER_YET * order;
    material.size = size;
    material.opacity = opacity;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
    material.needsUpdate = true;
  }

  /** Make room for so many points, x y z and r g b of each. */
  reserve(count: number): void {
    const { geometry } = this.object;
    if (3 * count > this.positions.length) {
      geometry.dispose(); // buffers of another size
      const size = 2 ** Math.ceil(Math.log2(Math.max(64, count)));
      this.positions = new Float32Array(3 * size);
      this.colours = new Uint8Array(3 * size);
      for (const [name, array] of [['position', this.positions], ['color', this.colours]] as const) {
        const attribute = new BufferAttribute(array, 3, name === 'color');
        geometry.setAttribute(name, attribute.setUsage(DynamicDrawUsage));
      }
    }
  }

  /** Hand the first so many to the graphics card. */
  commit(count: number): void {
    const { geometry } = this.object;
    geometry.setDrawRange(0, count);
    for (const name of ['position', 'color']) {
      const attribute = geometry.getAttribute(name);
      if (attribute instanceof BufferAttribute) {
        attribute.clearUpdateRanges();
        attribute.addUpdateRange(0, 3 * count);
        attribute.needsUpdate = true;
      }
    }
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
