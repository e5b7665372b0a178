// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * When is drawn, and how finely: only on a change, never faster than the machine can follow, and
 * with as many pixels as it can. Once the picture stands still, one frame more is drawn, as fine as
 * the screen, its edges smooth; after that none.
 *
 * No more than one frame is on its way to the screen: a second one would have to wait, and with it
 * all else that the page does, keys for driving among them.
 */
import { BasicShadowMap, PCFShadowMap, WebGLRenderer } from 'three';
import type { Camera, Scene as ThreeScene } from 'three';

const FINEST = { hardware: 2, software: 1 }; // pixels to a CSS pixel
const COARSEST = { hardware: 0.75, software: 0.5 };
const SLOW = 50; // ms for a frame, on average, from which on pixels get fewer
const FAST = 20; // … down to which they get more again
const STEP = 0.85; // fewer pixels to a CSS pixel, at a time
const PATIENCE = 20; // frames between two changes
const MEMORY = 0.85; // of the average
const LONGEST = 500; // ms, the most that one frame counts for
// ms between two frames where the processor draws, whose time the robot may need: 30 a second. The
// screen comes every 16.7 ms, give or take.
const LEAST_GAP = 30;
// ms without a frame, after which the picture stands still; and those in which what waited behind a
// busy page may yet ask for one.
const STILL = 110;
const DOUBT = 40;
// Of a still picture, where the processor draws without smoothing: pixels that the browser makes
// one of, a side; as far as there are not more than MOST_PIXELS of them.
const SMOOTHING = 2;
const MOST_PIXELS = 4e6;

export class Painter {
  readonly renderer: WebGLRenderer;
  /** How many frames have been drawn. */
  frames = 0;
  triangles = 0;
  private ratio: number; // pixels to a CSS pixel, at most
  private readonly range: { finest: number; coarsest: number };
  private readonly leastGap: number; // ms from the begin of a frame to that of the next
  private request = 0;
  private isDirty = false;
  private last = 0; // ms, when the last frame was begun
  private fence: WebGLSync | null = null; // passed when the last frame is done
  private isFine = false; // that one was of a still picture
  private cost = 0; // ms for a frame, on average
  private changedAt = 0; // number of the frame
  private sized = 0; // pixels to a CSS pixel that the canvas has
  private stillness: ReturnType<typeof setTimeout> | undefined;

  /**
   * `step` is called for each frame with the s since the last one, draws it by {@link paint}, and
   * returns whether there is to be another one at once.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly isSoftware: boolean,
    private readonly step: (dt: number) => boolean,
    private readonly resized: (width: number, height: number) => void,
  ) {
    const kind = isSoftware ? 'software' : 'hardware';
    this.range = { finest: FINEST[kind], coarsest: COARSEST[kind] };
    this.leastGap = isSoftware ? LEAST_GAP : 0;
    this.ratio = this.range.finest;
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSoftware, alpha: false });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = isSoftware ? BasicShadowMap : PCFShadowMap;
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    canvas.addEventListener('webglcontextrestored', this.onRestored);
  }

  /** Ask for a frame. */
  readonly dirty = (): void => {
    this.isDirty = true;
    clearTimeout(this.stillness);
    this.ask();
  };

  /** Take the size of the canvas on the page. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.sized = 0; // with the next frame: a canvas of a new size is blank
    this.resized(width, height);
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
  }

  private get gl(): WebGL2RenderingContext {
    return this.renderer.getContext() as WebGL2RenderingContext;
  }

  private ask(): void {
    if (this.request === 0) {
      this.request = requestAnimationFrame(this.onFrame);
    }
  }

  private readonly onRestored = (): void => {
    this.fence = null;
    this.dirty();
  };

  private readonly onFrame = (now: number): void => {
    this.request = 0;
    if (this.gl.isContextLost()) {
      return; // the next frame comes when it is back
    }
    if (this.isBusy() || (this.isDirty && now - this.last < this.leastGap)) {
      this.ask();
    } else if (this.isDirty) {
      this.draw(now);
    }
  };

  private draw(now: number): void {
    const gap = now - this.last;
    this.last = now;
    this.isDirty = false;
    this.size(Math.min(this.screen, this.ratio));
    this.isDirty = this.step(Math.min(gap, 100) / 1000) || this.isDirty;
    this.mark();
    this.isFine = false;
    this.ask(); // to see when it is done
    clearTimeout(this.stillness);
    this.stillness = setTimeout(this.onQuiet, STILL);
  }

  private readonly onQuiet = (): void => {
    this.stillness = setTimeout(this.onStill, DOUBT);
  };

  /** Find out later when all that was asked of the card so far is done. */
  private mark(): void {
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }

  /** Draw a last frame, as fine as can be seen. */
  private readonly onStill = (): void => {
    const { sized, stillRatio } = this;
    if (this.fence !== null || this.gl.isContextLost()) {
      this.stillness = setTimeout(this.onStill, STILL); // the last one is still on its way
    } else if (stillRatio > sized) {
      this.size(stillRatio);
      this.step(0);
      this.mark();
      this.isFine = true;
    }
  };

  /** Pixels to a CSS pixel of the frame that is drawn. */
  get pixels(): number {
    return this.sized;
  }

  /** Pixels to a CSS pixel of the screen. */
  private get screen(): number {
    return devicePixelRatio || 1;
  }

  /** … of a still picture. */
  private get stillRatio(): number {
    if (!this.isSoftware) {
      return Math.min(this.screen, this.range.finest);
    }
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const most = Math.sqrt(MOST_PIXELS / Math.max(1, width * height));
    return Math.max(this.screen, Math.min(SMOOTHING * this.screen, most));
  }

  /** Have so many pixels to a CSS pixel; blank until the next frame. */
  private size(ratio: number): void {
    if (ratio !== this.sized) {
      this.sized = ratio;
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    }
  }

  /** Whether the last frame is still being drawn. */
  private isBusy(): boolean {
    const { fence, gl } = this;
    if (fence === null) {
      return false;
    }
    if (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED) {
      return true;
    }
    gl.deleteSync(fence);
    this.fence = null;
    if (!this.isFine) {
      this.adapt(performance.now() - this.last);
    }
    return false;
  }

  /** Draw fewer pixels where a frame takes long, and more again where it does not. */
  private adapt(cost: number): void {
    this.cost = MEMORY * this.cost + (1 - MEMORY) * Math.min(cost, LONGEST);
    if (this.frames - this.changedAt < PATIENCE) {
      return;
    }
    const { finest, coarsest } = this.range;
    const now = Math.min(this.ratio, this.screen);
    const wanted = this.cost > SLOW ? now * STEP : this.cost < FAST ? now / STEP : now;
    const ratio = Math.min(Math.max(wanted, coarsest), finest, this.screen);
    if (ratio !== now) {
      this.changedAt = this.frames;
      this.ratio = ratio; // of the next frame
    }
  }
}
