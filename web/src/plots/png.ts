// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Plots as one image, with their titles and the names of their lines. */
import { colour } from '../theme';
import type { Chart } from './chart';

const HEAD = 26; // px above each plot
const MARGIN = 12; // px

/** One below the other; null when none is drawn. */
export async function toPng(charts: readonly Chart[]): Promise<Blob | null> {
  const drawn = charts.flatMap((chart) =>
    chart.canvas === null ? [] : [{ chart, canvas: chart.canvas }],
  );
  const scale = window.devicePixelRatio;
  const image = document.createElement('canvas');
  const context = image.getContext('2d');
  if (drawn.length === 0 || context === null) {
    return null;
  }
  const heights = drawn.map(({ canvas }) => canvas.height + HEAD * scale);
  image.width = Math.max(...drawn.map(({ canvas }) => canvas.width)) + 2 * MARGIN * scale;
  image.height = heights.reduce((sum, one) => sum + one, 2 * MARGIN * scale);
  context.fillStyle = colour('surface');
  context.fillRect(0, 0, image.width, image.height);
  let top = MARGIN * scale;
  drawn.forEach(({ chart, canvas }, index) => {
    drawHead(context, chart, MARGIN * scale, top + 16 * scale, scale);
    context.drawImage(canvas, MARGIN * scale, top + HEAD * scale);
    top += heights[index];
  });
  return new Promise((resolve) => image.toBlob(resolve, 'image/png'));
}

function drawHead(
  context: CanvasRenderingContext2D,
  { title, unit, series }: Chart,
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
  write(`${title}, ${unit}`, colour('text'), 600);
  for (const line of series) {
    write(line.name, colour(line.colour), 500);
  }
}
