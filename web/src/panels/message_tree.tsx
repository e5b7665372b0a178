// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A message as a tree that folds; its numbers can be plotted. */
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { dragField, type Field } from '../plots/field';
import type { Tree } from '../samples';

/** Shows numbers over time. */
export interface Plotting {
  isPlotted(field: Field): boolean;
  /** Plot it, or no more. */
  toggle(field: Field): void;
}

interface TreeProps {
  topic: string;
  tree: Tree;
  plots: Plotting;
}

type Fields = Readonly<Record<string, Tree>>;

const OPEN_DEPTH = 3; // levels that are open at first
const OPEN_ELEMENTS = 4; // of an array that is

export function MessageTree({ topic, tree, plots }: TreeProps) {
  return (
    <ul class="tree message">
      {Object.entries(tree as Fields).map(([name, value]) => (
        <Branch key={name} topic={topic} name={name} path={name} tree={value} plots={plots} depth={1} />
      ))}
    </ul>
  );
}

type FieldProps = TreeProps & { name: string; path: string; depth: number };

function Branch(props: FieldProps) {
  const { topic, name, path, tree, plots, depth } = props;
  const array = arrayOf(tree);
  if (array !== null) {
    const { length, first } = array;
    return (
      <Fold name={name} note={`${length} element${length === 1 ? '' : 's'}`} open={length > 0 && length <= OPEN_ELEMENTS}>
        {first
          .map((each, index) => ({ each, name: `[${index}]` }))
          .map(({ each, name: index }) => (
            <Branch
              key={index}
              {...props}
              name={index}
              path={`${path}${index}`}
              tree={each}
              depth={depth + 1}
            />
          ))}
        {first.length < length && <li class="fine">{`… ${length - first.length} more`}</li>}
      </Fold>
    );
  }
  const number = numberOf(tree);
  if (number !== null || typeof tree === 'string') {
    return (
      <li class="leaf">
        <span class="field-name">{name}</span>
        <button
          type="button"
          class={number === null ? 'number words' : 'number'}
          title={`Plot ${topic}:${path}`}
          aria-pressed={plots.isPlotted({ topic, path })}
          draggable
          onClick={() => plots.toggle({ topic, path })}
          onDragStart={({ dataTransfer }) => dragField(dataTransfer, { topic, path })}
        >
          {number ?? textOf(tree)}
        </button>
      </li>
    );
  }
  if (typeof tree === 'object' && !('#text' in tree)) {
    return (
      <Fold name={name} note="" open={depth < OPEN_DEPTH}>
        {Object.entries(tree as Fields).map(([inner, value]) => (
          <Branch
            key={inner}
            {...props}
            name={inner}
            path={`${path}.${inner}`}
            tree={value}
            depth={depth + 1}
          />
        ))}
      </Fold>
    );
  }
  return (
    <li class="leaf">
      <span class="field-name">{name}</span>
      <span class="words">{textOf(tree)}</span>
    </li>
  );
}

interface FoldProps {
  name: string;
  note: string;
  open: boolean;
  children: ComponentChildren;
}

function Fold({ name, note, open, children }: FoldProps) {
  const isOpen = useSignal(open);
  return (
    <li>
      <button
        type="button"
        class="fold"
        aria-expanded={isOpen.value}
        onClick={() => (isOpen.value = !isOpen.value)}
      >
        <span class="field-name">{name}</span>
        {note !== '' && <span class="fine">{note}</span>}
      </button>
      {isOpen.value && <ul>{children}</ul>}
    </li>
  );
}

/** An array, which may be shortened; null: it is none. */
function arrayOf(tree: Tree): { length: number; first: readonly Tree[] } | null {
  if (Array.isArray(tree)) {
    return { length: tree.length, first: tree as readonly Tree[] };
  }
  const fields = tree as Fields;
  return typeof tree === 'object' && '#first' in tree
    ? { length: Number(fields['#length']), first: fields['#first'] as readonly Tree[] }
    : null;
}

/** A number, or a truth, as text; null: it is none. */
export function numberOf(tree: Tree): string | null {
  if (typeof tree === 'number') {
    return Number.isInteger(tree) ? String(tree) : tree.toPrecision(7).replace(/\.?0+($|e)/, '$1');
  }
  if (typeof tree === 'boolean') {
    return String(tree);
  }
  return typeof tree === 'object' && '#number' in tree ? String(tree['#number']) : null;
}

/** A string; of one that is shortened, its length, too. */
function textOf(tree: Tree): string {
  if (typeof tree === 'string') {
    return tree === '' ? '""' : tree;
  }
  const { '#text': text, '#length': length } = tree as Fields;
  return `${String(text)} … ${String(length)} bytes in all`;
}
