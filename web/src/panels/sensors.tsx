// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The sensors of the robot: each with a switch, what it says, and the pictures of cameras. */
import { effect, type ReadonlySignal } from '@preact/signals';
import { useLayoutEffect, useRef } from 'preact/hooks';
import type { App, Panel } from '../app';
import { MOST_POINTS, type Picture, type SensorInfo } from '../protocol';
import type { Sample } from '../samples';
import { PictureCanvas } from '../sensors/canvas';
import { bounded, BOUNDS, COLOURINGS, settingsOf, type Colouring, type Look } from '../sensors/looks';
import type { Sensing } from '../sensors/sensing';
import { measured, timing } from '../sensors/words';
import { isMap } from '../scene/placement';
import type { State } from '../state';
import { Button, Chip, Switch } from '../ui';
import { panelOf, type PanelProps } from './component';

export interface SensorsPanel extends Panel {
  /** How many pictures were drawn, by topic. */
  readonly drawn: Record<string, number>;
}

type Canvases = Map<string, PictureCanvas>;

export function sensorsPanel(app: App, sensing: Sensing): SensorsPanel {
  const canvases: Canvases = new Map();
  const Body = ({ state }: PanelProps) => (
    <Sensors sensing={sensing} state={state} canvases={canvases} />
  );
  const topics = (): readonly string[] => sensing.shown.map(({ topic }) => topic);
  const panel = panelOf(app, { id: 'sensors', title: 'Sensors', topics }, Body);
  return Object.defineProperty(panel as SensorsPanel, 'drawn', {
    get: () => Object.fromEntries([...canvases].map(([topic, { counts }]) => [topic, counts.drawn])),
  });
}

interface SensorsProps {
  sensing: Sensing;
  state: ReadonlySignal<State | null>;
  canvases: Canvases;
}

function Sensors(props: SensorsProps) {
  const { here } = props.sensing;
  return (
    <>
      <ul class="rows sensors">
        {here.length === 0 && (
          <li class="empty">
            No sensor of this robot publishes: no scan, cloud, picture, range, contact, map, path or marker.
          </li>
        )}
        {here.map((info) => (
          <Sensor key={`${info.topic} ${info.message}`} info={info} {...props} />
        ))}
      </ul>
      <p class="fine">What is off is not subscribed: nobody has to measure it.</p>
    </>
  );
}

type SensorProps = SensorsProps & { info: SensorInfo };

function Sensor(props: SensorProps) {
  const { info, sensing } = props;
  const { topic, message } = info;
  const on = sensing.isOn(info);
  return (
    <li class="unit sensor">
      <span class="unit-name" title={`${topic} (${message})`}>
        {topic.replace(/\/compressed$/, '') /* the type says so */}
      </span>
      <Chip title={message}>{message.split('/').at(-1) ?? message}</Chip>
      <Switch
        on={on}
        label={`Show ${topic}`}
        title={on ? 'Hide it' : 'Show it'}
        onFlip={(wanted) => sensing.set(topic, wanted)}
      />
      <Words {...props} />
      {on && settingsOf(info.kind).length > 0 && <Display info={info} sensing={sensing} />}
      {info.kind === 'picture' && on && <Camera {...props} />}
    </li>
  );
}

/** How often it comes, and what it has measured. */
function Words({ info, sensing, state }: SensorProps) {
  const now = state.value;
  const sample = sensing.latest.get(info.topic);
  if (!sensing.isOn(info) || sample === undefined || now === null) {
    return <span class="fine">{sensing.isOn(info) ? 'nothing has come yet' : ''}</span>;
  }
  const isUnreadable = sample.head.type === 'unreadable';
  return (
    <>
      <span class="fine">{timing(sample, now.time)}</span>
      <span class="fine measured" data-tone={isUnreadable ? 'warning' : undefined}>
        {homeless(info, sample, now) ?? measured(sample, now.time)}
      </span>
      {sample.head.type === 'marks' && sample.head.faults.map((fault) => (
        <span key={fault} class="fine measured" data-tone="warning">
          {fault}
        </span>
      ))}
      {info.kind === 'cloud' && <Whole info={info} sensing={sensing} sample={sample} />}
    </>
  );
}

