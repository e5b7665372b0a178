// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The positions of the joints, and a slider for each that can be moved: by joint_state_publisher,
 * or by an active controller that takes positions or trajectories.
 */
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import { useMemo, useRef } from 'preact/hooks';
import type { App, Panel } from '../app';
import { degrees, fixed, UNKNOWN } from '../format';
import { JointCommands } from '../joint_commands';
import type { JointInfo } from '../protocol';
import { jointsOf, robotOf, type JointReading } from '../readings';
import type { Store } from '../store';
import { Button, Empty } from '../ui';
import { panelOf, type PanelProps } from './component';

const MANY = 10; // joints, from which on they can be searched

type Readings = ReadonlySignal<ReadonlyMap<string, JointReading>>;

export function jointsPanel(app: App): Panel {
  return panelOf(app, { id: 'joints', title: 'Joints' }, JointsPanel);
}

function JointsPanel({ app, state }: PanelProps) {
  const { model, robot } = app.store;
  const readings = useComputed(() => {
    const now = state.value;
    const here = now === null ? null : robotOf(now, app.store.robot?.id);
    const found = now === null || here === null ? [] : jointsOf(now, here);
    return new Map(found.map((reading) => [reading.name, reading]));
  });
  const joints = model?.joints ?? [];
  if (robot === null || joints.length === 0) {
    return <Empty>No joint moves.</Empty>;
  }
  return <Joints key={robot.id} app={app} robot={robot.id} joints={joints} readings={readings} />;
}

interface JointsProps {
  app: App;
  robot: string;
  joints: readonly JointInfo[];
  readings: Readings;
}

function Joints({ app, robot, joints, readings }: JointsProps) {
  const commands = useMemo(() => new JointCommands(app, robot), [app, robot]);
  const search = useSignal('');
  const { movedJoints } = app.store;
  const isPublished = app.store.robot?.joint_publisher != null;
  const slides = ({ name, follows }: JointInfo): boolean =>
    isPublished ? follows === null : movedJoints.has(name);
  const wanted = search.value.trim().toLowerCase();
  const found = joints.filter(({ name }) => name.toLowerCase().includes(wanted));
  return (
    <>
      {isPublished ? (
        <Tools commands={commands} joints={joints.filter(({ follows }) => follows === null)} />
      ) : (
        <Watching store={app.store} />
      )}
      {joints.length >= MANY && (
        <input
          type="text"
          class="search"
          placeholder={`Search ${joints.length} joints`}
          aria-label="Search joints"
          value={search.value}
          onInput={({ currentTarget }) => (search.value = currentTarget.value)}
        />
      )}
      {found.length === 0 && <Empty>{`No joint has “${search.value}” in its name.`}</Empty>}
      {found.map((joint) =>
        slides(joint) ? (
          <SliderRow key={joint.name} joint={joint} readings={readings} commands={commands} />
        ) : (
          <Row key={joint.name} joint={joint} readings={readings} />
        ),
      )}
    </>
  );
}

/** Where positions come from, and who takes them. */
function Watching({ store: { robot, movedJoints } }: { store: Store }) {
  const source = robot?.joint_states ?? null;
  const measured = source === null ? 'Nobody publishes joint states.' : `Measured, from ${source}.`;
  const movers = [...new Set(movedJoints.values())].join(', ');
  const text =
    movers === ''
      ? 'No active controller takes positions, and no joint_state_publisher runs: no sliders.'
      : `Sliders command ${movers}: the robot moves.`;
  return <p class="fine">{`${measured} ${text}`}</p>;
}

function Tools({ commands, joints }: { commands: JointCommands; joints: readonly JointInfo[] }) {
  const all = (position: (joint: JointInfo) => number): void => {
    commands.move(Object.fromEntries(joints.map((joint) => [joint.name, position(joint)])));
  };
  return (
    <div class="tools">
      <Button
        text="Randomize"
        onClick={() => all(({ lower, upper }) => lower + Math.random() * (upper - lower))}
      />
      <Button text="Center" onClick={() => all(({ zero }) => zero)} />
    </div>
  );
}

interface RowProps {
  joint: JointInfo;
  readings: Readings;
}

