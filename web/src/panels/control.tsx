// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What runs in the controller manager: controllers, each with a switch, and the hardware. */
import { useSignal } from '@preact/signals';
import { ask, type App, type Panel } from '../app';
import type { Controllers } from '../protocol';
import { Chip, Empty, Section, Switch } from '../ui';
import { panelOf, type PanelProps } from './component';

type Controller = Controllers['controllers'][number];
type Hardware = Controllers['hardware'][number];

export function controlPanel(app: App): Panel {
  return panelOf(app, { id: 'control', title: 'Control' }, Control);
}

function Control({ app }: PanelProps) {
  const { robot, controllers } = app.store;
  const here = robot === null ? undefined : controllers.get(robot.id);
  if (robot === null || here === undefined) {
    return <Empty>No controller manager runs for this robot.</Empty>;
  }
  return (
    <>
      <Section title="Controllers">
        {here.controllers.length === 0 && <Empty>None.</Empty>}
        <ul class="rows">
          {here.controllers.map((one) => (
            <ControllerRow key={`${robot.id} ${one.name}`} app={app} robot={robot.id} {...one} />
          ))}
        </ul>
      </Section>
      <Section title="Hardware">
        {here.hardware.length === 0 && <Empty>None.</Empty>}
        <ul class="rows">
          {here.hardware.map((one) => (
            <HardwareRow key={one.name} {...one} />
          ))}
        </ul>
      </Section>
    </>
  );
}

type RowProps = Controller & { app: App; robot: string };

function ControllerRow({ app, robot, name, kind, state, claims }: RowProps) {
  const busy = useSignal(false);
  const active = state === 'active';
  const flip = async (activate: boolean): Promise<void> => {
    busy.value = true;
    await ask(app, {
      type: 'switch',
      robot,
      activate: activate ? [name] : [],
      deactivate: activate ? [] : [name],
    });
    busy.value = false; // its new state comes by itself, in a message to every page
  };
  return (
    <li class="unit">
      <span class="unit-name">{name}</span>
      <StateChip state={state} />
      <Switch
        on={active}
        label={`${name} is active`}
        title={active ? `Deactivate ${name}` : `Activate ${name}`}
        disabled={!active && state !== 'inactive'}
        busy={busy.value}
        onFlip={(on) => void flip(on)}
      />
      <span class="fine">{kind}</span>
      <span class="fine">
        {claims.length === 0 ? 'claims nothing' : `claims ${claims.join(', ')}`}
      </span>
    </li>
  );
}

function HardwareRow({ name, kind, state }: Hardware) {
  return (
    <li class="unit">
      <span class="unit-name">{name}</span>
      <StateChip state={state} />
      <span class="fine">{kind}</span>
    </li>
  );
}

function StateChip({ state }: { state: string }) {
  const tone = state === 'active' ? 'good' : state === 'inactive' ? 'calm' : 'warning';
  return <Chip tone={tone}>{state}</Chip>;
}
