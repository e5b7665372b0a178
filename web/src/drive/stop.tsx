// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** STOP, what becomes of it, and what releases it: there in every state of the page. */
import { render } from 'preact';
import { ask, type App } from '../app';
import { h } from '../dom';
import { Button } from '../ui';
import { deactivatable, stopWords, type Word } from './words';

/** The element with STOP. */
export function stopElement(app: App): HTMLElement {
  const element = h('div', { class: 'stop-place' });
  render(<StopPlace app={app} />, element);
  return element;
}

function StopPlace({ app }: { app: App }) {
  const { store, pilot, connection } = app;
  const lost = lostWords(app);
  const word = lost ?? stopWords(store);
  const held = store.isStopped;
  const moving = lost === null ? deactivatable(store) : null;
  // On the press, not on the release of a click: it is for when one is in a hurry.
  return (
    <>
      <div class={held ? 'stop-row held' : 'stop-row'}>
        <button
          type="button"
          class="stop"
          aria-keyshortcuts="Escape"
          title="Stop all robots, until they are released"
          onPointerDown={() => pilot.stop()}
          onClick={() => pilot.stop()}
        >
          <strong>{held ? 'STOPPED' : 'STOP'}</strong>
          <span class="keys" aria-hidden="true">
            <kbd>Space</kbd>
            <kbd>Esc</kbd>
          </span>
        </button>
        {held && (
          <button
            type="button"
            class="button release"
            title="Commands are taken again; who still holds a key must let go first"
            disabled={store.link.state !== 'open'}
            onClick={() => connection.send({ type: 'release', robot: null })}
          >
            <span>Release</span>
          </button>
        )}
      </div>
      <output class="stop-word" data-tone={word?.tone}>
        {word?.text ?? ''}
      </output>
      {moving !== null && (
        <Button
          kind="danger"
          text={`Deactivate ${moving.controllers.join(', ')}`}
          title="Through the controller manager, until the robot is released"
          onClick={() => void ask(app, { type: 'deactivate_drive', robot: moving.robot })}
        />
      )}
    </>
  );
}

/** Without a connection: that STOP cannot be sent, and what is known of why. */
function lostWords({ store }: App): Word | null {
  const { link } = store;
  if (link.state === 'open') {
    return null;
  }
  if (link.state === 'connecting' && store.hello === null) {
    return { tone: 'calm', text: 'Connecting …' };
  }
  const reason = link.state === 'waiting' && link.reason !== '' ? `: ${link.reason}` : '';
  const stop = 'STOP cannot reach it; pressed, it is sent as soon as it answers.';
  return { tone: 'error', text: `No connection to the node${reason}. ${stop}` };
}
