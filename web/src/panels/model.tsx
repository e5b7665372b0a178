// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the robot is: its description in numbers, and what check_urdf has to say of it. */
import { useSignal, useSignalEffect, type Signal } from '@preact/signals';
import { useLayoutEffect, useMemo, useRef } from 'preact/hooks';
import type { App, Panel } from '../app';
import { commands } from '../commands';
import { fixed } from '../format';
import type { Finding, Model, RobotInfo } from '../protocol';
import { saveFile } from '../save';
import { isKnownPose } from '../state';
import type { Store } from '../store';
import { massOf } from '../scene/urdf';
import { Button, Facts, Section } from '../ui';
import { panelOf, type PanelProps } from './component';

const WORDS = { error: 'Error', warning: 'Warning', note: 'Note' } as const;

export function modelPanel(app: App): Panel {
  return panelOf(app, { id: 'model', title: 'Model' }, ModelPanel);
}

/** The number of findings that are errors or warnings, and what they are at the worst. */
export function findingsToLookAt({ model }: Store): { count: number; tone: 'warning' | 'error' } {
  const levels = (model?.findings ?? []).map(({ level }) => level);
  const count = levels.filter((level) => level !== 'note').length;
  return { count, tone: levels.includes('error') ? 'error' : 'warning' };
}

function ModelPanel({ app, state }: PanelProps) {
  const { model, robot, graph, recording } = app.store;
  const open = useSignal(false); // whichever robot: who reads one URDF wants to read the other
  const shown = useSignal<Shown | null>(null);
  if (robot === null || model === null) {
    return <Hint text={graph?.hint ?? 'No robot description yet.'} />;
  }
  return (
    <>
      <Section title="Description">
        <Summary model={model} robot={robot} />
      </Section>
      <Where robot={robot} state={state} />
      <Section title="Findings of check_urdf">
        <Findings list={model.findings} show={(line) => (shown.value = { line })} />
      </Section>
      <Section title={recording === null ? 'In the ROS graph' : 'In the recording'}>
        <Facts pairs={recording === null ? namesInGraph(robot) : namesInBag(robot)} />
      </Section>
      <Section title="URDF">
        <Source model={model} name={robot.name} open={open} shown={shown} />
      </Section>
    </>
  );
}

/** Where it is: as it truly is, where a simulator knows, and as its odometry has it. */
function Where({ robot, state }: { robot: RobotInfo } & Pick<PanelProps, 'state'>) {
  const motions = state.value?.robots.find(({ id }) => id === robot.id);
  const pairs: [string, string][] = [];
  for (const [name, motion] of [['By truth', motions?.truth], ['By odometry', motions?.odometry]] as const) {
    if (motion !== undefined && isKnownPose(motion)) {
      const [x = 0, y = 0, , qx = 0, qy = 0, qz = 0, qw = 1] = motion;
      const yaw = Math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
      pairs.push([name, `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m, ${fixed((180 / Math.PI) * yaw, 0)}°`]);
    }
  }
  return pairs.length === 0 ? null : (
    <Section title="Where it is">
      <Facts pairs={pairs} />
    </Section>
  );
}

/** Why there is nothing to be seen, and the command that starts something. */
function Hint({ text }: { text: string }) {
  const place = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => place.current?.replaceChildren(...commands(text)), [text]);
  return <p ref={place} class="empty" />;
}

/** Who subscribes, and which nodes there were, a bag does not say. */
function namesInBag(robot: RobotInfo): [string, string][] {
  const { odometry, truth, joint_states: joints, wheels } = robot;
  const pairs = [['Odometry', odometry], ['Truth', truth], ['Joint states', joints], ['Wheels', wheels]] as const;
  return pairs.map(([name, topic]) => [name, topic ?? 'not recorded']);
}

