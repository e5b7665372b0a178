// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Lines of some pixels' width that change all the time, in one draw call. */
import {
  DynamicDrawUsage,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Sphere,
} from 'three';
import type { Color, Vector3 } from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';

const FLOATS = 6; // two ends, three numbers each

export class Segments {
  readonly object: LineSegments2;
  private readonly geometry = new LineSegmentsGeometry();
  private positions = new Float32Array(0);
  private colours = new Float32Array(0);
  private count = 0;

  /** `width` in CSS pixels. */
  constructor(width: number, opacity = 1) {
    const material = new LineMaterial({ linewidth: width, vertexColors: true });
    material.transparent = opacity < 1;
    material.opacity = opacity;
    this.object = new LineSegments2(this.geometry, material);
    this.object.frustumCulled = false; // its extent is not followed
    this.geometry.boundingSphere = new Sphere(); // nor asked for
    this.object.raycast = () => {};
    this.grow(64);
  }

  /** Begin anew: nothing is drawn but what comes from now on. */
  clear(): void {
    this.count = 0;
  }

  /** A line from one point to another, m in the frame of the scene. */
  add(from: Vector3, to: Vector3, colour: Color): void {
    if (FLOATS * this.count === this.positions.length) {
      this.grow(2 * this.count);
    }
    const at = FLOATS * this.count++;
    from.toArray(this.positions, at);
    to.toArray(this.positions, at + 3);
    colour.toArray(this.colours, at);
    colour.toArray(this.colours, at + 3);
  }

  /** Hand all to the graphics card. */
  commit(): void {
    this.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
    for (const name of ['instanceStart', 'instanceColorStart']) {
      (this.geometry.getAttribute(name) as InterleavedBufferAttribute).data.needsUpdate = true;
    }
  }

  private grow(count: number): void {
    const resize = (old: Float32Array): Float32Array<ArrayBuffer> => {
      const grown = new Float32Array(FLOATS * count);
      grown.set(old);
      return grown;
    };
    this.geometry.dispose(); // buffers of another size
    this.positions = this.bind(resize(this.positions), 'instanceStart', 'instanceEnd');
    this.colours = this.bind(resize(this.colours), 'instanceColorStart', 'instanceColorEnd');
  }

  private bind(
    array: Float32Array<ArrayBuffer>, start: string, end: string,
  ): Float32Array<ArrayBuffer> {
    const buffer = new InstancedInterleavedBuffer(array, FLOATS, 1).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
    this.geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
    return array;
  }
}
