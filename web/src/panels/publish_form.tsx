// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Publishes a message that was filled in: once, or at a rate as long as this page is there. */
import { useSignal } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';
import type { App } from '../app';
import type { FieldInfo } from '../protocol';
import { Button } from '../ui';

interface FormProps {
  app: App;
  topic: string;
  kind: string; // type of the messages
}

type Typed = Readonly<Record<string, string>>; // by path, what is not the default

export function PublishForm({ app, topic, kind }: FormProps) {
  const fields = useSignal<readonly FieldInfo[] | null>(null);
  const typed = useSignal<Typed>({});
  const rate = useSignal(10);
  const said = useSignal<{ ok: boolean; text: string } | null>(null);
  const repeats = useSignal(false);
  const open = async (): Promise<void> => {
    const reply = await app.connection.request({ type: 'definition', message: kind });
    said.value = reply.ok ? null : { ok: false, text: reply.message };
    fields.value = reply.ok ? (reply.data as FieldInfo[]) : null;
  };
  const send = async (at: number): Promise<void> => {
    let values: Record<string, unknown>;
    try {
      values = valuesOf(fields.value ?? [], typed.value);
    } catch (error) {
      said.value = { ok: false, text: (error as Error).message };
      return;
    }
    const reply = await app.connection.request({ type: 'publish', topic, message: kind, values, rate: at });
    said.value = { ok: reply.ok, text: reply.message };
    repeats.value = reply.ok && at > 0;
  };
  const end = async (): Promise<void> => {
    repeats.value = false;
    const reply = await app.connection.request({ type: 'unpublish', topic });
    said.value = { ok: reply.ok, text: reply.message };
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

function Said({ said }: { said: { ok: boolean; text: string } | null }) {
  return said === null ? null : (
    <output class={said.ok ? 'fine' : 'refusal'}>{said.text}</output>
  );
}

interface InputsProps {
  fields: readonly FieldInfo[];
  path: string;
  typed: Typed;
  onType: (typed: Typed) => void;
}

function Inputs({ fields, path, typed, onType }: InputsProps) {
  return (
    <ul class="tree">
      {fields.map((field) => {
        const at = path === '' ? field.name : `${path}.${field.name}`;
        if (isWhole(field)) {
          return (
            <li key={at}>
              <span class="field-name">{field.name}</span>
              <Inputs fields={field.fields} path={at} typed={typed} onType={onType} />
            </li>
          );
        }
        return (
          <li key={at} class="leaf">
            <label for={`publish-${at}`} title={kindOf(field)}>
              {field.name}
            </label>
            <input
              type="text"
              id={`publish-${at}`}
              placeholder={placeholderOf(field)}
              value={typed[at] ?? ''}
              onInput={({ currentTarget: { value } }) => {
                const { [at]: _, ...others } = typed;
                onType(value === '' ? others : { ...others, [at]: value });
              }}
            />
          </li>
        );
      })}
    </ul>
  );
}

/** Whether its fields are filled in one by one: a message, but no time, which may be "now". */
function isWhole({ length, kind }: FieldInfo): boolean {
  return length === null && kind.includes('/') && kind !== 'builtin_interfaces/msg/Time';
}

function kindOf({ kind, length }: FieldInfo): string {
  return length === null ? kind : `${kind}[${length || ''}]`;
}

function placeholderOf(field: FieldInfo): string {
  if (field.length !== null) {
    return field.kind.includes('/') ? '[{…}, …]' : '[…, …]';
  }
  return field.kind.includes('/') ? 'now, or {"sec": 0, "nanosec": 0}' : String(field.value ?? '');
}

/** The values that were typed, as the node takes them. Throws an Error in one line. */
export function valuesOf(fields: readonly FieldInfo[], typed: Typed, path = ''): Record<string, unknown> {
  const values: Record<string, unknown> = {};
  for (const field of fields) {
    const at = path === '' ? field.name : `${path}.${field.name}`;
    if (isWhole(field)) {
      const inner = valuesOf(field.fields, typed, at);
      if (Object.keys(inner).length > 0) {
        values[field.name] = inner;
      }
    } else if (typed[at] !== undefined) {
      values[field.name] = valueOf(field, typed[at], at);
    }
  }
  return values;
}

function valueOf(field: FieldInfo, text: string, at: string): unknown {
  if (field.length === null && (field.kind.endsWith('string') || text.trim() === 'now')) {
    return field.kind.endsWith('string') ? text : 'now';
  }
  const special: Record<string, number> = { nan: Number.NaN, inf: Infinity, '-inf': -Infinity };
  const number = special[text.trim().toLowerCase()];
  if (number !== undefined) {
    throw new Error(`${at}: ${text} cannot be sent by a page`);
  }
  try {
    return JSON.parse(text) as unknown;
  } catch {
    throw new Error(`${at} is a ${kindOf(field)}: "${text.slice(0, 40)}" cannot be read as one`);
  }
}
