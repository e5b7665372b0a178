// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** All topics: who publishes them and how, what comes by them, and a form to publish. */
import { signal, useComputed, useSignal, type Signal } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';
import type { App, Panel } from '../app';
import type { TopicMessage } from '../channels';
import { fixed, UNKNOWN } from '../format';
import type { Endpoint, TopicInfo } from '../protocol';
import { startRecording } from '../recording/record_button';
import { Button, Empty, Facts, Section, Switch } from '../ui';
import { panelOf, type PanelProps } from './component';
import { MessageTree, type Plotting } from './message_tree';
import { PublishForm } from './publish_form';

const MOST = 300; // topics that are drawn

export function topicsPanel(app: App, plots: Plotting): Panel {
  const rates = signal(false);
  const Body = (props: PanelProps) => <TopicList {...props} rates={rates} plots={plots} />;
  const watches = (): Panel['watches'] => (rates.value ? ['topics', 'rates'] : ['topics']);
  return panelOf(app, { id: 'topics', title: 'Topics', watches }, Body);
}

interface ListProps extends PanelProps {
  rates: Signal<boolean>;
  plots: Plotting;
}

function TopicList({ app, rates, plots }: ListProps) {
  const text = useSignal('');
  const chosen = useSignal<string | null>(null);
  const topics = useComputed(() => {
    const words = text.value.toLowerCase().split(/\s+/);
    return (app.store.topics?.topics ?? []).filter((topic) => {
      const all = allWords(topic);
      return words.every((word) => all.includes(word));
    });
  }).value;
  if (app.store.topics === null) {
    return <Empty>The node looks at the graph …</Empty>;
  }
  return (
    <>
      <div class="tools">
        <input
          type="text"
          class="grow"
          placeholder="Filter"
          title="By name, type or node"
          aria-label="Filter topics"
          value={text.value}
          onInput={({ currentTarget }) => (text.value = currentTarget.value)}
        />
        <RecordThese app={app} topics={topics} />
        <span class="fine" title="Subscribes to all topics but those of sensors">
          rates
        </span>
        <Switch on={rates.value} label="Measure rates" onFlip={(on) => (rates.value = on)} />
      </div>
      {topics.length === 0 && <Empty>No topic is like that.</Empty>}
      <ul class="topics">
        {topics.slice(0, MOST).map((topic) => (
          <Topic
            key={topic.name}
            app={app}
            topic={topic}
            open={chosen.value === topic.name}
            onOpen={() => (chosen.value = chosen.value === topic.name ? null : topic.name)}
            plots={plots}
          />
        ))}
      </ul>
      {topics.length > MOST && <p class="fine">{`${topics.length - MOST} more: filter them.`}</p>}
    </>
  );
}

/** Records those that the filter leaves; all of them the button in the head of the page records. */
function RecordThese({ app, topics }: Pick<TopicProps, 'app'> & { topics: readonly TopicInfo[] }) {
  const { recording, writing } = app.store;
  const isOffered = recording === null && writing !== null && topics.length > 0;
  return isOffered ? (
    <span class="recorder">
      <Button
        icon="record"
        text="Record these"
        kind="quiet"
        title={`Record these ${topics.length} topics into a bag`}
        disabled={writing.active}
        onClick={() => startRecording(app, topics.map(({ name }) => name))}
      />
    </span>
  ) : null;
}

function allWords({ name, kinds, publishers, subscriptions }: TopicInfo): string {
  const nodes = [...publishers, ...subscriptions].map(({ node }) => node);
  return [name, ...kinds, ...nodes].join(' ').toLowerCase();
}

interface TopicProps {
  app: App;
  topic: TopicInfo;
  open: boolean;
  onOpen: () => void;
  plots: Plotting;
}

function Topic({ app, topic, open, onOpen, plots }: TopicProps) {
  const { name, kinds, publishers, subscriptions, rate } = topic;
  return (
    <li>
      <button type="button" class="topic" aria-expanded={open} onClick={onOpen}>
        <span class="unit-name">{name}</span>
        <span class="fine">
          {rate !== null && `${fixed(rate, rate < 10 ? 1 : 0)} Hz · `}
          {`${publishers.length} pub, ${subscriptions.length} sub`}
        </span>
        <span class="fine" data-tone={kinds.length > 1 ? 'warning' : undefined}>
          {kinds.join(' or ')}
        </span>
      </button>
      {open && (
        <div class="topic-body">
          <Facts
            pairs={[...nodePairs('Published by', publishers), ...nodePairs('Subscribed by', subscriptions)]}
          />
          {publishers.length > 0 && <Echo key={kinds.join(' ')} app={app} topic={name} plots={plots} />}
          {kinds.length === 1 && app.store.recording === null && <PublishForm app={app} topic={name} kind={kinds[0] ?? ''} />}
        </div>
      )}
    </li>
  );
}

function nodePairs(word: string, endpoints: readonly Endpoint[]): [string, string][] {
  return endpoints.length === 0
    ? [[word, 'nobody']]
    : endpoints.map(({ node, qos }, index) => [index === 0 ? word : '', `${node} (${qos})`]);
}

/** The latest message, as long as this is drawn. */
function Echo({ app, topic, plots }: Pick<TopicProps, 'app' | 'plots'> & { topic: string }) {
  const message = useSignal<TopicMessage | null>(null);
  const fault = useSignal('');
  const frozen = useSignal(false);
  useLayoutEffect(
    () =>
      app.channels.follow(topic, {
        take: (came) => {
          if (!frozen.peek()) {
            message.value = came;
          }
          fault.value = '';
        },
        fail: (reason) => (fault.value = reason),
      }),
    [app.channels, topic, message, fault, frozen],
  );
  const came = message.value;
  const rate = came?.head.origin.rate ?? null;
  return (
    <Section title="Latest message">
      {fault.value !== '' && <p class="refusal">{fault.value}</p>}
      {came === null && fault.value === '' && <Empty>Nothing has come yet.</Empty>}
      {came !== null && (
        <>
          <div class="tools">
            <span class="fine grow">
              {`${came.head.size} bytes · ${rate === null ? UNKNOWN : fixed(rate, 1)} Hz`}
            </span>
            <span class="fine">pause</span>
            <Switch on={frozen.value} label="Pause" onFlip={(on) => (frozen.value = on)} />
          </div>
          <MessageTree topic={topic} tree={came.tree} plots={plots} />
        </>
      )}
    </Section>
  );
}
