// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What is drawn, when and how finely: only what changed, and no finer than the machine can. */
import { Camera, PCFShadowMap, Scene as ThreeScene, WebGLRenderer } from 'three';

const FINEST = 2; // pixels to a CSS pixel
const SLOW = 45; // ms of waiting for a frame, on average, from which on pixels get fewer
const COARSEST = 0.6;
const MEMORY = 0.9; // of the average
const LOOK_AGAIN = 8; // ms until it is looked again whether the frame before is done

export class Painter {
  readonly renderer: WebGLRenderer;
  /** How many frames have been drawn. */
  frames = 0;
  triangles = 0;
  private ratio: number;
  private request = 0;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private fence: WebGLSync | null = null; // behind the commands of the last frame
  private isDirty = false;
  private last = 0; // ms, of the last frame
  private asked = 0; // ms, when the next frame was asked for
  private wait = 0; // ms, how long a frame is waited for, on average

  /**
   * `step` is called before each frame with the s since the last one, draws with
   * {@link paint}, and returns whether there is to be another frame at once.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly isSoftware: boolean,
    private readonly step: (dt: number) => boolean,
    private readonly resized: (width: number, height: number, ratio: number) => void,
  ) {
    this.ratio = isSoftware ? 1 : FINEST;
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSoftware, alpha: false });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    canvas.addEventListener('webglcontextlost', this.forget);
    canvas.addEventListener('webglcontextrestored', this.dirty);
  }

  /** Ask for a frame. */
  readonly dirty = (): void => {
    this.isDirty = true;
    if (this.request === 0 && this.timer === null) {
      this.asked = performance.now();
      this.request = requestAnimationFrame(this.onFrame);
    }
  };

  /** Take the size of the canvas on the page. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(devicePixelRatio || 1, this.ratio);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.resized(width, height, Math.min(devicePixelRatio || 1, FINEST));
    this.dirty();
  }

  /** Draw a scene, and over it another one, seen through everything. */
  paint(scene: ThreeScene, overlay: ThreeScene, camera: Camera): void {
    const { renderer } = this;
    renderer.info.reset();
    renderer.clear();
    renderer.render(scene, camera);
    renderer.clearDepth();
    renderer.render(overlay, camera);
    this.triangles = renderer.info.render.triangles;
    this.frames++;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    clearTimeout(this.timer ?? undefined);
    this.canvas.removeEventListener('webglcontextlost', this.forget);
    this.canvas.removeEventListener('webglcontextrestored', this.dirty);
    this.renderer.dispose();
  }

  private readonly onFrame = (now: number): void => {
    this.request = 0;
    if (this.isBusy()) {
      this.timer = setTimeout(() => {
        this.timer = null;
        this.request = requestAnimationFrame(this.onFrame);
      }, LOOK_AGAIN);
      return;
    }
    const gap = this.last === 0 ? 0 : now - this.last;
    const wait = performance.now() - this.asked;
    this.last = now;
    this.isDirty = false;
    if (this.renderer.getContext().isContextLost()) {
      return;
    }
    if (this.step(Math.min(gap, 100) / 1000) || this.isDirty) {
      this.dirty();
    }
    this.adapt(wait);
  };

  /** A fence of a lost context is never passed. */
  private readonly forget = (): void => {
    this.fence = null;
  };

  private get gl(): WebGL2RenderingContext {
    return this.renderer.getContext() as WebGL2RenderingContext;
  }

  /**
   * Whether the frame before is still being drawn. Frames that queue up block the whole page: it
   * would hear of a released key, and tell the node that somebody drives, up to a second late.
   */
  private isBusy(): boolean {
    const { gl, fence } = this;
    if (fence === null) {
      return false;
    }
    if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
      return true;
    }
    gl.deleteSync(fence);
    this.fence = null;
    return false;
  }

  /**
   * Draw fewer pixels where the browser cannot follow, and stay with that. States may come as
   * seldom as they like: only how long a frame is waited for counts.
   */
  private adapt(wait: number): void {
    this.wait = MEMORY * this.wait + (1 - MEMORY) * Math.min(wait, 4 * SLOW);
    const least = this.isSoftware ? COARSEST : 1;
    if (this.wait > SLOW && this.ratio > least) {
      this.ratio = Math.max(least, Math.min(this.ratio, devicePixelRatio || 1) * 0.85);
      this.wait = 0;
      this.resize();
    }
  }
}
