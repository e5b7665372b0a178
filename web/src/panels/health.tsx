// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** How it goes: what the doctor finds, diagnostics, the wheels on the ground, what the node had to say. */
import { useLayoutEffect, useRef } from 'preact/hooks';
import type { App, Panel } from '../app';
import { commands } from '../commands';
import { fixed } from '../format';
import type { DiagnosticItem, FindingInfo } from '../protocol';
import { robotOf, wheelsOf, type WheelReading } from '../readings';
import type { NoticeEntry, Store } from '../store';
import { Button, Chip, Section, Table } from '../ui';
import { panelOf, type PanelProps } from './component';

type Level = DiagnosticItem['level'] | 'note';

const ORDER: Level[] = ['error', 'stale', 'warn', 'note', 'ok'];
const TONES = { error: 'error', stale: 'warning', warn: 'warning', note: 'calm', ok: 'good' } as const;
const LATE = /^(High \w+ jitter or mean error|Controller Manager has bad periodicity) :/; // ros2_control's words
const UNEVEN =
  'The control loop takes uneven time on this computer, as is common without real-time scheduling. ' +
  'In simulation nothing is lost by it: simulated time waits.';
const WHEEL_COLUMNS = ['Wheel', 'rad/s', 'Load, N', 'Slip along', 'across'];

export function healthPanel(app: App): Panel {
  return panelOf(app, { id: 'health', title: 'Health', watches: ['wheels', 'findings'] }, HealthPanel);
}

/**
 * How many diagnostics of the shown robot are not well, and errors the doctor finds in the graph;
 * and what they are at the worst.
 */
export function healthToLookAt(store: Store): { count: number; tone: 'warning' | 'error' } {
  const errors = (store.findings?.items ?? []).filter(({ severity }) => severity === 'error').length;
  const levels = itemsOf(store).map(({ level }) => level);
  const count = levels.filter((level) => level !== 'ok' && level !== 'note').length;
  return { count: count + errors, tone: errors > 0 || levels.includes('error') ? 'error' : 'warning' };
}

function HealthPanel({ app, state }: PanelProps) {
  return (
    <>
      <Section title="Findings">
        <Findings store={app.store} />
      </Section>
      <Section title="Diagnostics">
        <Diagnostics store={app.store} />
      </Section>
      <Wheels app={app} state={state} />
      <Section title="Notices">
        <Notices store={app.store} />
      </Section>
    </>
  );
}

/** What `ros2 doctor` says of the graph, each with what mends it. */
function Findings({ store }: { store: Store }) {
  const { findings } = store;
  if (findings === null) {
    return <p class="empty">Examining …</p>;
  }
  if (findings.items.length === 0) {
    return <p class="empty">Nothing is wrong with nodes, topics, time, frames, controllers and sensors.</p>;
  }
  return (
    <ul class="rows doctor">
      {findings.items.map((finding) => (
        <FindingRow key={`${finding.rule} ${finding.what}`} {...finding} />
      ))}
    </ul>
  );
}

function FindingRow({ severity, rule, what, why, fix }: FindingInfo) {
  return (
    <li class="unit">
      <span class="unit-name" title={`docs/api/doctor.md#${rule}`}>
        {what}
      </span>
      <Chip tone={severity}>{severity}</Chip>
      <span class="fine">{why}</span>
      <Fix text={fix} />
    </li>
  );
}

/** What mends it, each command in it with a button that copies it. */
function Fix({ text }: { text: string }) {
  const place = useRef<HTMLSpanElement>(null);
  useLayoutEffect(() => place.current?.replaceChildren(...commands(text)), [text]);
  return <span class="fix" ref={place} />;
}

interface Item {
  level: Level;
  name: string;
  message: string;
}

/**
 * The diagnostics of the shown robot. In a simulation it is no fault of the robot that a loop is
 * late: a note in place of the alarm that it is on a machine.
 */
