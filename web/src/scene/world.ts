// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The static surroundings, as the simulator has them. */
import {
  BoxGeometry,
  BufferGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  EdgesGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  PlaneGeometry,
  Raycaster,
  SphereGeometry,
  SRGBColorSpace,
} from 'three';
import type { Matrix4, Object3D, Vector3 } from 'three';
import type { Shape, World } from '../protocol';
import { disposeTree } from './looks';
import type { Palette } from './theme';

const GLASS = 0.22; // opacity of what hides the robot
const SHARPEST = 25; // degrees between two faces that show an edge
const EDGED: ReadonlySet<Shape['kind']> = new Set(['box', 'cylinder', 'triangles']);

export class WorldView {
  /** In the frame `world`. */
  readonly object = new Group();
  /** Whether there is a ground without end at z = 0; it is drawn by the scene. */
  hasGround = false;
  private readonly edges = new LineBasicMaterial({ transparent: true });
  private readonly caster = new Raycaster();
  private readonly seenThrough = new Set<ShapeMesh>();

  /** `isShaded`: it casts and takes shadows. */
  constructor(private readonly isShaded: boolean) {
    this.object.matrixAutoUpdate = false;
    this.object.visible = false;
  }

  /** Draw a world in place of the one that was. */
  set(world: World): void {
    disposeTree(this.object);
    this.seenThrough.clear();
    this.object.clear();
    this.hasGround = world.shapes.some(isGround);
    for (const shape of world.shapes.filter((each) => !isGround(each))) {
      this.object.add(this.draw(shape));
    }
  }

  /** Put `world` somewhere in the frame of the scene; null: hide it. */
  place(pose: Matrix4 | null): void {
    this.object.visible = pose !== null;
    if (pose !== null) {
      this.object.matrix.copy(pose);
      this.object.matrixWorldNeedsUpdate = true;
    }
  }

  setPalette(palette: Palette): void {
    this.edges.color.set(palette.edge);
    this.edges.opacity = palette.edgeOpacity;
  }

  /**
   * Let one look through the shapes that hide points from the eye, and through no others; m, in the
   * frame of the scene.
   */
  reveal(eye: Vector3, points: readonly Vector3[]): void {
    const hiding = new Set<Object3D>();
    for (const point of points) {
      this.caster.far = eye.distanceTo(point);
      this.caster.set(eye, point.clone().sub(eye).normalize());
      const hits = this.caster.intersectObjects(this.object.children, false);
      hits.forEach(({ object }) => hiding.add(object));
    }
    for (const mesh of this.seenThrough) {
      if (!hiding.has(mesh)) {
        setSeenThrough(mesh, false);
        this.seenThrough.delete(mesh);
      }
    }
    for (const mesh of hiding) {
      if (!this.seenThrough.has(mesh as ShapeMesh)) {
        setSeenThrough(mesh as ShapeMesh, true);
        this.seenThrough.add(mesh as ShapeMesh);
      }
    }
  }

  private draw(shape: Shape): ShapeMesh {
    const [r, g, b, a] = shape.colour;
    const mesh = new Mesh(
      geometryOf(shape),
      new MeshLambertMaterial({
        color: new Color().setRGB(r, g, b, SRGBColorSpace),
        opacity: a,
        transparent: a < 1,
        depthWrite: a === 1,
        flatShading: shape.kind === 'triangles',
      }),
    );
    mesh.name = shape.name;
    mesh.position.fromArray(shape.position);
    mesh.quaternion.fromArray(shape.orientation);
    mesh.castShadow = this.isShaded && a > 0.5 && shape.kind !== 'plane';
    mesh.receiveShadow = this.isShaded;
    if (EDGED.has(shape.kind)) {
      const edges = new LineSegments(new EdgesGeometry(mesh.geometry, SHARPEST), this.edges);
      edges.raycast = () => {};
      mesh.add(edges);
    }
    return mesh;
  }
}

type ShapeMesh = Mesh<BufferGeometry, MeshLambertMaterial>;

/** Draw a shape as if of glass, or as it is. */
function setSeenThrough({ material, userData }: ShapeMesh, isSeenThrough: boolean): void {
  userData.opacity ??= material.opacity;
  const own = userData.opacity as number;
  material.opacity = isSeenThrough ? Math.min(own, GLASS) : own;
  material.transparent = material.opacity < 1;
  material.depthWrite = !material.transparent;
  material.needsUpdate = true;
}

/** A plane without end, level, at height 0. */
function isGround({ kind, size, position, orientation }: Shape): boolean {
  const isLevel = Math.hypot(orientation[0], orientation[1]) < 1e-6;
  return kind === 'plane' && size[0] === 0 && isLevel && Math.abs(position[2]) < 1e-6;
}

/** A shape about its own origin, m; axes of bodies of revolution along z. */
function geometryOf({ kind, size: [x, y, z], points }: Shape): BufferGeometry {
  switch (kind) {
    case 'box':
      return new BoxGeometry(x, y, z);
    case 'sphere':
      return new SphereGeometry(0.5, 32, 20).scale(x, y, z);
    case 'cylinder':
      return new CylinderGeometry(0.5, 0.5, 1, 40).rotateX(Math.PI / 2).scale(x, y, z);
    case 'capsule':
      return new CapsuleGeometry(x / 2, Math.max(0, z - x), 10, 28).rotateX(Math.PI / 2);
    case 'plane':
      return new PlaneGeometry(x || ENDLESS, y || ENDLESS);
    case 'triangles': {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
      geometry.computeVertexNormals();
      return geometry;
    }
  }
}

const ENDLESS = 800; // m, beyond what the camera sees