const NAMES: Readonly<Record<keyof Look, string>> = {
  size: 'Size, px', colouring: 'Colour', opacity: 'Opacity', decay: 'Stays, s', order: 'Order',
};
const COLOURING_NAMES: Readonly<Record<Colouring, string>> = {
  own: 'its own, or intensity', height: 'by height', plain: 'one colour',
};

/** How it is drawn, to be changed. */
function Display({ info, sensing: { looks } }: Pick<SensorProps, 'info' | 'sensing'>) {
  const { topic, kind } = info;
  const look = looks.of(info);
  const colourings = COLOURINGS.filter((each) => kind !== 'scan' || each !== 'own');
  return (
    <details class="display">
      <summary aria-label={`Display of ${topic}`}>{looks.isOwn(topic) ? 'Display (changed)' : 'Display'}</summary>
      <div class="tools wrap">
        {settingsOf(kind).map((name) => (
          <label key={name} class="fine" title={name === 'order' ? 'Those with more are drawn over those with less' : undefined}>
            {NAMES[name]}{' '}
            {name === 'colouring' ? (
              <select
                value={look.colouring}
                onChange={({ currentTarget }) => looks.set(topic, { colouring: currentTarget.value as Colouring })}
              >
                {colourings.map((each) => (
                  <option key={each} value={each}>
                    {COLOURING_NAMES[each]}
                  </option>
                ))}
              </select>
            ) : (
              <input
                type="number"
                min={BOUNDS[name][0]}
                max={BOUNDS[name][1]}
                step={name === 'opacity' ? 0.1 : 1}
                value={look[name]}
                onChange={({ currentTarget }) => {
                  const value = bounded(name, currentTarget.valueAsNumber) ?? look[name];
                  currentTarget.value = String(value);
                  looks.set(topic, { [name]: value });
                }}
              />
            )}
          </label>
        ))}
        {looks.isOwn(topic) && <Button text="As at first" kind="quiet" onClick={() => looks.set(topic, null)} />}
      </div>
    </details>
  );
}

/** Has all points of a cloud shown, where there are more than are shown at first. */
function Whole({ info, sensing, sample }: { info: SensorInfo; sensing: Sensing; sample: Sample }) {
  const isWhole = sensing.isWhole(info);
  if (!isWhole && (sample.head.type !== 'cloud' || sample.head.count <= MOST_POINTS)) {
    return null;
  }
  return (
    <button
      type="button"
      class="toggle"
      aria-pressed={isWhole}
      title="All points, twice a second at most; else an even part of them, ten times a second"
      onClick={() => sensing.setWhole(info.topic, !isWhole)}
    >
      All points
    </button>
  );
}

/** Why a sample is not in the scene; null: it is, or it need not be. */
function homeless({ kind, robot }: SensorInfo, { head }: Sample, { layout }: State): string | null {
  const isPlaced = kind === 'map' || kind === 'path'; // before there is a map in TF, too
  const isAtHome = (frame: string): boolean => frame === 'world' || (head.type === 'marks' && isMap(frame));
  if (kind === 'picture' || isPlaced || head.type === 'unreadable') {
    return null;
  }
  const frames = head.type === 'marks' ? [...head.batches, ...head.texts].map(({ frame }) => frame) : [head.origin.frame];
  const known = new Set(layout.frames.flatMap(({ name, parent }) => [name, parent]));
  const lost = frames.find((frame) => !known.has(frame) && !known.has(`${robot.slice(1)}/${frame}`) && !isAtHome(frame));
  return lost === undefined ? null : `its frame "${lost}" is not in TF, so that it has no place in the view`;
}

function Camera({ info: { topic }, sensing, state, canvases }: SensorProps) {
  const element = useRef<HTMLCanvasElement>(null);
  useLayoutEffect(() => {
    if (element.current === null) {
      return;
    }
    const canvas = new PictureCanvas(element.current);
    canvases.set(topic, canvas);
    const stop = effect(() => {
      void state.value; // with each it is looked for
      const sample = sensing.latest.get(topic);
      if (sample?.head.type === 'picture') {
        canvas.show(sample as Sample<Picture>);
      }
    });
    return () => {
      stop();
      canvases.delete(topic);
    };
  }, [topic, sensing, state, canvases]);
  return <canvas ref={element} class="camera" role="img" aria-label={`Picture of ${topic}`} hidden />;
}
