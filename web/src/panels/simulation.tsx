// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The simulator's clock, and the robots in its world: more of them, or fewer. */
import { useSignal, type ReadonlySignal } from '@preact/signals';
import { ask, type App, type Panel } from '../app';
import { clock, factor, UNKNOWN } from '../format';
import type { SimulationStatus } from '../protocol';
import { SpawnForm } from '../spawn/form';
import { Offer, type Ground } from '../spawn/offer';
import type { State } from '../state';
import { Button, Confirmed, Empty, Section } from '../ui';
import { panelOf, type PanelProps } from './component';

const FACTORS = [0.1, 0.25, 0.5, 1, 2, 5, 0]; // 0: as fast as possible
const SLOW = 0.95; // share of the factor asked for, below which the machine is too slow
const WHY_SLOW = /^real time is not kept/; // the simulator's words, in loop_timing.py

/** `ground`: where robots stand; null where nothing is drawn. */
export function simulationPanel(app: App, ground: () => Ground | null): Panel {
  const offer = new Offer(app, ground);
  const Body = (props: PanelProps) => <SimulationPanel {...props} offer={offer} />;
  return panelOf(app, { id: 'simulation', title: 'Simulation', watches: ['log'] }, Body);
}

function SimulationPanel({ app, state, offer }: PanelProps & { offer: Offer }) {
  const { simulator, simulation } = app.store;
  if (simulator === null) {
    return <Empty>There is no simulator in the graph.</Empty>;
  }
  const { id, entities, world, worlds } = simulator;
  const isSilent = app.store.silence !== ''; // nobody is there who could do it
  return (
    <fieldset class="bare" disabled={isSilent}>
      <Section title="Clock">
        <dl class="facts">
          <div>
            <dt>Time</dt>
            <Time state={state} />
          </div>
          <Factor simulation={simulation} silence={app.store.silence} />
        </dl>
        {isSlow(simulation) && !isSilent && <WhySlow app={app} simulator={id} />}
        <div class="form">
          {worlds.length > 1 && <WorldChoice app={app} simulator={id} world={world} worlds={worlds} />}
          <FactorChoice app={app} simulator={id} asked={simulation?.factor ?? null} />
          <Steps app={app} simulator={id} />
        </div>
      </Section>
      <Section title="In the world">
        <ul class="rows">
          {entities.map((name) => (
            <Entity key={name} app={app} simulator={id} name={name} />
          ))}
        </ul>
      </Section>
      <Section title={offer.again === null ? 'Another robot like this one' : 'The robot again'}>
        <SpawnForm offer={offer} state={state} />
      </Section>
    </fieldset>
  );
}

interface SimulatorProps {
  app: App;
  simulator: string;
}

function Time({ state }: { state: ReadonlySignal<State | null> }) {
  return <dd>{state.value === null ? UNKNOWN : clock(state.value.time)}</dd>;
}

function Factor({ simulation, silence }: { simulation: SimulationStatus | null; silence: string }) {
  const { real_factor: real, state } = simulation ?? NOTHING;
  const plays = state === 'playing';
  const slow = isSlow(simulation);
  return (
    <>
      <div>
        <dt>State</dt>
        <dd data-tone={silence === '' ? undefined : 'warning'}>{silence === '' ? (state ?? UNKNOWN) : silence}</dd>
      </div>
      <div>
        <dt>Real-time factor</dt>
        <dd data-tone={slow && silence === '' ? 'warning' : 'calm'}>{plays && silence === '' ? factor(real) : UNKNOWN}</dd>
      </div>
    </>
  );
}

/** Whether the simulator falls behind the factor that was asked for. */
function isSlow(simulation: SimulationStatus | null): boolean {
  const { factor: asked, real_factor: real, state } = simulation ?? NOTHING;
  return state === 'playing' && asked !== null && asked > 0 && real !== null && real < SLOW * asked;
}

/** What the simulator itself has found out, as its log says it. */
function WhySlow({ app, simulator }: SimulatorProps) {
  const name = simulator.slice(1).replaceAll('/', '.');
  let said = 'This machine is too slow for it.';
  for (const { node, text } of app.store.log) {
    if (node === name && WHY_SLOW.test(text)) {
      said = text; // the latest
    }
  }
  return <p class="fine why-slow">{said}</p>;
}

const NOTHING = { factor: null, real_factor: null, state: null };

/** A factor set elsewhere need not be one of those offered here. */
function FactorChoice({ app, simulator, asked }: SimulatorProps & { asked: number | null }) {
  const offered = asked === null || FACTORS.includes(asked) ? FACTORS : [...FACTORS, asked];
  return (
    <label class="field" for="factor">
      <span>Factor wanted</span>
      <select
        id="factor"
        value={String(asked ?? 1)}
        onChange={({ currentTarget }) => {
          void ask(app, { type: 'set_factor', simulator, factor: Number(currentTarget.value) });
        }}
      >
        {offered.map((value) => (
          <option key={value} value={String(value)}>
            {value === 0 ? 'as fast as possible' : `${value}×`}
          </option>
        ))}
      </select>
    </label>
  );
}

function Steps({ app, simulator }: SimulatorProps) {
  const steps = useSignal(10);
  return (
    <div class="field">
      <label for="steps">Steps</label>
      <span class="join">
        <input
          type="number"
          id="steps"
          min={1}
          max={10000}
          value={steps.value}
          onInput={({ currentTarget }) => (steps.value = currentTarget.valueAsNumber || 1)}
        />
        <Button
          text="Step"
          icon="step"
          onClick={() => void ask(app, { type: 'step', simulator, steps: steps.value })}
        />
      </span>
    </div>
  );
}

type WorldProps = SimulatorProps & { world: string; worlds: readonly string[] };

/** Another world around the robots that are there; they begin where they were spawned. */
function WorldChoice({ app, simulator, world, worlds }: WorldProps) {
  const isLoading = useSignal(false);
  const load = async (name: string): Promise<void> => {
    isLoading.value = true;
    await ask(app, { type: 'load_world', simulator, name });
    isLoading.value = false;
  };
  return (
    <label class="field wide">
      <span>World</span>
      <select
        id="world"
        value={world}
        disabled={isLoading.value}
        aria-busy={isLoading.value}
        onChange={({ currentTarget }) => void load(currentTarget.value)}
      >
        {(worlds.includes(world) ? worlds : [world, ...worlds]).map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

function Entity({ app, simulator, name }: SimulatorProps & { name: string }) {
  return (
    <li>
      <span class="grow">{name}</span>
      <Button
        text="Reset"
        kind="quiet"
        title={`Put ${name} back to where it was spawned`}
        onClick={() => void ask(app, { type: 'reset_entity', simulator, name })}
      />
      <Confirmed
        text="Delete"
        question="Really delete?"
        title={`Take ${name} out of the world`}
        onSure={() => void ask(app, { type: 'delete', simulator, name })}
      />
    </li>
  );
}
