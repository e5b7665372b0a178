// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** All services and actions: forms that call them, and what they answer. */
import { signal, useComputed, useSignal, type Signal } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';
import type { App, Panel } from '../app';
import type { GoalProgress, CallInfo } from '../protocol';
import { Button, Chip, Empty, Switch, type Tone } from '../ui';
import { panelOf, type PanelProps } from './component';
import { Inputs, Said, useForm } from './message_form';

/** What every node serves, of its parameters. */
const OF_NODES = /^(rcl_interfaces|type_description_interfaces)\//;
const TONES: Partial<Record<GoalProgress['state'], Tone>> = {
  active: 'calm', succeeded: 'good', canceled: 'warning', aborted: 'error', lost: 'error',
};

type Goals = Signal<Readonly<Record<string, number>>>; // by action, the last goal of this page

export function servicesPanel(app: App): Panel {
  const goals: Goals = signal({});
  const Body = (props: PanelProps) => <ServiceList {...props} goals={goals} />;
  return panelOf(app, { id: 'services', title: 'Services', watches: ['services'] }, Body);
}

function ServiceList({ app, goals }: PanelProps & { goals: Goals }) {
  const text = useSignal('');
  const all = useSignal(false);
  const chosen = useSignal<string | null>(null);
  const services = useComputed(() => {
    const words = text.value.toLowerCase().split(/\s+/);
    return (app.store.services?.services ?? []).filter(({ name, kind }) => {
      const said = `${name} ${kind}`.toLowerCase();
      return (all.value || !OF_NODES.test(kind)) && words.every((word) => said.includes(word));
    });
  }).value;
  if (app.store.services === null) {
    return <Empty>The node looks at the graph …</Empty>;
  }
  return (
    <>
      <div class="tools">
        <input
          type="text"
          class="grow"
          placeholder="Filter: name, type"
          aria-label="Filter services"
          value={text.value}
          onInput={({ currentTarget }) => (text.value = currentTarget.value)}
        />
        <span class="fine" title="Services by which nodes are asked for their parameters">
          parameters
        </span>
        <Switch on={all.value} label="Show services of parameters" onFlip={(on) => (all.value = on)} />
      </div>
      {services.length === 0 && <Empty>No service and no action is like that.</Empty>}
      <ul class="topics">
        {services.map((service) => {
          const key = `${service.name} ${service.kind}`;
          const isOpen = chosen.value === key;
          return (
            <li key={key}>
              <button
                type="button"
                class="topic"
                aria-expanded={isOpen}
                onClick={() => (chosen.value = isOpen ? null : key)}
              >
                <span class="unit-name">{service.name}</span>
                <span class="fine">{service.is_action ? 'action' : ''}</span>
                <span class="fine">{service.kind}</span>
              </button>
              {isOpen && <Call app={app} service={service} goals={goals} />}
            </li>
          );
        })}
      </ul>
    </>
  );
}

/** What of a simulator takes robots out of the world, though its name does not say so. */
const REMOVES: Record<string, string> = {
  'simulation_interfaces/srv/LoadWorld': 'The robots of the present world are removed.',
  'simulation_interfaces/srv/ResetSimulation':
    'By default robots that were spawned are removed, too; scope 3 resets time and state alone.',
  'simulation_interfaces/srv/SetSimulationState': 'STATE_STOPPED removes all robots.',
};

interface CallProps {
  app: App;
  service: CallInfo;
  goals: Goals;
}

function Call({ app, service: { name, kind, is_action: isAction }, goals }: CallProps) {
  const { fields, typed, said, open, values } = useForm(app, kind);
  const answer = useSignal('');
  const isBusy = useSignal(false);
  useLayoutEffect(() => void open(), [open]);
  const goal = isAction ? goals.value[name] : undefined;
  const progress = goal === undefined ? undefined : app.store.progress.get(goal);
  const isActive = goal !== undefined && (progress?.state ?? 'active') === 'active';
  const send = async (): Promise<void> => {
    const filled = values();
    if (filled === null) {
      return;
    }
    isBusy.value = true;
    const reply = await app.connection.request(
      isAction
        ? { type: 'send_goal', action: name, kind, values: filled }
        : { type: 'call_service', service: name, kind, values: filled },
    );
    isBusy.value = false;
    said.value = reply;
    answer.value = typeof reply.data === 'string' ? reply.data : '';
    if (isAction && reply.ok) {
      goals.value = { ...goals.value, [name]: reply.id };
    }
  };
  const cancel = async (): Promise<void> => {
    if (goal !== undefined) {
      said.value = await app.connection.request({ type: 'cancel_sent', goal });
    }
  };
  const text = progress?.text ?? answer.value;
  return (
    <div class="topic-body publish">
      {fields.value?.length === 0 && <p class="fine">It asks for nothing.</p>}
      {kind in REMOVES && <p class="fine">{REMOVES[kind]}</p>}
      <Inputs fields={fields.value ?? []} path="" typed={typed.value} onType={(all) => (typed.value = all)} />
      <div class="tools wrap">
        <Button
          text={isAction ? 'Send goal' : 'Call'}
          kind="primary"
          disabled={fields.value === null || isBusy.value || isActive}
          onClick={() => void send()}
        />
        {isActive && <Button text="Cancel goal" kind="danger" onClick={() => void cancel()} />}
        {progress !== undefined && <Chip tone={TONES[progress.state]}>{progress.state}</Chip>}
      </div>
      <Said said={said.value} />
      {text !== '' && (
        <pre class="answer" role="group" tabIndex={0} aria-label={isActive ? 'Feedback' : 'Answer'}>
          {text}
        </pre>
      )}
    </div>
  );
}
