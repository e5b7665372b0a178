// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * A directed graph in columns, from left to right, as rqt_graph draws it: each box is right of those
 * that lead to it (but for loops), and near them. A graph of a robot has some hundred boxes at most,
 * so that this needs no library.
 */

export interface Box {
  id: string;
  width: number;
  height: number;
}

export interface Placed extends Box {
  x: number; // of its left upper corner
  y: number;
}

export interface Drawing {
  boxes: Placed[];
  width: number;
  height: number;
}

const COLUMN_GAP = 40;
const ROW_GAP = 12;
const SWEEPS = 6;

/** From left to right, or from top to bottom, whichever is larger where a picture has this shape. */
export function fitted(
  boxes: readonly Box[],
  edges: readonly (readonly [string, string])[],
  shape: number, // height by width
): Drawing & { isUpright: boolean } {
  const across = layered(boxes, edges);
  const turned = layered(boxes.map(turn), edges);
  const upright = { ...turn(turned), boxes: turned.boxes.map((box) => ({ ...turn(box), x: box.y, y: box.x })) };
  const sizeOf = ({ width, height }: Drawing): number => Math.max(width, height / shape);
  return sizeOf(upright) < sizeOf(across)
    ? { ...upright, isUpright: true }
    : { ...across, isUpright: false };
}

function turn<T extends { width: number; height: number }>(one: T): T {
  return { ...one, width: one.height, height: one.width };
}

export function layered(boxes: readonly Box[], edges: readonly (readonly [string, string])[]): Drawing {
  const known = new Map(boxes.map((box) => [box.id, box]));
  const links = edges.filter(([from, to]) => from !== to && known.has(from) && known.has(to));
  const forward = withoutLoops(boxes, links);
  const columns = ordered(columnsOf(boxes, forward), forward);
  return place(columns.map((column) => column.map((id) => known.get(id) as Box)));
}

/** The edges without those that close a loop, as a search from the first box on finds them. */
function withoutLoops(boxes: readonly Box[], edges: readonly (readonly [string, string])[]) {
  const from = groups(edges, 0);
  const state = new Map<string, 'open' | 'done'>();
  const kept: (readonly [string, string])[] = [];
  const visit = (start: string): void => {
    const path: { id: string; next: number }[] = [{ id: start, next: 0 }];
    state.set(start, 'open');
    for (let top = path.at(-1); top !== undefined; top = path.at(-1)) {
      const edge = from.get(top.id)?.[top.next];
      top.next += 1;
      if (edge === undefined) {
        state.set(top.id, 'done');
        path.pop();
      } else if (state.get(edge[1]) !== 'open') {
        kept.push(edge);
        if (!state.has(edge[1])) {
          state.set(edge[1], 'open');
          path.push({ id: edge[1], next: 0 });
        }
      }
    }
  };
  const targets = new Set(edges.map(([, to]) => to));
  const first = [...boxes].sort((one, other) => Number(targets.has(one.id)) - Number(targets.has(other.id)));
  for (const { id } of first) {
    if (!state.has(id)) {
      visit(id);
    }
  }
  return kept;
}

/** Each box in the column after the last of those that lead to it. */
function columnsOf(boxes: readonly Box[], edges: readonly (readonly [string, string])[]): string[][] {
  const rank = new Map(boxes.map(({ id }) => [id, 0]));
  const from = groups(edges, 0);
  const missing = new Map(boxes.map(({ id }) => [id, 0]));
  for (const [, to] of edges) {
    missing.set(to, (missing.get(to) ?? 0) + 1);
  }
  const ready = boxes.map(({ id }) => id).filter((id) => missing.get(id) === 0);
  for (let id = ready.shift(); id !== undefined; id = ready.shift()) {
    for (const [, to] of from.get(id) ?? []) {
      rank.set(to, Math.max(rank.get(to) ?? 0, (rank.get(id) ?? 0) + 1));
      missing.set(to, (missing.get(to) ?? 0) - 1);
      if (missing.get(to) === 0) {
        ready.push(to);
      }
    }
  }
  const columns: string[][] = [];
  for (const [id, column] of rank) {
    (columns[column] ??= []).push(id);
  }
  return columns;
}

/** Rows such that boxes are near those that they are linked with: by barycentres, to and fro. */
function ordered(columns: string[][], edges: readonly (readonly [string, string])[]): string[][] {
  const to = groups(edges, 1);
  const from = groups(edges, 0);
  const row = new Map<string, number>();
  const note = (column: string[]): void => column.forEach((id, index) => row.set(id, index / column.length));
  columns.forEach(note);
  for (let sweep = 0; sweep < SWEEPS; sweep += 1) {
    const [others, end, way] = sweep % 2 === 0 ? ([to, 0, columns] as const) : ([from, 1, columns.map((_, at) => columns[columns.length - 1 - at] ?? [])] as const);
    for (const column of way) {
      const middle = new Map(
        column.map((id) => {
          const near = (others.get(id) ?? []).map((edge) => row.get(edge[end]) ?? 0);
          const own = row.get(id) ?? 0;
          return [id, near.length === 0 ? own : near.reduce((sum, each) => sum + each, 0) / near.length];
        }),
      );
      column.sort((one, other) => (middle.get(one) ?? 0) - (middle.get(other) ?? 0));
      note(column);
    }
  }
  return columns;
}

function place(columns: Box[][]): Drawing {
  const heights = columns.map((column) => column.reduce((sum, { height }) => sum + height + ROW_GAP, -ROW_GAP));
  const height = Math.max(0, ...heights);
  const placed: Placed[] = [];
  let x = 0;
  columns.forEach((column, index) => {
    let y = (height - (heights[index] ?? 0)) / 2;
    const width = Math.max(...column.map((box) => box.width));
    for (const box of column) {
      placed.push({ ...box, x: x + (width - box.width) / 2, y });
      y += box.height + ROW_GAP;
    }
    x += width + COLUMN_GAP;
  });
  return { boxes: placed, width: Math.max(0, x - COLUMN_GAP), height };
}

function groups(edges: readonly (readonly [string, string])[], by: 0 | 1) {
  const found = new Map<string, (readonly [string, string])[]>();
  for (const edge of edges) {
    found.set(edge[by], [...(found.get(edge[by]) ?? []), edge]);
  }
  return found;
}
