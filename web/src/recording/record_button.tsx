// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Records the topics of the graph into a bag where the viewer runs; all pages see it. */
import { useSignal } from '@preact/signals';
import { render } from 'preact';
import { useRef } from 'preact/hooks';
import { ask, type App } from '../app';
import { h } from '../dom';
import { sizeText } from '../format';
import type { BagWriting, SensorInfo } from '../protocol';
import { recall, remember } from '../remember';
import { Button, Icon, Switch } from '../ui';

/** The button, with what is recorded beside it. */
export function recordButton(app: App): HTMLElement {
  const element = h('div', { class: 'recorder' });
  render(<Record app={app} />, element);
  app.store.watch(['recording', 'hello', 'link'], () => {
    const { hello, recording, link } = app.store;
    element.hidden = hello === null || recording !== null || link.state !== 'open';
  });
  return element;
}

/** Have topics recorded; none: all of them, but for these types of messages. */
export function startRecording(app: App, topics: string[], without: string[] = []): void {
  void ask(app, { type: 'start_recording', topics, without_types: without });
}

/** What a second of which takes megabytes, and what makes a simulator slow to measure. */
const BULKY: readonly { kind: SensorInfo['kind']; type: string; label: string }[] = [
  { kind: 'picture', type: 'sensor_msgs/msg/Image', label: 'Raw pictures, depths' },
  { kind: 'cloud', type: 'sensor_msgs/msg/PointCloud2', label: 'Point clouds' },
];

function Record({ app }: { app: App }) {
  const { writing } = app.store;
  return writing?.active === true ? <Recording app={app} writing={writing} /> : <Offer app={app} />;
}

/** Records at once where nothing is bulky; else asks what. */
function Offer({ app }: { app: App }) {
  const menu = useRef<HTMLDetailsElement>(null);
  const flips = useSignal(0);
  const title = 'Record all topics into a bag where the viewer runs, as ros2 bag record -a does';
  const { graph, writing } = app.store;
  const bulky = BULKY.filter(({ kind }) => graph?.sensors.some((each) => each.kind === kind));
  if (bulky.length === 0) {
    return <Button icon="record" text="Record" title={title} onClick={() => startRecording(app, [])} />;
  }
  void flips.value;
  const isOn = (type: string): boolean => recall(`record.${type}`) === 'yes';
  const start = (): void => {
    menu.current?.removeAttribute('open');
    startRecording(app, [], bulky.filter(({ type }) => !isOn(type)).map(({ type }) => type));
  };
  return (
    <details ref={menu} class="menu">
      <summary class="button" title={title} aria-label="Record">
        <Icon name="record" />
        <span>Record</span>
      </summary>
      <div class="menu-items record-offer">
        <p>All topics, and also:</p>
        {bulky.map(({ type, label }) => (
          <div key={type} class="record-choice" title={type}>
            <span>{label}</span>
            <Switch
              on={isOn(type)}
              label={`Record ${label}`}
              onFlip={(on) => {
                remember(`record.${type}`, on ? 'yes' : 'no');
                flips.value += 1;
              }}
            />
          </div>
        ))}
        <p class="fine">
          They take megabytes a second, and a simulator has to measure them. Compressed pictures are always recorded.
        </p>
        {writing !== null && <p class="fine">{`${freeText(writing)} in ${writing.folder}`}</p>}
        <Button icon="record" text="Start" title="Begin to record" onClick={start} />
      </div>
    </details>
  );
}

function Recording({ app, writing }: { app: App; writing: BagWriting }) {
  const { seconds, size, messages, topics, path, lost, free } = writing;
  const rate = seconds >= 1 ? ` · ${sizeText(size / seconds)}/s` : '';
  const words = `${seconds.toFixed(0)} s · ${sizeText(size)}${rate}`;
  const title = `${path}: ${messages} messages of ${topics} topics${lost > 0 ? `, ${lost} lost` : ''}; ${freeText(writing)}`;
  return (
    <>
      <Button
        icon="stop"
        text="Stop"
        kind="danger"
        title="End the recording"
        onClick={() => void ask(app, { type: 'stop_recording' })}
      />
      <output class="recorder-words" title={title}>
        {free < LITTLE ? `${words} · only ${freeText(writing)}` : words}
      </output>
    </>
  );
}

const LITTLE = 2e9; // bytes

function freeText({ free }: BagWriting): string {
  return free < 1e9 ? `${sizeText(free)} free` : `${(free / 1e9).toFixed(free < 1e11 ? 1 : 0)} GB free`;
}