function Row({ joint, readings }: RowProps) {
  return (
    <div class="joint" title={joint.follows === null ? '' : `follows ${joint.follows}`}>
      <Name joint={joint} />
      <Value joint={joint} readings={readings} />
      <Motion joint={joint} readings={readings} />
      <span class="fine limits">{range(joint)}</span>
    </div>
  );
}

function Name({ joint }: { joint: JointInfo }) {
  return (
    <span class="joint-name" title={`${joint.name}: ${joint.kind}, ${range(joint)}`}>
      {joint.name}
    </span>
  );
}

function Value({ joint, readings }: RowProps) {
  const reading = readings.value.get(joint.name);
  const text = reading === undefined ? UNKNOWN : `${fixed(reading.position, 3)} ${unitOf(joint)}`;
  return <span class="value">{text}</span>;
}

/** How it stands in degrees, how fast it goes, and how fast it is wanted to. */
function Motion({ joint, readings }: RowProps) {
  const reading = readings.value.get(joint.name);
  if (reading === undefined) {
    return <span class="fine">{UNKNOWN}</span>;
  }
  const { position, velocity, commanded } = reading;
  const turned = joint.kind === 'prismatic' ? [] : [degrees(position)];
  const moves = Number.isNaN(velocity) ? [] : [`${fixed(velocity, 2)} ${unitOf(joint)}/s`];
  const wanted = Number.isNaN(commanded) ? [] : [`commanded ${fixed(commanded, 2)}`];
  return <span class="fine">{[...turned, ...moves, ...wanted].join('  ')}</span>;
}

function SliderRow({ joint, readings, commands }: RowProps & { commands: JointCommands }) {
  return (
    <div class="joint slides">
      <Name joint={joint} />
      <Sliders joint={joint} readings={readings} commands={commands} />
      <Motion joint={joint} readings={readings} />
      <span class="fine limits">{range(joint)}</span>
    </div>
  );
}

function Sliders({ joint, readings, commands }: RowProps & { commands: JointCommands }) {
  const { name, lower, upper, zero } = joint;
  const slider = useRef<HTMLInputElement>(null);
  const typed = useSignal<string | null>(null); // in the field, that the focus is in
  const shown = useRef(zero);
  // A hand on the slider, or a value being typed, is not overruled by what comes back.
  const isHeld = typed.value !== null || slider.current?.matches(':active') === true;
  const measured = readings.value.get(name)?.position ?? Number.NaN;
  const put = commands.shown(name);
  if (put !== null) {
    shown.current = put;
  } else if (!isHeld && Number.isFinite(measured)) {
    shown.current = measured;
  }
  const enter = (text: string): void => {
    const value = Number.parseFloat(text);
    const position = Number.isNaN(value) ? zero : Math.min(upper, Math.max(lower, value));
    typed.value = plain(position);
    commands.move({ [name]: position });
  };
  return (
    <>
      <input
        type="number"
        min={lower}
        max={upper}
        step={0.01}
        aria-label={`${name}, value in ${unitOf(joint)}`}
        value={typed.value ?? plain(shown.current)}
        onFocus={({ currentTarget }) => (typed.value = currentTarget.value)}
        onInput={({ currentTarget }) => (typed.value = currentTarget.value)}
        onChange={({ currentTarget }) => enter(currentTarget.value)}
        onBlur={() => (typed.value = null)}
      />
      <input
        ref={slider}
        type="range"
        min={lower}
        max={upper}
        step="any"
        aria-label={`${name}, ${unitOf(joint)}`}
        value={String(shown.current)}
        onInput={({ currentTarget }) => commands.move({ [name]: currentTarget.valueAsNumber })}
      />
    </>
  );
}

function unitOf({ kind }: JointInfo): string {
  return kind === 'prismatic' ? 'm' : 'rad';
}

/** A position as a field of numbers takes it, without the minus of a zero. */
function plain(position: number): string {
  return position.toFixed(3).replace(/^-(0\.0*)$/, '$1');
}

/** The limits of a joint, with their unit; a continuous one has none. */
function range(joint: JointInfo): string {
  const digits = joint.kind === 'prismatic' ? 3 : 2;
  const limits = `${fixed(joint.lower, digits)} … ${fixed(joint.upper, digits)} ${unitOf(joint)}`;
  return joint.kind === 'continuous' ? 'no limits' : limits;
}
