// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The elements that panels are made of; no style attributes, as the page's CSP forbids them. */
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { ICONS, type IconName } from './icons';

/** A drawing that says nothing to a screen reader: the button around it has the words. */
export function Icon({ name }: { name: IconName }) {
  return (
    <svg viewBox="0 0 16 16" class="icon" aria-hidden="true">
      <path d={ICONS[name]} />
    </svg>
  );
}

interface ButtonProps {
  text?: string;
  icon?: IconName;
  title?: string; // also what a screen reader says when there is no text
  kind?: 'primary' | 'quiet' | 'danger';
  disabled?: boolean;
  onClick: () => void;
}

export function Button({ text = '', icon, title, kind, disabled, onClick }: ButtonProps) {
  return (
    <button
      type="button"
      class={kind === undefined ? 'button' : `button ${kind}`}
      title={title}
      aria-label={text === '' ? title : undefined}
      disabled={disabled}
      onClick={onClick}
    >
      {icon !== undefined && <Icon name={icon} />}
      {text !== '' && <span>{text}</span>}
    </button>
  );
}

const DOUBT = 3000; // ms in which the second press counts

interface ConfirmedProps {
  text: string;
  question: string;
  title?: string;
  onSure: () => void;
}

/** A button for what cannot be taken back: it asks, and does it on the second press. */
export function Confirmed({ text, question, title, onSure }: ConfirmedProps) {
  const asked = useSignal(false);
  const timer = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => () => clearTimeout(timer.current), []);
  const press = (): void => {
    clearTimeout(timer.current);
    if (asked.value) {
      onSure();
    } else {
      timer.current = setTimeout(() => (asked.value = false), DOUBT);
    }
    asked.value = !asked.value;
  };
  return (
    <button type="button" class={asked.value ? 'button quiet danger' : 'button quiet'} title={title} onClick={press}>
      <span>{asked.value ? question : text}</span>
    </button>
  );
}

interface SwitchProps {
  on: boolean;
  label: string; // what it says of itself to a screen reader
  title?: string;
  disabled?: boolean;
  busy?: boolean;
  onFlip: (on: boolean) => void;
}

/** A switch with a knob. */
export function Switch({ on, label, title, disabled, busy, onFlip }: SwitchProps) {
  return (
    <button
      type="button"
      role="switch"
      class="switch"
      aria-checked={on}
      aria-label={label}
      aria-busy={busy === true}
      title={title}
      disabled={disabled === true || busy === true}
      onClick={() => onFlip(!on)}
    />
  );
}

/** A titled part of a panel. */
export function Section({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section class="section">
      <h3>{title}</h3>
      {children}
    </section>
  );
}

/** What stands where there is nothing: why, and what would do. */
export function Empty({ children }: { children: ComponentChildren }) {
  return <p class="empty">{children}</p>;
}

interface FactsProps {
  pairs: readonly (readonly [string, string])[];
  numbers?: boolean; // the values are, that change: of constant width
}

/** Names and values, as a description list. */
export function Facts({ pairs, numbers }: FactsProps) {
  return (
    <dl class={numbers === true ? 'facts numbers' : 'facts'}>
      {pairs.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd title={value}>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

export type Tone = 'good' | 'calm' | 'warning' | 'error';

/** A word on a coloured ground. */
export function Chip({ tone, title, children }: { tone?: Tone; title?: string; children: ComponentChildren }) {
  return (
    <span class="chip" data-tone={tone} title={title}>
      {children}
    </span>
  );
}

interface TableProps {
  caption: string; // for a screen reader
  columns: readonly { name: string; number?: boolean }[]; // numbers stand to the right
  children: ComponentChildren; // rows
}

export function Table({ caption, columns, children }: TableProps) {
  return (
    <div class="table">
      <table>
        <caption class="unseen">{caption}</caption>
        <thead>
          <tr>
            {columns.map(({ name, number }) => (
              <th key={name} scope="col" class={number === true ? 'number' : undefined}>
                {name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{children}</tbody>
      </table>
    </div>
  );
}
