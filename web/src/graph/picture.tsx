// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A drawing of boxes and arrows that is moved and zoomed with pointer, wheel and keys. */
// Keys move it, and there is no element for a drawing whose parts are chosen.
/* oxlint-disable jsx-a11y/no-noninteractive-element-interactions, jsx-a11y/prefer-tag-over-role */
import { useSignal } from '@preact/signals';
import { useLayoutEffect, useMemo, useRef } from 'preact/hooks';
import { Button } from '../ui';
import { fitted, type Box, type Placed } from './layered';

export interface GraphBox {
  id: string;
  lines: readonly string[]; // the first is its name
  kind: 'node' | 'topic' | 'frame';
  tone?: 'warning' | 'error' | 'calm';
}

export interface GraphEdge {
  from: string;
  to: string;
  tone?: 'error' | 'static';
}

interface PictureProps {
  label: string; // what it is, for a screen reader
  boxes: readonly GraphBox[];
  edges: readonly GraphEdge[];
  chosen?: string | null;
  onChoose?: (id: string) => void;
}

interface Cut {
  x: number;
  y: number;
  width: number;
}

const LETTER = 6.7; // px of width, at 11 px
const LINE = 15;
const PADDING = 10;
const MARGIN = 8;
const ZOOM = 1.25;
const STEP = 0.15; // of the width, by an arrow key
const SHAPE = 0.9; // height of the frame by its width, in the column
const LARGEST = 1.5; // of the usual letters
const FOOT = 30; // px at the lower edge of the frame, for its buttons
const DOT = 3; // px that a pointer may move in a click

export function Picture({ label, boxes, edges, chosen = null, onChoose }: PictureProps) {
  // Ages change twice a second, and what they are drawn in does not.
  const shape = JSON.stringify({
    boxes: boxes.map(({ id, lines }) => ({
      id,
      width: LETTER * longest(lines) + 2 * PADDING,
      height: LINE * lines.length + PADDING,
    })),
    edges: edges.map(({ from, to }) => [from, to]),
  });
  const frame = useRef<HTMLDivElement>(null);
  const room = useRoom(frame);
  const high = room.height / room.width;
  const drawing = useMemo(() => draw(shape, high), [shape, high]);
  const places = new Map(drawing.boxes.map((box) => [box.id, box]));
  const width = Math.max(drawing.width + 2 * MARGIN, (drawing.height + 2 * MARGIN) / high, room.width / LARGEST);
  const whole = {
    x: (drawing.width - width) / 2,
    y: (drawing.height - high * width) / 2,
    width,
  };
  const moved = useSignal<Cut | null>(null);
  const cut = moved.value ?? whole;
  const zoom = (by: number): void => {
    const size = Math.min(Math.max(cut.width / by, 60), 4 * whole.width);
    const lost = cut.width - size;
    moved.value = { x: cut.x + lost / 2, y: cut.y + (high * lost) / 2, width: size };
  };
  const move = (x: number, y: number): void => {
    moved.value = { ...cut, x: cut.x + x * cut.width, y: cut.y + y * cut.width };
  };
  const keys: Record<string, () => void> = {
    '+': () => zoom(ZOOM),
    '=': () => zoom(ZOOM),
    '-': () => zoom(1 / ZOOM),
    '0': () => void (moved.value = null),
    ArrowLeft: () => move(-STEP, 0),
    ArrowRight: () => move(STEP, 0),
    ArrowUp: () => move(0, -STEP),
    ArrowDown: () => move(0, STEP),
  };
  const held = useRef<{ x: number; y: number; cut: Cut; far: boolean } | null>(null);
  return (
    <div
      ref={frame}
      class="graph"
      role="group"
      tabIndex={0}
      aria-label={`${label}: arrow keys move it, + and - zoom, 0 shows all`}
      onKeyDown={(event) => {
        const act = event.ctrlKey || event.altKey || event.metaKey ? undefined : keys[event.key];
        if (act !== undefined) {
          event.preventDefault();
          event.stopPropagation(); // arrow keys drive elsewhere
          act();
        }
      }}
    >
      <svg
        viewBox={`${cut.x} ${cut.y} ${cut.width} ${high * cut.width}`}
        role="img"
        aria-label={`${label}: ${boxes.map(({ lines }) => lines[0]).join(', ')}`}
        onWheel={(event) => {
          event.preventDefault();
          zoom(event.deltaY < 0 ? ZOOM : 1 / ZOOM);
        }}
        onPointerDown={(event) => {
          held.current = { x: event.clientX, y: event.clientY, cut, far: false };
        }}
        onPointerMove={(event) => {
          const start = held.current;
          if (start === null) {
            return;
          }
          const [right, down] = [event.clientX - start.x, event.clientY - start.y];
          if (!start.far && Math.hypot(right, down) < DOT) {
            return;
          }
          if (!start.far) {
            start.far = true;
            event.currentTarget.setPointerCapture(event.pointerId);
          }
          const scale = start.cut.width / event.currentTarget.clientWidth;
          moved.value = { ...start.cut, x: start.cut.x - right * scale, y: start.cut.y - down * scale };
        }}
        onPointerUp={(event) => {
          const id = (event.target as Element).closest('[data-id]')?.getAttribute('data-id');
          if (held.current?.far === false && id !== null && id !== undefined) {
            onChoose?.(id);
          }
          held.current = null;
        }}
        onPointerCancel={() => (held.current = null)}
      >
        {edges.map(({ from, to, tone }) => {
          const [start, end] = [places.get(from), places.get(to)];
          const near = chosen === null || from === chosen || to === chosen;
          return start === undefined || end === undefined ? null : (
            <path
              key={`${from} ${to}`}
              class={near ? 'edge' : 'edge far'}
              data-tone={tone}
              d={drawing.isUpright ? curveDown(start, end) : curve(start, end)}
            />
          );
        })}
        {boxes.map((box) => (
          <BoxShape key={box.id} box={box} place={places.get(box.id)} chosen={box.id === chosen} />
        ))}
      </svg>
      <div class="graph-tools">
        <Button text="+" title="Larger" kind="quiet" onClick={() => zoom(ZOOM)} />
        <Button text="−" title="Smaller" kind="quiet" onClick={() => zoom(1 / ZOOM)} />
        <Button text="All" title="Show all of it" kind="quiet" onClick={() => (moved.value = null)} />
      </div>
    </div>
  );
}

