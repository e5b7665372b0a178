// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What a robot of urdf-loader is made of. */
import { Mesh, Vector3 } from 'three';
import type { Object3D } from 'three';
import type { URDFJoint } from 'urdf-loader';

/** The visual meshes below an object; `deep`: those of links further down, too. */
export function meshesOf(object: Object3D, deep: boolean): Mesh[] {
  const found: Mesh[] = [];
  const visit = (each: Object3D): void => {
    if ('isURDFCollider' in each || (!deep && 'isURDFJoint' in each)) {
      return;
    }
    if (each instanceof Mesh) {
      found.push(each as Mesh);
    }
    each.children.forEach(visit);
  };
  visit(object);
  return found;
}

/** Whether a mesh is a box, a cylinder or a sphere: the loader makes them of unit size. */
export function isPrimitive(mesh: Mesh): boolean {
  return 'parameters' in mesh.geometry;
}

/** The radius of what a joint turns, about the joint's axis, m; 0 if nothing of it is drawn. */
export function radiusAbout(joint: URDFJoint): number {
  const link = joint.children.find((child) => 'isURDFLink' in child);
  if (link === undefined) {
    return 0;
  }
  const toLink = link.matrixWorld.clone().invert();
  const corner = new Vector3();
  let radius = 0;
  for (const mesh of meshesOf(link, false)) {
    const points = mesh.geometry.getAttribute('position');
    const inLink = toLink.clone().multiply(mesh.matrixWorld);
    for (let i = 0; i < points.count; i++) {
      corner.fromBufferAttribute(points, i).applyMatrix4(inLink);
      const along = corner.dot(joint.axis);
      radius = Math.max(radius, Math.sqrt(Math.max(0, corner.lengthSq() - along * along)));
    }
  }
  return radius;
}