function namesInGraph(robot: RobotInfo): [string, string][] {
  const unpublished = 'nobody publishes it';
  return [
    ['Command', robot.command?.topic ?? 'nobody subscribes to one'],
    ['Odometry', robot.odometry ?? unpublished],
    ['Truth', robot.truth ?? unpublished],
    ['Joint states', robot.joint_states ?? unpublished],
    ['Wheels', robot.wheels ?? unpublished],
    ['Controller manager', robot.manager ?? 'none runs'],
  ];
}

function Summary({ model, robot }: { model: Model; robot: RobotInfo }) {
  const { links, joints, mass } = useMemo(() => counted(model.urdf), [model.urdf]);
  const pairs: [string, string][] = [
    ['Name', robot.name],
    ['Namespace', robot.id],
    ['Root link', model.root],
    ['Links', String(links)],
    ['Joints', `${joints}, of which ${model.joints.length} move`],
    ['Mass', `${Number(mass.toFixed(3))} kg`],
  ];
  return <Facts pairs={pairs} />;
}

/** The links and joints of a description, and its mass, kg. */
function counted(urdf: string): { links: number; joints: number; mass: number } {
  const document = new DOMParser().parseFromString(urdf, 'text/xml');
  return {
    links: document.querySelectorAll('robot > link').length,
    joints: document.querySelectorAll('robot > joint').length,
    mass: massOf(urdf),
  };
}

/** A line of the URDF that was asked for; each time it is a new one. */
interface Shown {
  line: number;
}

function Findings({ list, show }: { list: readonly Finding[]; show: (line: number) => void }) {
  if (list.length === 0) {
    return (
      <p class="verdict" data-tone="good">
        No errors, no warnings.
      </p>
    );
  }
  return (
    <ul class="findings">
      {list.map(({ level, line, at, text, remedy }) => (
        <li key={`${line} ${text}`} data-tone={level}>
          <p>
            <b>{line === null || at !== null ? WORDS[level] : `${WORDS[level]}, line ${line}`}</b>{' '}
            {at !== null && (
              <button type="button" class="in-text" title="Show it in the URDF" onClick={() => show(at)}>
                {`line ${line ?? at}`}
              </button>
            )}
          </p>
          <p>{text}</p>
          {remedy !== '' && <p class="fine">{remedy}</p>}
        </li>
      ))}
    </ul>
  );
}

interface SourceProps {
  model: Model;
  name: string;
  open: Signal<boolean>;
  shown: Signal<Shown | null>;
}

function Source({ model, name, open, shown }: SourceProps) {
  const text = useRef<HTMLPreElement>(null);
  useSignalEffect(() => {
    if (shown.value !== null && text.current !== null) {
      open.value = true;
      select(text.current, shown.value.line);
    }
  });
  const save = (): void => {
    saveFile(`${name}.urdf`, new Blob([model.urdf], { type: 'application/xml' }));
  };
  return (
    <details
      class="source"
      open={open.value}
      onToggle={(event) => (open.value = event.currentTarget.open)}
    >
      <summary>{`${model.urdf.split('\n').length} lines`}</summary>
      <pre ref={text} tabindex={0}>
        {model.urdf}
      </pre>
      <Button text="Save the URDF" kind="quiet" onClick={save} />
    </details>
  );
}

/** Select a line of a text, from 1 on, and bring it into view. */
function select(element: HTMLPreElement, line: number): void {
  element.closest('details')?.setAttribute('open', '');
  const node = element.firstChild;
  const lines = (node?.textContent ?? '').split('\n');
  if (node === null || line > lines.length) {
    return;
  }
  const start = lines.slice(0, line - 1).reduce((sum, each) => sum + each.length + 1, 0);
  const range = document.createRange();
  range.setStart(node, start);
  range.setEnd(node, start + lines[line - 1]!.length);
  const selection = document.getSelection();
  selection?.removeAllRanges();
  selection?.addRange(range);
  element.scrollTop = ((line - 1) / lines.length) * element.scrollHeight - element.clientHeight / 3;
  element.scrollIntoView({ block: 'nearest' });
  element.focus({ preventScroll: true });
}
