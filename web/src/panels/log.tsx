// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** /rosout: what nodes say, by level, node and words. */
import { useSignal } from '@preact/signals';
import type { App, Panel } from '../app';
import { clock } from '../format';
import type { LogLine } from '../protocol';
import { Button, Empty } from '../ui';
import { panelOf, type PanelProps } from './component';

const LEVELS = ['debug', 'info', 'warning', 'error', 'fatal'] as const;
const MOST = 300; // lines that are drawn

export function logPanel(app: App): Panel {
  return panelOf(app, { id: 'log', title: 'Log', watches: ['log'] }, Log);
}

function Log({ app }: PanelProps) {
  const level = useSignal<LogLine['level']>('info');
  const node = useSignal('');
  const text = useSignal('');
  const frozen = useSignal<readonly LogLine[] | null>(null);
  const all = frozen.value ?? app.store.log;
  const nodes = [...new Set(all.map((line) => line.node))].sort();
  const wanted = text.value.trim().toLowerCase();
  const shown = all.filter(
    (line) =>
      LEVELS.indexOf(line.level) >= LEVELS.indexOf(level.value) &&
      (node.value === '' || line.node === node.value) &&
      `${line.node} ${line.text}`.toLowerCase().includes(wanted),
  );
  return (
    <>
      <div class="tools wrap">
        <select
          aria-label="Least level"
          value={level.value}
          onChange={({ currentTarget }) => (level.value = currentTarget.value as LogLine['level'])}
        >
          {LEVELS.map((each) => (
            <option key={each} value={each}>
              {each}
            </option>
          ))}
        </select>
        <select
          aria-label="Node"
          value={node.value}
          onChange={({ currentTarget }) => (node.value = currentTarget.value)}
        >
          <option value="">all nodes</option>
          {nodes.map((each) => (
            <option key={each} value={each}>
              {each}
            </option>
          ))}
        </select>
        <input
          type="text"
          class="grow"
          placeholder="Search"
          aria-label="Search"
          value={text.value}
          onInput={({ currentTarget }) => (text.value = currentTarget.value)}
        />
        <Button
          text={frozen.value === null ? 'Pause' : 'Go on'}
          onClick={() => (frozen.value = frozen.value === null ? app.store.log : null)}
        />
      </div>
      {shown.length === 0 && (
        <Empty>
          {all.length === 0
            ? 'Nothing yet. Warnings and errors are kept from the time on when the first page was opened.'
            : 'No line is of this kind.'}
        </Empty>
      )}
      <ol class="log" aria-label="Log, the newest first">
        {shown
          .slice(-MOST)
          .sort((one, other) => other.number - one.number)
          .map((line) => (
            <li key={line.number} data-tone={line.level}>
              <span class="fine">
                {clock(line.stamp)} · {line.level} · {line.node}
              </span>
              <span class="words" title={line.place}>
                {line.text}
              </span>
            </li>
          ))}
      </ol>
      {shown.length > MOST && <p class="fine">{`${shown.length - MOST} older lines are not drawn.`}</p>}
    </>
  );
}