function itemsOf(store: Store): readonly Item[] {
  const { robot, diagnostics } = store;
  const simulated = robot !== null && (robot.entity ?? robot.truth) !== null;
  const items = robot === null ? [] : (diagnostics.get(robot.id)?.items ?? []);
  return items.map((item) => {
    const problems = item.message.split(';').map((problem) => problem.trim());
    const isNote = item.level !== 'ok' && simulated && problems.every((problem) => LATE.test(problem));
    return isNote ? { ...item, level: 'note', message: `${UNEVEN} (${problems.join('; ')})` } : item;
  });
}

/** One item for those that say the same. */
function joined(items: readonly Item[]): Item[] {
  const found = new Map<string, Item>();
  for (const item of items) {
    const key = item.level === 'ok' || item.message === '' ? item.name : `${item.level} ${item.message}`;
    const first = found.get(key);
    found.set(key, first === undefined ? item : { ...first, name: `${first.name}, ${item.name}` });
  }
  return [...found.values()];
}

/**
 * The worst first. The rows stay the same elements while their statuses come anew, so that a text
 * that is being selected stays so.
 */
function Diagnostics({ store }: { store: Store }) {
  const items = joined(itemsOf(store)).sort(
    (one, other) => ORDER.indexOf(one.level) - ORDER.indexOf(other.level),
  );
  return (
    <ul class="rows">
      {items.length === 0 && <li class="empty">Nobody publishes /diagnostics.</li>}
      {items.map(({ level, name, message }) => (
        <li key={name} class="unit">
          <span class="unit-name">{name}</span>
          <Chip tone={TONES[level]}>{level}</Chip>
          <span class="fine">{message}</span>
        </li>
      ))}
    </ul>
  );
}

function Wheels({ app, state }: PanelProps) {
  const now = state.value;
  const robot = now === null ? null : robotOf(now, app.store.robot?.id);
  const wheels = now === null || robot === null ? [] : wheelsOf(now, robot);
  if (wheels.length === 0) {
    return null;
  }
  const columns = WHEEL_COLUMNS.map((name, index) => ({ name, number: index > 0 }));
  return (
    <Section title="Wheels on the ground">
      <Table caption="Contact and slip of each wheel" columns={columns}>
        {wheels.map((wheel) => (
          <WheelRow key={wheel.name} {...wheel} />
        ))}
      </Table>
      <p class="fine">Slip in m/s: along the rolling direction and across it.</p>
    </Section>
  );
}

function WheelRow({ name, speed, contact, force, along, across }: WheelReading) {
  const short = name.replace(/^joint_/, '').replace(/_joint$/, '').replace(/^wheel_/, '');
  const word = contact === null ? 'unknown' : contact ? 'on the ground' : 'in the air';
  const texts = [fixed(speed, 2), fixed(force, 1), fixed(along, 3), fixed(across, 3)];
  return (
    <tr>
      <th scope="row" title={name}>
        <i class={contact === true ? 'lamp on' : 'lamp'} title={word} />
        {short}
      </th>
      {texts.map((text, index) => (
        <td key={WHEEL_COLUMNS[index + 1]} class="number">
          {text}
        </td>
      ))}
    </tr>
  );
}

function Notices({ store }: { store: Store }) {
  const { notices } = store;
  return (
    <>
      <ul class="rows notices">
        {notices.length === 0 && <li class="empty">None.</li>}
        {notices.map((notice) => (
          <NoticeRow key={notice.number} {...notice} />
        ))}
      </ul>
      {notices.length > 0 && <Button text="Clear" onClick={() => store.clearNotices()} />}
    </>
  );
}

function NoticeRow({ level, text, count, at }: NoticeEntry) {
  return (
    <li data-tone={level}>
      <time class="fine">{at.toLocaleTimeString('en-GB')}</time>
      <span class="grow">{count > 1 ? `${text} (${count} times)` : text}</span>
    </li>
  );
}
