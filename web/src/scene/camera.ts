// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The camera: orbit by mouse, touch and keys, follow a robot, go back to where all is in view. */
import { Box3, Frustum, Matrix4, PerspectiveCamera, Sphere, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const FIELD_OF_VIEW = 40; // degrees, of the smaller side of the picture
const FROM = new Vector3(-0.78, -0.55, 0.5).normalize(); // behind, to the right and above
const BEHIND = new Vector3(-1, 0, 0.48).normalize(); // in the robot's own directions
const UP = new Vector3(0, 0, 1);
const MARGIN = 1.75; // how much wider the view is than what it is of
const FOLLOWING_MARGIN = 2.4;
const SMALLEST = 0.35; // m, the radius of the least that is framed
const POSITION_LAG = 0.1; // s, of the camera behind the robot it follows
const HEADING_LAG = 0.45;
const FURTHEST = 40; // m, to have a robot in view
const STEP = Math.PI / 24; // rad a key press

export class CameraRig {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 600);
  readonly controls: OrbitControls;
  /** Whether hands have moved it since it was last pointed at something. */
  isMoved = false;
  private isFollowing = false;
  private heading = 0; // rad, of the robot as the camera follows it
  private lift = 0; // m, from the robot's base up to what the camera looks at

  /** `changed` is called when the camera has moved, `goHome` when Home was pressed. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly changed: () => void,
    private readonly goHome: () => void,
  ) {
    this.camera.up.copy(UP);
    this.camera.position.copy(FROM).multiplyScalar(4);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, {
      enableDamping: true,
      dampingFactor: 0.16,
      minDistance: 0.15,
      maxDistance: 150,
      maxPolarAngle: Math.PI * 0.52,
      screenSpacePanning: false,
      zoomToCursor: false,
    });
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => (this.isMoved = true));
    canvas.addEventListener('keydown', this.onKey);
    this.controls.update();
  }

  /** What the camera looks at, m, in the frame of the scene. */
  get target(): Vector3 {
    return this.controls.target;
  }

  get distance(): number {
    return this.camera.position.distanceTo(this.target);
  }

  resize(aspect: number): void {
    this.camera.aspect = aspect;
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const vertical = aspect < 1 ? half / Math.max(aspect, 0.6) : half;
    this.camera.fov = (Math.atan(vertical) * 360) / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  /** Bring a box into view, from behind and above; an empty one: the origin. */
  frame(box: Box3, margin = MARGIN): void {
    const ball = new Sphere(new Vector3(), 1);
    if (!box.isEmpty()) {
      box.getBoundingSphere(ball);
    }
    const half = Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect);
    const distance = (margin * Math.max(ball.radius, SMALLEST)) / half;
    this.isMoved = false;
    this.target.copy(ball.center);
    this.camera.position.copy(ball.center).addScaledVector(FROM, distance);
    this.controls.update();
    this.changed();
  }

  /** Step back until all of a box is in view. */
  include(box: Box3): void {
    const ball = box.getBoundingSphere(new Sphere());
    const view = new Matrix4();
    const frustum = new Frustum();
    const isSeen = (): boolean => {
      this.camera.updateMatrixWorld();
      view.multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
      frustum.setFromProjectionMatrix(view);
      return frustum.planes.every((plane) => plane.distanceToPoint(ball.center) >= ball.radius);
    };
    while (!isSeen() && this.distance < FURTHEST) {
      const offset = this.camera.position.clone().sub(this.target).multiplyScalar(1.1);
      this.camera.position.copy(this.target).add(offset);
      this.camera.lookAt(this.target);
    }
    this.controls.update();
    this.changed();
  }

  /** Get behind a robot whose extent is `box`, and stay there. */
  startFollowing(pose: Matrix4, box: Box3): void {
    this.frame(box, FOLLOWING_MARGIN);
    const distance = this.distance;
    const base = new Vector3().setFromMatrixPosition(pose);
    this.lift = this.target.z - base.z;
    this.heading = headingOf(pose);
    this.target.setX(base.x).setY(base.y);
    this.camera.position
      .copy(BEHIND)
      .applyAxisAngle(UP, this.heading)
      .multiplyScalar(distance)
      .add(this.target);
    this.isFollowing = true;
    this.controls.enablePan = false; // it would be pulled back
    this.controls.update();
  }

  /** Look straight down at the same point, from as far as now; ahead is up. */
  lookDown(): void {
    const { distance } = this;
    const ahead = new Vector3(-1e-3, 0, 1).applyAxisAngle(UP, this.isFollowing ? this.heading : 0);
    this.isMoved = true;
    this.camera.position.copy(this.target).addScaledVector(ahead, distance);
    this.controls.update();
    this.changed();
  }

  stopFollowing(): void {
    this.isFollowing = false;
    this.controls.enablePan = true;
  }

  /**
   * Go on by `dt` s, after a robot in `pose` where one is followed. Hands may still turn the view.
   * Returns whether the camera moved.
   */
  update(dt: number, pose: Matrix4 | null): boolean {
    const moved = this.isFollowing && pose !== null && this.follow(pose, dt);
    return this.controls.update(dt) || moved;
  }

  private follow(pose: Matrix4, dt: number): boolean {
    const wanted = new Vector3().setFromMatrixPosition(pose);
    wanted.z += this.lift;
    const shift = wanted.sub(this.target).multiplyScalar(1 - Math.exp(-dt / POSITION_LAG));
    const heading = headingOf(pose);
    const turn = wrapped(heading - this.heading) * (1 - Math.exp(-dt / HEADING_LAG));
    this.heading = wrapped(this.heading + turn);
    const offset = this.camera.position.clone().sub(this.target).applyAxisAngle(UP, turn);
    this.target.add(shift);
    this.camera.position.copy(this.target).add(offset);
    return shift.lengthSq() > 1e-10 || Math.abs(turn) > 1e-5;
  }

  /** With the picture in focus: Shift and arrows turn, + and - zoom, Home goes back. */
  private readonly onKey = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return; // the browser's own: Ctrl and + zoom the page
    }
    const offset = this.camera.position.clone().sub(this.target);
    const elevation = Math.asin(offset.z / offset.length());
    const side = new Vector3().crossVectors(UP, offset).normalize();
    const key = (event.shiftKey && event.key.startsWith('Arrow') ? 'Shift' : '') + event.key;
    switch (key) {
      case 'ShiftArrowLeft':
        offset.applyAxisAngle(UP, -STEP);
        break;
      case 'ShiftArrowRight':
        offset.applyAxisAngle(UP, STEP);
        break;
      case 'ShiftArrowUp':
        offset.applyAxisAngle(side, -Math.min(STEP, 1.55 - elevation));
        break;
      case 'ShiftArrowDown':
        offset.applyAxisAngle(side, Math.min(STEP, Math.max(0, elevation)));
        break;
      case '+':
      case '=':
        offset.multiplyScalar(1 / 1.15);
        break;
      case '-':
        offset.multiplyScalar(1.15);
        break;
      case 'Home':
        event.preventDefault();
        this.goHome();
        return;
      default:
        return;
    }
    event.preventDefault();
    event.stopPropagation(); // it is not for driving
    this.isMoved = true;
    this.camera.position.copy(this.target).add(offset);
    this.controls.update();
    this.changed();
  };
}

/** The direction of a pose's x axis about z, rad. */
function headingOf({ elements }: Matrix4): number {
  return Math.atan2(elements[1], elements[0]);
}

/** The same angle within -pi..pi. */
function wrapped(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}
