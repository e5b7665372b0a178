// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The TF tree, the fixed frame, and where the chosen frame is. */
import { useMemo } from 'preact/hooks';
import type { App, Panel } from '../app';
import { degrees, fixed, UNKNOWN } from '../format';
import type { FrameInfo, Layout } from '../protocol';
import { WORLD } from '../scene/placement';
import type { Places, PoseNumbers } from '../scene/places';
import type { Store } from '../store';
import { Facts, Section } from '../ui';
import { panelOf, type PanelProps } from './component';
import { LinkSection } from './link';

/** `places`: where frames are, as the scene has it. */
export function framesPanel(app: App, places: Places): Panel {
  const Body = (props: PanelProps) => <Frames {...props} places={places} />;
  const panel = panelOf(app, { id: 'frames', title: 'Frames' }, Body);
  return {
    ...panel,
    pulse: (state) => {
      places.update(state);
      panel.pulse?.(state);
    },
  };
}

type FramesProps = PanelProps & { places: Places };

function Frames(props: FramesProps) {
  const { store } = props.app;
  return (
    <>
      <label class="field" for="fixed-frame">
        <span>Fixed frame</span>
        <FixedFrame {...props} />
      </label>
      <Section title="Tree">
        <World {...props} />
        <Tree store={store} />
      </Section>
      <Section title="Chosen frame">
        <Chosen {...props} />
      </Section>
      <LinkSection store={store} />
    </>
  );
}

function FixedFrame({ app: { store }, state, places }: FramesProps) {
  void state.value; // what follows is of the latest one
  const chosen = store.fixedFrame ?? '';
  const names = places.frames;
  const all = (chosen === '' || names.includes(chosen) ? names : [...names, chosen]).join('\n');
  const options = useMemo(
    () =>
      all.split('\n').map((name) => (
        <option key={name} value={name}>
          {name}
        </option>
      )),
    [all],
  );
  return (
    <select
      id="fixed-frame"
      value={chosen}
      onChange={(event) => store.setFixedFrame(event.currentTarget.value || null)}
    >
      <option value="">{`automatic: ${places.automatic}`}</option>
      {options}
    </select>
  );
}

/** Where `world` is, where it stands still and TF knows nothing of it. */
function World({ app: { store }, state, places }: FramesProps) {
  void state.value; // what follows is of the latest one
  const roots = rootsOf(store.layout?.frames ?? []);
  const isInTf = roots.includes(WORLD) || places.parentOf(WORLD) !== null;
  return isInTf || !places.frames.includes(WORLD) ? null : (
    <p class="fine">
      <b>world</b> is the simulator’s, by the true poses, and no frame of TF. In it, each tree lies where truth and
      odometry of its robot agreed first: what moves them apart is drift.
    </p>
  );
}

function Tree({ store }: { store: Store }) {
  const frames = store.layout?.frames ?? [];
  return (
    <ul class="tree" aria-label="TF tree">
      {frames.length === 0 && <li class="empty">Nobody publishes transforms.</li>}
      {rootsOf(frames).map((root) => (
        <Branch key={root} store={store} frame={root} frames={frames} />
      ))}
    </ul>
  );
}

interface BranchProps {
  store: Store;
  frame: string;
  frames: Layout['frames'];
}

function Branch({ store, frame, frames }: BranchProps) {
  const children = frames.filter(({ parent }) => parent === frame);
  const choose = (): void => store.select({ robot: store.robotOf(frame) ?? '/', frame });
  return (
    <li>
      <button
        type="button"
        class="frame"
        aria-pressed={store.selection?.frame === frame}
        onClick={choose}
      >
        {frame}
      </button>
      {children.length > 0 && (
        <ul>
          {children.map(({ name }) => (
            <Branch key={name} store={store} frame={name} frames={frames} />
          ))}
        </ul>
      )}
    </li>
  );
}

/** The frames that are nobody's child, in the order in which they are named. */
function rootsOf(frames: readonly FrameInfo[]): string[] {
  const children = new Set(frames.map(({ name }) => name));
  const parents = new Set(frames.map(({ parent }) => parent));
  return [...parents].filter((parent) => !children.has(parent));
}

function Chosen({ app: { store }, state, places }: FramesProps) {
  const frame = store.selection?.frame ?? null;
  if (frame === null) {
    return <p class="fine">Choose a frame here, or click a part of the robot.</p>;
  }
  void state.value; // what follows is of the latest one
  const targets = new Set([places.parentOf(frame) ?? UNKNOWN, places.fixedFrame]);
  return (
    <>
      <p class="chosen">{frame}</p>
      {[...targets].map((target) => (
        <Facts key={target} numbers pairs={words(target, places.poseIn(frame, target))} />
      ))}
    </>
  );
}

function words(target: string, pose: PoseNumbers | null): [string, string][] {
  const metres = pose?.position.map((value) => fixed(value, 3)) ?? [UNKNOWN];
  const angles = pose?.angles.map(degrees) ?? [UNKNOWN];
  const quaternion = pose?.quaternion.map((value) => fixed(value, 3)) ?? [UNKNOWN];
  return [
    ['Relative to', target],
    ['x y z, m', metres.join('  ')],
    ['roll pitch yaw', angles.join('  ')],
    ['quaternion x y z w', quaternion.join('  ')],
  ];
}
