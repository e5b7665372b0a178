// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A form of what is sent: its fields, their defaults and constants, and what was typed. */
import { useSignal, type Signal } from '@preact/signals';
import { useCallback } from 'preact/hooks';
import type { App } from '../app';
import type { FieldInfo, Reply } from '../protocol';

type Typed = Readonly<Record<string, string>>; // by path, what is not the default

export type Outcome = Pick<Reply, 'ok' | 'message'>;

/** What a form has: null fields until it is opened. */
export interface Form {
  fields: Signal<readonly FieldInfo[] | null>;
  typed: Signal<Typed>;
  said: Signal<Outcome | null>; // of the last that was asked
  open: () => Promise<void>;
  /** What was typed; null: it cannot be sent, which is said. */
  values: () => Record<string, unknown> | null;
}

/** `kind`: the type of the message, the service or the action. */
export function useForm(app: App, kind: string): Form {
  const fields: Form['fields'] = useSignal(null);
  const typed = useSignal<Typed>({});
  const said: Form['said'] = useSignal(null);
  const open = useCallback(async () => {
    const reply = await app.connection.request({ type: 'definition', message: kind });
    said.value = reply.ok ? null : reply;
    fields.value = reply.ok ? (reply.data as FieldInfo[]) : null;
  }, [app, kind, fields, said]);
  return {
    fields,
    typed,
    said,
    open,
    values() {
      try {
        return valuesOf(fields.value ?? [], typed.value);
      } catch (error) {
        said.value = { ok: false, message: (error as Error).message };
        return null;
      }
    },
  };
}

export function Said({ said }: { said: Outcome | null }) {
  return said === null ? null : (
    <output class={said.ok ? 'fine' : 'refusal'}>{said.message}</output>
  );
}

interface InputsProps {
  fields: readonly FieldInfo[];
  path: string;
  typed: Typed;
  onType: (typed: Typed) => void;
}

export function Inputs({ fields, path, typed, onType }: InputsProps) {
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
            <label for={`field-${at}`} title={wordsOf(field)}>
              {field.name}
            </label>
            <input
              type="text"
              id={`field-${at}`}
              list={Object.keys(field.constants).length > 0 ? `constants-${at}` : undefined}
              placeholder={placeholderOf(field)}
              value={typed[at] ?? ''}
              onInput={({ currentTarget: { value } }) => {
                const { [at]: _, ...others } = typed;
                onType(value === '' ? others : { ...others, [at]: value });
              }}
            />
            <Constants id={`constants-${at}`} of={field.constants} />
          </li>
        );
      })}
    </ul>
  );
}

/** The names of values, offered by the browser as one types. */
function Constants({ id, of }: { id: string; of: FieldInfo['constants'] }) {
  const pairs = Object.entries(of);
  return pairs.length === 0 ? null : (
    <datalist id={id}>
      {pairs.map(([name, value]) => (
        <option key={name} value={name}>
          {`${name} = ${String(value)}`}
        </option>
      ))}
    </datalist>
  );
}

/** Whether its fields are filled in one by one: a message, but no time, which may be "now". */
function isWhole({ length, kind }: FieldInfo): boolean {
  return length === null && kind.includes('/') && kind !== 'builtin_interfaces/msg/Time';
}

function kindOf({ kind, length }: FieldInfo): string {
  return length === null ? kind : `${kind}[${length || ''}]`;
}

/** What it is, and by which names its values go. */
function wordsOf(field: FieldInfo): string {
  const names = Object.entries(field.constants).map(([name, value]) => `${name} = ${String(value)}`);
  return [kindOf(field), ...names].join('\n');
}

function placeholderOf(field: FieldInfo): string {
  if (field.length !== null) {
    return field.kind.includes('/') ? '[{…}, …]' : '[…, …]';
  }
  if (field.kind.includes('/')) {
    return 'now, or {"sec": 1}';
  }
  const [name] = Object.entries(field.constants).find(([, value]) => value === field.value) ?? [];
  return [String(field.value ?? ''), name].filter(Boolean).join(' ');
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
  const constant = field.constants[text.trim()];
  if (constant !== undefined) {
    return constant;
  }
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
