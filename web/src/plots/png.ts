// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Plots as one image, with their titles and the names of their lines. */
import { colour } from '../theme';
import type { Chart } from './chart';
import type { ChartLines } from './lines';

const WIDTH = 800; // px, all
const HEIGHT = 190;
const HEAD = 26; // above each plot
const MARGIN = 14;

/** One below the other. */
export async function toPng(charts: readonly Chart[]): Promise<Blob | null> {
  const scale = window.devicePixelRatio;
  const image = document.createElement('canvas');
  const context = image.getContext('2d');
  if (context === null) {
    return null;
  }
  image.width = (WIDTH + 2 * MARGIN) * scale;
  image.height = (charts.length * (HEAD + HEIGHT) + 2 * MARGIN) * scale;
  context.fillStyle = colour('surface');
  context.fillRect(0, 0, image.width, image.height);
  for (const [index, chart] of charts.entries()) {
    const top = (MARGIN + index * (HEAD + HEIGHT)) * scale;
    drawHead(context, chart.lines, MARGIN * scale, top + 16 * scale, scale);
    await chart.picture(WIDTH, HEIGHT, (canvas) => {
      context.drawImage(canvas, MARGIN * scale, top + HEAD * scale);
    });
  }
  return new Promise((resolve) => image.toBlob(resolve, 'image/png'));
}

function drawHead(
  context: CanvasRenderingContext2D,
  { title, unit, lines }: ChartLines,
  left: number,
  base: number,
  scale: number,
): void {
  const write = (text: string, fill: string, weight: number): void => {
    context.font = `${weight} ${12 * scale}px system-ui, sans-serif`;
    context.fillStyle = fill;
    context.fillText(text, left, base);
    left += context.measureText(text).width + 12 * scale;
  };
  write(unit === '' ? title : `${title}, ${unit}`, colour('text'), 600);
  for (const line of lines) {
    write(line.name, colour(line.colour), 500);
  }
}
