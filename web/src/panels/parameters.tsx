// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The parameters of any node, edited live, within their bounds. */
import { useSignal, type Signal } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';
import type { App, Panel } from '../app';
import type { ParameterInfo } from '../protocol';
import { Button, Empty, Switch } from '../ui';
import { panelOf, type PanelProps } from './component';

export function parametersPanel(app: App): Panel {
  return panelOf(app, { id: 'parameters', title: 'Parameters', watches: ['topics'] }, Parameters);
}

function Parameters({ app }: PanelProps) {
  const node = useSignal('');
  const text = useSignal('');
  const found = useSignal<readonly ParameterInfo[] | null>(null);
  const fault = useSignal('');
  const nodes = app.store.topics?.nodes ?? [];
  const [again, asked] = [useSignal(0), node.value];
  const { connection } = app;
  useLayoutEffect(() => {
    let isCurrent = asked !== '';
    found.value = null;
    fault.value = '';
    const load = async (): Promise<void> => {
      const reply = await connection.request({ type: 'parameters', node: asked });
      if (isCurrent) {
        fault.value = reply.ok ? '' : reply.message;
        found.value = reply.ok ? (reply.data as ParameterInfo[]) : null;
      }
    };
    if (isCurrent) {
      void load();
    }
    return () => void (isCurrent = false);
  }, [asked, again.value, connection, found, fault]);
  const shown = (found.value ?? []).filter(({ name }) => name.includes(text.value.trim()));
  return (
    <>
      <label class="field" for="parameter-node">
        <span>Node</span>
        <select
          id="parameter-node"
          value={node.value}
          onChange={({ currentTarget }) => (node.value = currentTarget.value)}
        >
          <option value="">choose a node</option>
          {(node.value === '' || nodes.includes(node.value) ? nodes : [...nodes, node.value]).map((name) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </label>
      {node.value !== '' && (
        <div class="tools spaced">
          <input
            type="text"
            class="grow"
            placeholder="Filter"
            aria-label="Filter parameters"
            value={text.value}
            onInput={({ currentTarget }) => (text.value = currentTarget.value)}
          />
          <Button text="Read again" icon="reset" onClick={() => (again.value += 1)} />
        </div>
      )}
      {fault.value !== '' && <p class="refusal">{fault.value}</p>}
      {node.value !== '' && found.value === null && fault.value === '' && <Empty>Asking {node.value} …</Empty>}
      {found.value?.length === 0 && <Empty>It has no parameters.</Empty>}
      <ul class="rows parameters">
        {shown.map((info) => (
          <Row key={`${node.value} ${info.name}`} app={app} node={node.value} info={info} all={found} />
        ))}
      </ul>
    </>
  );
}

interface RowProps {
  app: App;
  node: string;
  info: ParameterInfo;
  all: Signal<readonly ParameterInfo[] | null>;
}

function Row({ app, node, info, all }: RowProps) {
  const refusal = useSignal('');
  const busy = useSignal(false);
  const set = async (value: unknown): Promise<void> => {
    busy.value = true;
    const { name, kind } = info;
    const reply = await app.connection.request({ type: 'set_parameter', node, name, kind, value });
    busy.value = false;
    refusal.value = reply.ok ? '' : reply.message;
    if (reply.ok) {
      const now = reply.data as ParameterInfo;
      all.value = all.peek()?.map((each) => (each.name === name ? now : each)) ?? null;
    }
  };
  const bounds = boundsOf(info);
  return (
    <li class="unit parameter">
      <span class="unit-name">{info.name}</span>
      <span class="chosen-value">
        <Editor key={JSON.stringify(info.value)} info={info} busy={busy.value} onSet={(value) => void set(value)} />
      </span>
      <span class="fine about">
        {[info.kind.replace('_', ' '), bounds, info.read_only ? 'read only' : '', info.constraints, info.description]
          .filter((each) => each !== '')
          .join(' · ')}
      </span>
      {refusal.value !== '' && (
        <span class="fine refusal" role="alert">
          {refusal.value}
        </span>
      )}
    </li>
  );
}

interface EditorProps {
  info: ParameterInfo;
  busy: boolean;
  onSet: (value: unknown) => void;
}

/** What a value is typed into; it is set by Enter, or when it is left, if it is another one. */
function Editor({ info, busy, onSet }: EditorProps) {
  const { kind, name, value, read_only: readOnly } = info;
  const label = `${name}, ${kind}`;
  if (kind === 'not set') {
    return <span class="fine">no value</span>;
  }
  if (kind === 'bool') {
    return <Switch on={value === true} label={label} disabled={readOnly} busy={busy} onFlip={onSet} />;
  }
  const shown = kind.endsWith('_array') ? JSON.stringify(value) : String(value ?? 'NaN');
  const isNumber = kind === 'integer' || kind === 'double';
  return (
    <input
      type="text"
      inputMode={isNumber ? 'decimal' : 'text'}
      class={isNumber ? 'number' : undefined}
      aria-label={label}
      title={shown}
      readOnly={readOnly}
      aria-busy={busy}
      defaultValue={shown}
      onKeyDown={({ key, currentTarget }) => {
        if (key === 'Enter') {
          currentTarget.blur();
        } else if (key === 'Escape') {
          currentTarget.value = shown;
        }
      }}
      onBlur={({ currentTarget }) => {
        if (currentTarget.value !== shown) {
          onSet(valueOf(kind, currentTarget.value));
        }
      }}
    />
  );
}

/** What was typed; what cannot be read goes to the node as text, which says what is wrong with it. */
function valueOf(kind: string, text: string): unknown {
  if (kind === 'string') {
    return text;
  }
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}

function boundsOf({ lower, upper, step }: ParameterInfo): string {
  if (lower === null && upper === null) {
    return '';
  }
  const range = `${lower ?? '−∞'} to ${upper ?? '∞'}`;
  return step === null ? range : `${range} by ${step}`;
}