function BoxShape({ box, place, chosen }: { box: GraphBox; place: Placed | undefined; chosen: boolean }) {
  if (place === undefined) {
    return null;
  }
  const { x, y, width, height } = place;
  return (
    <g class={`box ${box.kind}${chosen ? ' chosen' : ''}`} data-id={box.id} data-tone={box.tone}>
      <rect x={x} y={y} width={width} height={height} rx={box.kind === 'topic' ? 2 : height / 2} />
      {box.lines.map((line, index) => (
        <text
          key={line}
          class={index === 0 ? undefined : 'second'}
          x={x + width / 2}
          y={y + PADDING / 2 + LINE * (index + 0.72)}
        >
          {line}
        </text>
      ))}
    </g>
  );
}

/** From the right side of one box to the left side of another, with a head. */
function curve(start: Placed, end: Placed): string {
  const [x0, y0] = [start.x + start.width, start.y + start.height / 2];
  const [x1, y1] = [end.x, end.y + end.height / 2];
  const bend = Math.max(24, Math.abs(x1 - x0) / 2);
  const head = `M${x1 - 6} ${y1 - 3.5}L${x1} ${y1}L${x1 - 6} ${y1 + 3.5}`;
  return `M${x0} ${y0}C${x0 + bend} ${y0} ${x1 - bend} ${y1} ${x1} ${y1}${head}`;
}

/** … from the lower side of one to the upper side of another. */
function curveDown(start: Placed, end: Placed): string {
  const [x0, y0] = [start.x + start.width / 2, start.y + start.height];
  const [x1, y1] = [end.x + end.width / 2, end.y];
  const bend = Math.max(16, Math.abs(y1 - y0) / 2);
  const head = `M${x1 - 3.5} ${y1 - 6}L${x1} ${y1}L${x1 + 3.5} ${y1 - 6}`;
  return `M${x0} ${y0}C${x0} ${y0 + bend} ${x1} ${y1 - bend} ${x1} ${y1}${head}`;
}

/** The size of the frame, which follows that of its panel. */
function useRoom(frame: { current: HTMLElement | null }): { width: number; height: number } {
  const room = useSignal({ width: 1, height: SHAPE });
  useLayoutEffect(() => {
    const measure = (): void => {
      const { clientWidth: width = 0, clientHeight: height = 0 } = frame.current ?? {};
      if (width > 0 && height > FOOT) {
        room.value = { width, height: height - FOOT };
      }
    };
    const sizes = new ResizeObserver(measure);
    if (frame.current !== null) {
      sizes.observe(frame.current);
    }
    measure();
    return () => sizes.disconnect();
  }, [frame, room]);
  return room.value;
}

function draw(shape: string, high: number): ReturnType<typeof fitted> {
  const { boxes, edges } = JSON.parse(shape) as { boxes: Box[]; edges: [string, string][] };
  return fitted(boxes, edges, high);
}

function longest(lines: readonly string[]): number {
  return Math.max(...lines.map((line) => line.length));
}
