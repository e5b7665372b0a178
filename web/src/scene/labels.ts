// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Names in the scene, written over it in a canvas of their own: sharp, never in the way. */
import { Vector3 } from 'three';
import type { Camera } from 'three';
import { placeLabels, type Anchor, type Box } from './label_places';
import type { Palette } from './theme';

export interface Label {
  key: string;
  text: string;
  at: Vector3; // m, in the frame of the scene
  isStrong: boolean;
  colour?: string; // a robot's, that its name is written on
}

const FONT = '500 11.5px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
const HEIGHT = 18; // CSS pixels
const PADDING = 6;
const FINEST = 2; // pixels to a CSS pixel

export class Labels {
  private readonly canvas = document.createElement('canvas');
  private readonly pen: CanvasRenderingContext2D | null;
  private readonly widths = new Map<string, number>();
  private readonly habits = new Map<string, number>();
  private readonly point = new Vector3();
  private isBlank = true;

  /** Lie over another canvas. */
  constructor(private readonly below: HTMLCanvasElement) {
    this.canvas.setAttribute('aria-hidden', 'true');
    Object.assign(this.canvas.style, { position: 'absolute', pointerEvents: 'none' });
    this.pen = this.canvas.getContext('2d');
    below.after(this.canvas);
  }

  /** Take the size of the canvas below. */
  resize(): void {
    const ratio = Math.min(devicePixelRatio || 1, FINEST);
    const { offsetLeft, offsetTop, clientWidth, clientHeight } = this.below;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    Object.assign(this.canvas.style, {
      left: `${offsetLeft}px`,
      top: `${offsetTop}px`,
      width: `${clientWidth}px`,
      height: `${clientHeight}px`,
    });
    this.pen?.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.isBlank = true;
  }

  /** Write labels, the nearest first. */
  draw(labels: readonly Label[], camera: Camera, palette: Palette): void {
    const { pen } = this;
    const { clientWidth: width, clientHeight: height } = this.below;
    if (pen === null || (this.isBlank && labels.length === 0)) {
      return;
    }
    pen.clearRect(0, 0, width, height);
    pen.font = FONT;
    pen.textBaseline = 'middle';
    const anchors = this.anchorsOf(labels, camera, width, height);
    const points = new Map(anchors.map((anchor) => [anchor.key, anchor]));
    const byKey = new Map(labels.map((label) => [label.key, label]));
    for (const { key, left, top } of placeLabels(anchors, width, height, this.habits, this.blocked)) {
      const anchor = points.get(key) as Anchor;
      const { text, isStrong, colour } = byKey.get(key) as Label;
      pen.fillStyle = colour ?? palette.labelBack;
      pen.strokeStyle = colour ?? palette.tree;
      this.drawLeader(pen, anchor, left, top);
      pen.beginPath();
      pen.roundRect(left, top, anchor.width, HEIGHT, HEIGHT / 2);
      pen.fill();
      if (colour !== undefined && isStrong) {
        pen.lineWidth = 2;
        pen.strokeStyle = palette.label;
        pen.stroke();
      }
      const plain = isStrong ? palette.labelFixed : palette.label;
      pen.fillStyle = colour === undefined ? plain : palette.robotText;
      pen.fillText(text, left + PADDING, top + HEIGHT / 2 + 0.5);
    }
    this.isBlank = labels.length === 0;
  }

  /** Where the buttons over the picture are. */
  private get blocked(): Box[] {
    const tools = this.below.parentElement?.querySelector<HTMLElement>('.view-tools') ?? null;
    if (tools === null) {
      return [];
    }
    const { offsetLeft: left, offsetTop: top, offsetWidth, offsetHeight } = tools;
    return [{ left, top, right: left + offsetWidth, bottom: top + offsetHeight }];
  }

  private anchorsOf(
    labels: readonly Label[], camera: Camera, width: number, height: number,
  ): Anchor[] {
    const seen = labels.map(({ key, text, at, isStrong, colour }) => {
      const { x, y, z } = this.point.copy(at).project(camera);
      const isAbove = colour !== undefined;
      return { key, text, isStrong, isAbove, x: ((x + 1) / 2) * width, y: ((1 - y) / 2) * height, z };
    });
    return seen
      .filter(({ x, y, z }) => z < 1 && x >= 0 && x <= width && y >= 0 && y <= height)
      .sort((a, b) => Number(b.isStrong) - Number(a.isStrong) || a.z - b.z)
      .map(({ key, text, x, y, isAbove }) => {
        return { key, x, y, width: this.widthOf(text), height: HEIGHT, isAbove };
      });
  }

  private widthOf(text: string): number {
    let width = this.widths.get(text);
    if (width === undefined) {
      width = Math.ceil(this.pen?.measureText(text).width ?? 0) + 2 * PADDING;
      this.widths.set(text, width);
    }
    return width;
  }

  /** A line from a label to its point, where they are not next to one another. */
  private drawLeader(
    pen: CanvasRenderingContext2D, { x, y, width }: Anchor, left: number, top: number,
  ): void {
    const toX = Math.min(Math.max(x, left), left + width);
    const toY = Math.min(Math.max(y, top), top + HEIGHT);
    pen.globalAlpha = 0.8;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(toX, toY);
    pen.stroke();
    pen.globalAlpha = 1;
  }
}
