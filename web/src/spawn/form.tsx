// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Another robot like the shown one: its name, and where it is to stand. */
import { untracked, useSignalEffect, type ReadonlySignal } from '@preact/signals';
import type { State } from '../state';
import type { Offer } from './offer';

interface SpawnProps {
  offer: Offer;
  state: ReadonlySignal<State | null>;
}

export function SpawnForm({ offer, state }: SpawnProps) {
  const { name, x, y, yaw, busy, isPointing, isTaken } = offer;
  useSignalEffect(() => {
    const latest = state.value;
    untracked(() => offer.follow(latest));
  });
  const submit = (event: Event): void => {
    event.preventDefault();
    void offer.spawn();
  };
  return (
    <form class="form spawn" onSubmit={submit} aria-busy={busy.value !== null}>
      <label class="field wide">
        <span>Name</span>
        <input
          type="text"
          name="name"
          required
          pattern="[A-Za-z]\w*"
          value={name.value}
          onInput={(event) => offer.rename(event.currentTarget.value)}
        />
      </label>
      <Coordinate name="x" label="x, m" value={x.value} onInput={(text) => offer.move({ x: text })} />
      <Coordinate name="y" label="y, m" value={y.value} onInput={(text) => offer.move({ y: text })} />
      <Coordinate name="yaw" label="Yaw, °" value={yaw.value} onInput={(text) => offer.move({ yaw: text })} />
      <button
        type="button"
        class="toggle"
        aria-pressed={isPointing.value}
        title="Click where it is to stand"
        onClick={() => offer.flipPointing()}
      >
        {isPointing.value ? 'Click in the view …' : 'Place by a click'}
      </button>
      <button type="submit" class="button primary" disabled={busy.value !== null}>
        {busy.value === null ? 'Spawn' : `Spawning ${busy.value} …`}
      </button>
      <output class="fine wide">
        {busy.value !== null && 'The simulator takes it in, then its controllers are started.'}
        {busy.value === null && isTaken.value && 'Something stands there.'}
      </output>
    </form>
  );
}

interface CoordinateProps {
  name: string;
  label: string;
  value: string;
  onInput: (text: string) => void;
}

function Coordinate({ name, label, value, onInput }: CoordinateProps) {
  return (
    <label class="field">
      <span>{label}</span>
      <input
        type="number"
        name={name}
        step="any"
        required
        value={value}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
    </label>
  );
}
