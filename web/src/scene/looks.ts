// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Looks: of a robot's visuals and collisions, of one that is chosen, of what is primitive. */
import {
  BufferGeometry,
  Color,
  CylinderGeometry,
  EdgesGeometry,
  Float32BufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Material,
  Mesh,
  MeshBasicMaterial,
  MeshPhongMaterial,
  Object3D,
  SRGBColorSpace,
} from 'three';

/** Black of a URDF, as black things look: a little light comes back, so that shape can be seen. */
const DARKEST = 0.028;
const SHARPEST = 25; // degrees between two faces that show an edge
const RIM_SEGMENTS = 36;

/** URDF colours are sRGB, as RViz takes them; the loader took them for linear. */
export function correctColour(material: MeshPhongMaterial): void {
  const { r, g, b } = material.color;
  material.color.setRGB(r, g, b, SRGBColorSpace);
  const { color } = material;
  color.setRGB(Math.max(color.r, DARKEST), Math.max(color.g, DARKEST), Math.max(color.b, DARKEST));
  material.specular.setScalar(0.03);
  material.shininess = 24;
}

/**
 * The outlines of a primitive, as a child of it. A cylinder gets a mark across its ends as well:
 * a wheel of one colour could not be seen to turn.
 */
export function addEdges(mesh: Mesh, material: LineBasicMaterial): LineSegments {
  const isRound = mesh.geometry instanceof CylinderGeometry;
  const lines = isRound ? cylinderLines() : new EdgesGeometry(mesh.geometry, SHARPEST);
  const edges = new LineSegments(lines, material);
  edges.raycast = () => {};
  mesh.add(edges);
  return edges;
}

/** Rims and marks of a cylinder of radius 1 and height 1 along y. */
function cylinderLines(): BufferGeometry {
  const points: number[] = [];
  for (const y of [-0.502, 0.502]) {
    for (let i = 0; i < RIM_SEGMENTS; i++) {
      for (const angle of [i, i + 1].map((at) => (2 * Math.PI * at) / RIM_SEGMENTS)) {
        points.push(Math.cos(angle), y, Math.sin(angle));
      }
    }
    points.push(0.3, y, 0, 0.85, y, 0, -0.3, y, 0, -0.85, y, 0);
    points.push(0, y, 0.3, 0, y, 0.85, 0, y, -0.3, 0, y, -0.85);
  }
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
}

export function collisionMaterial(colour: string): Material {
  return new MeshBasicMaterial({
    color: new Color(colour),
    transparent: true,
    opacity: 0.28,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -1,
  });
}

/** Lights meshes up, and gives them back their own materials. */
export class Highlight {
  private readonly originals = new Map<Mesh, Material | Material[]>();

  /** Light up what is below an object, in place of what was. */
  set(meshes: readonly Mesh[], colour: string): void {
    this.clear();
    for (const mesh of meshes) {
      this.originals.set(mesh, mesh.material);
      const lit = [mesh.material].flat().map((material) => {
        const copy = material.clone();
        if (copy instanceof MeshPhongMaterial) {
          copy.color.lerp(new Color(colour), 0.8);
          copy.emissive.set(colour);
          copy.emissiveIntensity = 0.2;
        }
        return copy;
      });
      mesh.material = Array.isArray(mesh.material) ? lit : lit[0]!;
    }
  }

  clear(): void {
    for (const [mesh, original] of this.originals) {
      [mesh.material].flat().forEach((copy) => copy.dispose());
      mesh.material = original;
    }
    this.originals.clear();
  }
}

/** Free what a tree of objects holds on the graphics card. */
export function disposeTree(object: Object3D): void {
  object.traverse((each) => {
    if (each instanceof Mesh || each instanceof LineSegments) {
      (each.geometry as BufferGeometry).dispose();
      [each.material as Material | Material[]].flat().forEach((material) => {
        if (material instanceof MeshPhongMaterial) {
          material.map?.dispose();
        }
        material.dispose();
      });
    }
  });
}
