// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What one does with the plots: the window of time, pause, a field to add, what one saves. */
import { useSignal, useSignalEffect, type ReadonlySignal, type Signal } from '@preact/signals';
import type { VNode } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { Button } from '../ui';
import type { Offers } from './offers';
import { SPAN } from './series';

export const WINDOWS = [10, 30, 60, 120, SPAN]; // s

interface ToolsPort {
  window: number; // s
  heldAt: ReadonlySignal<string | null>; // the time that is held, in words
  target: Signal<{ id: number; name: string } | null>; // the chart that a field is searched for
  offers: Pick<Offers, 'look' | 'of'>;
  search: (on: boolean) => void; // somebody is about to
  setWindow: (seconds: number) => void;
  pause: (on: boolean) => void;
  add: (text: string) => boolean; // whether the text is a field
  reset: () => void;
  csv: () => void;
  png: () => void;
  link: () => void;
}

export function toolsOf(port: ToolsPort): VNode {
  return <Tools {...port} />;
}

function Tools(port: ToolsPort) {
  const { heldAt } = port;
  const held = heldAt.value;
  return (
    <>
      <h2>Plots</h2>
      <select
        class="window-of-time"
        aria-label="Window of time"
        onChange={(event) => port.setWindow(Number(event.currentTarget.value))}
      >
        {WINDOWS.map((seconds) => (
          <option key={seconds} value={seconds} selected={seconds === port.window}>
            {seconds < 60 ? `${seconds} s` : `${seconds / 60} min`}
          </option>
        ))}
      </select>
      <button
        type="button"
        class="toggle"
        aria-pressed={held !== null}
        title={held === null ? 'Hold the plots; recording goes on' : `Held: ${held}. Press to follow`}
        onClick={() => port.pause(held === null)}
      >
        Pause
      </button>
      <Search {...port} />
      <span class="grow" />
      <Menu {...port} />
    </>
  );
}

/** A field by its name; those that there are are offered. */
function Search({ target, offers, search, add }: ToolsPort) {
  const text = useSignal('');
  const input = useRef<HTMLInputElement>(null);
  const to = target.value;
  useEffect(() => {
    if (to !== null) {
      input.current?.focus();
    }
  }, [to]);
  useSignalEffect(() => offers.look(text.value));
  const submit = (event: Event): void => {
    event.preventDefault();
    const isField = add(text.value);
    input.current?.setCustomValidity(
      isField ? '' : 'A topic and a field of it, such as /odom twist.twist.linear.x',
    );
    if (isField) {
      text.value = '';
    } else {
      input.current?.reportValidity();
    }
  };
  return (
    <form class="plot-search" onSubmit={submit}>
      <input
        ref={input}
        type="text"
        list="plot-fields"
        autocomplete="off"
        spellcheck={false}
        aria-label={to === null ? 'Plot a field in a new chart' : `Plot a field in ${to.name}`}
        placeholder={to === null ? 'Plot: /topic field' : `To ${to.name}: /topic field`}
        value={text.value}
        onInput={(event) => {
          event.currentTarget.setCustomValidity('');
          text.value = event.currentTarget.value;
        }}
        onFocus={() => search(true)}
        onBlur={() => {
          search(false);
          if (text.value === '') {
            target.value = null;
          }
        }}
      />
      <datalist id="plot-fields">
        {offers.of(text.value).map((name) => (
          <option key={name}>{name}</option>
        ))}
      </datalist>
    </form>
  );
}

function Menu({ csv, png, link, reset }: ToolsPort) {
  const menu = useRef<HTMLDetailsElement>(null);
  const close = (): void => {
    if (menu.current !== null) {
      menu.current.open = false;
    }
  };
  const item = (text: string, title: string, act: () => void) => (
    <Button
      text={text}
      title={title}
      kind="quiet"
      onClick={() => {
        close();
        act();
      }}
    />
  );
  return (
    <details
      ref={menu}
      class="menu"
      onFocusOut={(event) => {
        if (!event.currentTarget.contains(event.relatedTarget as Node | null)) {
          close();
        }
      }}
    >
      <summary class="button quiet">Save</summary>
      <div class="menu-items">
        {item('CSV', 'Save what is seen as comma-separated values', csv)}
        {item('PNG', 'Save what is seen as an image', png)}
        {item('Copy link', 'Copy the address of these plots', link)}
        {item('Default charts', 'Show the charts of the robot alone', reset)}
      </div>
    </details>
  );
}
