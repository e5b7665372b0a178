// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Records the topics of the graph into a bag where the viewer runs; all pages see it. */
import { render } from 'preact';
import { ask, type App } from '../app';
import { h } from '../dom';
import { sizeText } from '../format';
import { Button } from '../ui';

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

/** Have topics recorded; none: all of them. */
export function startRecording(app: App, topics: string[]): void {
  void ask(app, { type: 'start_recording', topics });
}

function Record({ app }: { app: App }) {
  const { writing } = app.store;
  if (writing?.active !== true) {
    return (
      <Button
        icon="record"
        text="Record"
        title="Record all topics into a bag where the viewer runs, as ros2 bag record -a does"
        onClick={() => startRecording(app, [])}
      />
    );
  }
  const { seconds, size, messages, topics, path, lost } = writing;
  const words = `${seconds.toFixed(0)} s · ${sizeText(size)}`;
  const title = `${path}: ${messages} messages of ${topics} topics${lost > 0 ? `, ${lost} lost` : ''}`;
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
        {words}
      </output>
    </>
  );
}
