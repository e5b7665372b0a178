// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the pictures of nodes and of frames have: boxes, arrows, and what is wrong. */
import { fixed } from '../format';
import type { Topics, Transforms } from '../protocol';
import type { GraphBox, GraphEdge } from './picture';

/** Topics that nearly every node has: they would hide the rest. */
const COMMON = /^\/(rosout|parameter_events|clock)$|\/tf(_static)?$|\/transition_event$|\/introspection_data\/|\/statistics\/|\/diagnostics$/;

export interface Pictured {
  boxes: GraphBox[];
  edges: GraphEdge[];
}

/** Nodes and the topics between them; `all`: also common topics, those with one end, and all nodes. */
export function nodesPicture({ nodes, topics }: Topics, all: boolean, text: string): Pictured {
  const boxes: GraphBox[] = [];
  const edges: GraphEdge[] = [];
  const near = new Set<string>();
  for (const { name, publishers, subscriptions, rate } of topics) {
    const ends = publishers.length > 0 && subscriptions.length > 0;
    const ofNodes = [...publishers, ...subscriptions].map(({ node }) => node);
    const matches = [name, ...ofNodes].some((each) => each.includes(text));
    if ((all || (ends && !COMMON.test(name))) && matches) {
      const id = `topic ${name}`;
      const lines = rate === null ? [name] : [name, `${fixed(rate, rate < 10 ? 1 : 0)} Hz`];
      boxes.push({ id, lines, kind: 'topic' });
      for (const node of new Set(publishers.map((each) => each.node))) {
        edges.push({ from: `node ${node}`, to: id });
        near.add(node);
      }
      for (const node of new Set(subscriptions.map((each) => each.node))) {
        edges.push({ from: id, to: `node ${node}` });
        near.add(node);
      }
    }
  }
  const alone = all ? nodes.filter((node) => node.includes(text)) : [];
  const shown = [...new Set([...alone, ...near])].sort();
  boxes.push(...shown.map((node) => ({ id: `node ${node}`, lines: [node], kind: 'node' as const })));
  return { boxes, edges };
}

const OLD = 0.5; // s; more, and ten times its period: it does not come any more

export interface PicturedFrames extends Pictured {
  faults: string[];
}

/** The TF tree, or trees. */
export function framesPicture({ frames, publishers }: Transforms): PicturedFrames {
  const faults: string[] = [];
  const boxes: GraphBox[] = [];
  const edges: GraphEdge[] = [];
  const children = new Set(frames.map(({ name }) => name));
  const roots = [...new Set(frames.flatMap(({ parents }) => parents))].filter((name) => !children.has(name));
  if (roots.length > 1) {
    faults.push(`${roots.length} trees that nothing connects: ${roots.join(', ')}`);
  }
  const tone = roots.length > 1 ? ('warning' as const) : undefined;
  boxes.push(...roots.map((name) => box(name, ['root'], tone)));
  for (const { name, parents, topics, is_static: isStatic, rate, age } of frames) {
    const isOld = age !== null && age > Math.max(OLD, rate === null ? 0 : 10 / rate);
    const words = isStatic
      ? 'static'
      : `${rate === null ? '–' : fixed(rate, rate < 10 ? 1 : 0)} Hz, ${fixed(age, 2)} s old`;
    if (parents.length > 1) {
      const by = topics.map((topic) => `${topic} of ${publishers[topic]?.join(' or ') ?? 'nobody now'}`);
      faults.push(`${name} has ${parents.length} parents: ${parents.join(', ')}; by ${by.join(', and by ')}`);
    }
    boxes.push(box(name, [words], parents.length > 1 ? 'error' : isOld ? 'warning' : undefined));
    for (const parent of parents) {
      edges.push({
        from: parent,
        to: name,
        ...(parents.length > 1 ? { tone: 'error' } : isStatic ? { tone: 'static' } : {}),
      });
    }
  }
  return { boxes, edges, faults };
}

function box(name: string, more: string[], tone: GraphBox['tone']): GraphBox {
  return { id: name, lines: [name, ...more], kind: 'frame', ...(tone === undefined ? {} : { tone }) };
}
