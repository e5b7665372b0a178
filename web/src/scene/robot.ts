// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** One robot as its URDF draws it. */
import {
  Box3,
  LineBasicMaterial,
  Material,
  Matrix4,
  Mesh,
  MeshPhongMaterial,
  Object3D,
  Vector3,
} from 'three';
import URDFLoader from 'urdf-loader';
import type { URDFJoint, URDFMimicJoint, URDFRobot } from 'urdf-loader';
import type { Model } from '../protocol';
import { addEdges, collisionMaterial, correctColour, disposeTree, Highlight } from './looks';
import { loadMesh, managerOf } from './meshes';
import { isPrimitive, meshesOf, radiusAbout } from './parts';
import { WORLD } from './placement';
import { PALETTES, type Palette } from './theme';
import { BadModel, readUrdf } from './urdf';

/** The settings of a view for its scene. */
export interface RobotEvents {
  changed(): void; // a mesh has come
  problem(text: string): void; // something cannot be drawn
}

interface LinkPart {
  name: string;
  parent: number; // index in `parts`; -1: none
  joint: URDFJoint | null; // to the parent
  pose: Matrix4; // in the root
}

export class RobotView {
  /** The URDF's root link; the scene puts it where it is. */
  readonly object: URDFRobot;
  /** The link whose pose the truth and odometry are. */
  readonly base: string;
  private readonly parts: LinkPart[] = []; // parents before children
  private readonly basePart: LinkPart;
  private readonly colliders: Object3D[] = [];
  private readonly problems = new Set<string>();
  private readonly highlight = new Highlight();
  private readonly edges = new LineBasicMaterial({ transparent: true });
  private collider = collisionMaterial(PALETTES.light.collision);
  private chosen: string | null = null;
  private areCollisionsShown = false;

  /** Throws {@link BadModel} where the URDF cannot be drawn at all. */
  constructor(
    readonly model: Model,
    private readonly isShaded: boolean,
    private readonly events: RobotEvents,
  ) {
    this.object = this.load();
    this.object.matrixAutoUpdate = false;
    this.object.visible = false;
    this.listParts(this.object, -1, null);
    const root = this.parts[0]!;
    // A robot that is fixed to the world by its URDF is its first link.
    this.basePart = (root.name === WORLD && this.parts[1]) || root;
    this.base = this.basePart.name;
    this.dress();
  }

  joint(name: string): URDFJoint | undefined {
    return this.object.joints[name];
  }

  /** The links that move in their parents. */
  get movingLinks(): { link: string; parent: string; joint: string }[] {
    const moving = this.parts.filter(({ joint }) => joint !== null && joint.jointType !== 'fixed');
    return moving.map(({ name, parent, joint }) => ({
      link: name,
      parent: this.parts[parent]!.name,
      joint: joint?.name ?? '',
    }));
  }

  /** Move the joints, rad or m; what is not known stays. Mimic joints follow, or lead if known. */
  setJoints(names: readonly string[], positions: Float32Array): void {
    for (const isMimic of [false, true]) {
      names.forEach((name, index) => {
        const joint = this.object.joints[name];
        const known = joint !== undefined && Number.isFinite(positions[index]);
        if (known && isMimicJoint(joint) === isMimic) {
          joint.setJointValue(positions[index]!);
        }
      });
    }
  }

  /** Put a link where TF has it in its parent: for joints without published positions. */
  setLinkPose(link: string, inParent: Matrix4): void {
    const joint = this.parts.find(({ name }) => name === link)?.joint;
    if (joint) {
      inParent.decompose(joint.position, joint.quaternion, new Vector3());
    }
  }

  /** The pose of each link in the base, as the joints are now. The matrices are this one's own. */
  linkPoses(): ReadonlyMap<string, Matrix4> {
    for (const { joint, parent, pose } of this.parts) {
      if (joint !== null) {
        joint.updateMatrix();
        pose.multiplyMatrices(this.parts[parent]!.pose, joint.matrix);
      }
    }
    const toBase = this.basePart.pose.clone().invert();
    const below = this.parts.filter(({ name }) => name !== WORLD);
    return new Map(below.map(({ name, pose }) => [name, toBase.clone().multiply(pose)]));
  }

  /** Set the pose of the base; null: unknown. */
  place(pose: Matrix4 | null): void {
    this.object.visible = pose !== null;
    if (pose !== null) {
      this.object.matrix.copy(this.basePart.pose).invert().premultiply(pose);
      this.object.updateMatrixWorld(true);
    }
  }

  /** Its visible extent, m, in the frame of the scene. */
  bounds(): Box3 {
    const box = new Box3();
    this.object.updateMatrixWorld(true);
    this.visuals().forEach((mesh) => box.expandByObject(mesh));
    return box;
  }

  /** Its visible extent in its base, m, as its joints are; null: nothing is drawn. */
  localBounds(): Box3 | null {
    const box = new Box3();
    const toBase = new Matrix4()
      .multiplyMatrices(this.object.matrixWorld, this.basePart.pose)
      .invert();
    this.object.updateMatrixWorld(true);
    for (const mesh of this.visuals()) {
      mesh.geometry.computeBoundingBox();
      const { boundingBox } = mesh.geometry;
      if (boundingBox !== null) {
        const inBase = new Matrix4().multiplyMatrices(toBase, mesh.matrixWorld);
        box.union(boundingBox.clone().applyMatrix4(inBase));
      }
    }
    return box.isEmpty() ? null : box;
  }

