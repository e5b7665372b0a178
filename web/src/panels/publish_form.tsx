// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Publishes a message that was filled in: once, or at a rate as long as this page is there. */
import { useSignal } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';
import type { App } from '../app';
import { Button } from '../ui';
import { Inputs, Said, useForm } from './message_form';

interface FormProps {
  app: App;
  topic: string;
  kind: string; // type of the messages
}

export function PublishForm({ app, topic, kind }: FormProps) {
  const { fields, typed, said, open, values } = useForm(app, kind);
  const rate = useSignal(10);
  const repeats = useSignal(false);
  const send = async (at: number): Promise<void> => {
    const filled = values();
    if (filled !== null) {
      const reply = await app.connection.request({ type: 'publish', topic, message: kind, values: filled, rate: at });
      said.value = reply;
      repeats.value = reply.ok && at > 0;
    }
  };
  const end = async (): Promise<void> => {
    repeats.value = false;
    said.value = await app.connection.request({ type: 'unpublish', topic });
  };
  useLayoutEffect(
    () => () => {
      if (repeats.peek()) {
        void app.connection.request({ type: 'unpublish', topic });
      }
    },
    [app.connection, topic, repeats],
  );
  if (fields.value === null) {
    return (
      <div class="tools">
        <Button text="Publish …" onClick={() => void open()} />
        <Said said={said.value} />
      </div>
    );
  }
  return (
    <section class="section publish">
      <h3>Publish</h3>
      <Inputs fields={fields.value} path="" typed={typed.value} onType={(all) => (typed.value = all)} />
      <div class="tools wrap">
        <Button text="Once" kind="primary" onClick={() => void send(0)} />
        {repeats.value ? (
          <Button text="End" kind="danger" onClick={() => void end()} />
        ) : (
          <Button text={`At ${rate.value} Hz`} onClick={() => void send(rate.value)} />
        )}
        <input
          type="number"
          min={0.1}
          max={100}
          step="any"
          aria-label="Rate, Hz"
          value={rate.value}
          onInput={({ currentTarget }) => (rate.value = currentTarget.valueAsNumber || 1)}
        />
        <Button text="Close" kind="quiet" onClick={() => (fields.value = null)} />
      </div>
      <Said said={said.value} />
    </section>
  );
}
