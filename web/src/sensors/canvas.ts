// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A canvas with the latest picture of a camera: one is decoded at a time, the newest waits. */
import type { Picture } from '../protocol';
import type { Sample } from '../samples';

export class PictureCanvas {
  /** How many pictures were drawn, and how many could not be. */
  readonly counts = { drawn: 0, bad: 0 };
  private isBusy = false;
  private next: Sample<Picture> | null = null;
  private last: Sample<Picture> | null = null;

  /** `element`: hidden until there is a picture. */
  constructor(private readonly element: HTMLCanvasElement) {}

  /** Draw a picture, unless it is there already. */
  show(sample: Sample<Picture>): void {
    if (sample === this.last) {
      return;
    }
    this.last = this.next = sample;
    if (!this.isBusy) {
      void this.drawAll();
    }
  }

  private async drawAll(): Promise<void> {
    this.isBusy = true;
    while (this.next !== null) {
      const { head, bytes } = this.next;
      this.next = null;
      try {
        this.draw(await createImageBitmap(new Blob([bytes], { type: head.format })));
      } catch {
        this.counts.bad += 1; // a file that the browser cannot read; the one before stays
      }
    }
    this.isBusy = false;
  }

  private draw(bitmap: ImageBitmap): void {
    const { width, height } = bitmap;
    if (this.element.width !== width || this.element.height !== height) {
      this.element.width = width;
      this.element.height = height;
    }
    this.element.getContext('2d')?.drawImage(bitmap, 0, 0);
    this.element.hidden = false;
    this.counts.drawn += 1;
    bitmap.close();
  }
}