  /** How far each link is from its parent, m. */
  get linkLengths(): number[] {
    return this.parts.flatMap(({ joint }) => (joint === null ? [] : [joint.position.length()]));
  }

  /** The radius of a wheel about its joint's axis, m; 0 if nothing of it is drawn. */
  wheelRadius(joint: string): number {
    const wheel = this.object.joints[joint];
    return wheel === undefined ? 0 : radiusAbout(wheel);
  }

  /** The link that a mesh is of; null for none of this robot's. */
  linkOf(object: Object3D): string | null {
    for (let each: Object3D | null = object; each !== null; each = each.parent) {
      if (this.object.links[each.name] === each) {
        return each.name;
      }
    }
    return null;
  }

  visuals(): Mesh[] {
    return meshesOf(this.object, true);
  }

  /** Why none of its visuals is there; null: one is, or nothing has failed. */
  get whyBare(): readonly string[] | null {
    return this.problems.size > 0 && this.visuals().length === 0 ? [...this.problems] : null;
  }

  showCollisions(shown: boolean): void {
    this.areCollisionsShown = shown;
    this.revealColliders();
  }

  /** Those of the chosen link are shown, whatever else is. */
  private revealColliders(): void {
    for (const each of this.colliders) {
      each.visible = this.areCollisionsShown || this.linkOf(each) === this.chosen;
    }
  }

  /** Light up a link; null: none. */
  choose(link: string | null, colour: string): void {
    this.chosen = link;
    const object = link === null ? undefined : this.object.links[link];
    this.highlight.set(object ? meshesOf(object, false) : [], colour);
    this.revealColliders();
  }

  setPalette(palette: Palette): void {
    this.edges.color.set(palette.partEdge);
    this.edges.opacity = palette.partEdgeOpacity;
    this.choose(this.chosen, palette.highlight);
  }

  dispose(): void {
    this.highlight.clear();
    this.object.removeFromParent();
    disposeTree(this.object);
    this.edges.dispose();
    this.collider.dispose();
  }

  private load(): URDFRobot {
    const { meshes: files, urdf } = this.model;
    const manager = managerOf(files);
    const loader = new URDFLoader(manager);
    loader.packages = (name) => `package://${name}`; // as in the URDF: so are the names of files
    loader.parseCollision = true;
    manager.onLoad = () => this.events.changed(); // textures come after their meshes
    manager.onError = (name) => this.report(`'${name}' could not be loaded`);
    loader.loadMeshCb = (name, _manager, material, done) => {
      correct(material);
      loadMesh(name, files, manager, material).then(
        (mesh) => {
          done(mesh);
          this.dress();
          this.events.changed();
        },
        (error: unknown) => this.report(String(error instanceof Error ? error.message : error)),
      );
    };
    const xml = readUrdf(urdf, files, (name) =>
      this.report(`the texture '${name}' was not found`),
    );
    try {
      const robot = loader.parse(xml);
      for (const joint of Object.values(robot.joints)) {
        joint.ignoreLimits = true; // what is, is drawn
      }
      // Now all know their origins, and mimic joints, led by the others, have their offsets.
      const leaders = Object.values(robot.joints).filter((joint) => !isMimicJoint(joint));
      leaders.forEach((joint) => joint.setJointValue(0));
      return robot;
    } catch (error) {
      throw new BadModel(`the robot '${this.model.robot}' cannot be drawn: ${String(error)}`);
    }
  }

  /** Tell of a problem once: a visual and a collision often have the same mesh. */
  private report(text: string): void {
    if (!this.problems.has(text)) {
      this.problems.add(text);
      this.events.problem(text);
    }
  }

  private listParts(link: Object3D, parent: number, joint: URDFJoint | null): void {
    const index = this.parts.push({ name: link.name, parent, joint, pose: new Matrix4() }) - 1;
    for (const below of link.children.filter((child) => child.name in this.object.joints)) {
      const child = below.children.find((each) => each.name in this.object.links);
      if (child !== undefined) {
        this.listParts(child, index, below as URDFJoint);
      }
    }
  }

  /** Give what has come since the last time its looks. */
  private dress(): void {
    this.object.traverse((each) => {
      if ('isURDFCollider' in each && !this.colliders.includes(each)) {
        each.visible = false;
        this.colliders.push(each);
      }
    });
    for (const collider of this.colliders) {
      collider.traverse((each) => each instanceof Mesh && (each.material = this.collider));
    }
    for (const mesh of this.visuals().filter((each) => !each.castShadow)) {
      mesh.castShadow = true;
      mesh.receiveShadow = this.isShaded;
      if (isPrimitive(mesh)) {
        [mesh.material].flat().forEach(correct);
        addEdges(mesh, this.edges);
      }
    }
  }
}

/** Correct a material that the loader has made of the URDF's, once: visuals share it. */
function correct(material: Material): void {
  if (material instanceof MeshPhongMaterial && !material.userData.isCorrect) {
    material.userData.isCorrect = true;
    correctColour(material);
  }
}

function isMimicJoint(joint: URDFJoint): joint is URDFMimicJoint {
  return 'mimicJoint' in joint;
}
