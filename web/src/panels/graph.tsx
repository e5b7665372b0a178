// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Nodes and topics, and the TF tree, as pictures. */
import { signal, useSignal, type Signal } from '@preact/signals';
import type { App, Panel } from '../app';
import { Picture } from '../graph/picture';
import { framesPicture, nodesPicture } from '../graph/shown';
import type { Transforms } from '../protocol';
import type { Store } from '../store';
import { Empty, Facts, Section, Switch } from '../ui';
import { panelOf, type PanelProps } from './component';

type View = 'nodes' | 'frames';

export function graphPanel(app: App): Panel {
  const view = signal<View>('nodes');
  const Body = (props: PanelProps) => <Graph {...props} view={view} />;
  const watches = (): Panel['watches'] => (view.value === 'nodes' ? ['topics'] : ['transforms']);
  return panelOf(app, { id: 'graph', title: 'Graph', watches }, Body);
}

function Graph({ app, view }: PanelProps & { view: Signal<View> }) {
  const pick = (value: View, text: string) => (
    <button
      type="button"
      class="toggle"
      aria-pressed={view.value === value}
      onClick={() => (view.value = value)}
    >
      {text}
    </button>
  );
  return (
    <>
      <div class="tools">
        {pick('nodes', 'Nodes')}
        {pick('frames', 'TF tree')}
      </div>
      {view.value === 'nodes' ? <Nodes store={app.store} /> : <Frames store={app.store} />}
    </>
  );
}

function Nodes({ store }: { store: Store }) {
  const all = useSignal(false);
  const text = useSignal('');
  const chosen = useSignal<string | null>(null);
  const { topics } = store;
  if (topics === null) {
    return <Empty>The node looks at the graph …</Empty>;
  }
  const { boxes, edges } = nodesPicture(topics, all.value, text.value.trim());
  const isWhole = all.value || text.value.trim() !== '';
  const hidden = isWhole ? 0 : topics.nodes.length - boxes.filter(({ kind }) => kind === 'node').length;
  const ends = edges.filter(({ from, to }) => from === chosen.value || to === chosen.value);
  const names = (of: string[]): string => of.map((id) => id.split(' ')[1]).join(', ') || 'none';
  return (
    <>
      <div class="tools">
        <input
          type="text"
          class="grow"
          placeholder="Filter"
          aria-label="Filter nodes and topics"
          value={text.value}
          onInput={({ currentTarget }) => (text.value = currentTarget.value)}
        />
        <span class="fine">all topics</span>
        <Switch on={all.value} label="Show all topics" onFlip={(on) => (all.value = on)} />
      </div>
      <Hidden count={hidden} of={topics.nodes.length} />
      <Picture
        label="Nodes and topics"
        boxes={boxes}
        edges={edges}
        chosen={chosen.value}
        onChoose={(id) => (chosen.value = chosen.value === id ? null : id)}
      />
      {chosen.value !== null && (
        <Section title={chosen.value.split(' ')[1] ?? ''}>
          <Facts
            pairs={[
              ['From', names(ends.filter(({ to }) => to === chosen.value).map(({ from }) => from))],
              ['To', names(ends.filter(({ from }) => from === chosen.value).map(({ to }) => to))],
            ]}
          />
        </Section>
      )}
    </>
  );
}

function Hidden({ count, of }: { count: number; of: number }) {
  return count > 0 ? (
    <p class="fine">
      {`${count} of ${of} nodes are not shown: they share no topic but those that nearly all have. `}
      <b>all topics</b> shows them.
    </p>
  ) : null;
}

function Frames({ store }: { store: Store }) {
  const chosen = useSignal<string | null>(null);
  const { transforms } = store;
  if (transforms === null) {
    return <Empty>The node listens for transforms …</Empty>;
  }
  if (transforms.frames.length === 0) {
    return <Empty>Nobody publishes transforms.</Empty>;
  }
  const { boxes, edges, faults } = framesPicture(transforms);
  return (
    <>
      {faults.length > 0 && (
        <ul class="findings">
          {faults.map((fault) => (
            <li key={fault} data-tone="warning">
              {fault}
            </li>
          ))}
        </ul>
      )}
      <Picture
        label="TF tree"
        boxes={boxes}
        edges={edges}
        chosen={chosen.value}
        onChoose={(id) => (chosen.value = chosen.value === id ? null : id)}
      />
      <FrameFacts transforms={transforms} frame={chosen.value} />
    </>
  );
}

function FrameFacts({ transforms, frame }: { transforms: Transforms; frame: string | null }) {
  const found = transforms.frames.find(({ name }) => name === frame);
  if (found === undefined) {
    const pairs = Object.entries(transforms.publishers).map(([topic, nodes]) => [topic, nodes.join(', ')] as const);
    return <Facts pairs={pairs} />;
  }
  return (
    <Section title={found.name}>
      <Facts
        pairs={[
          ['Parent', found.parents.join(', ')],
          ['Comes by', found.topics.join(', ')],
          ['Published by', publishersOf(transforms, found.topics)],
        ]}
      />
    </Section>
  );
}

function publishersOf({ publishers }: Transforms, topics: readonly string[]): string {
  return [...new Set(topics.flatMap((topic) => publishers[topic] ?? []))].join(' or ') || 'nobody now';
}
