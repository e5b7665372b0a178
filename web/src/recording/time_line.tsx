// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The time line of a recording: where it is, play and pause, how fast. */
import { render } from 'preact';
import { ask, type App } from '../app';
import { h, takesKey } from '../dom';
import { Button } from '../ui';
import { RATES, Scrubber } from './scrubber';

const STEP = 0.01; // s

/** The time line; empty where the page shows no recording. Listens for its keys on all of the page. */
export function timeLine(app: App): HTMLElement {
  const { store } = app;
  const scrubber = new Scrubber(
    (asked) => ask(app, asked),
    () => store.recording?.length ?? 0,
    () => store.playhead,
  );
  const element = h('section', { class: 'time-line', 'aria-label': 'Time line', hidden: true });
  render(<TimeLine app={app} scrubber={scrubber} />, element);
  store.watch(['recording'], () => {
    element.hidden = store.recording === null;
    document.body.classList.toggle('recorded', store.recording !== null);
  });
  window.addEventListener('keydown', (event) => {
    const { ctrlKey, metaKey, altKey, shiftKey, key } = event;
    if (store.recording === null || ctrlKey || metaKey || altKey || isOthers(event)) {
      return;
    }
    if (scrubber.press(key, shiftKey)) {
      event.preventDefault(); // arrows would scroll a panel, or move the slider by its own step
      event.stopPropagation(); // Home would turn the camera, too
    }
  }, { capture: true });
  return element;
}

/** Whether a key is for what has the focus: text, tabs, a chart, the view, or a button that Space presses. */
function isOthers({ target, code, key, shiftKey }: KeyboardEvent): boolean {
  if (!(target instanceof HTMLElement) || target.closest('.time-line input') !== null) {
    return false;
  }
  const pressable = 'button:focus-visible, a:focus-visible, summary:focus-visible';
  const isPressed = key === ' ' && target.matches(pressable);
  if (target.matches('canvas.scene')) {
    return shiftKey || '+=-'.includes(key); // with these the camera turns and zooms
  }
  const ofItsOwn = target.matches('canvas, [role=tab], [role=tabpanel]') && key !== ' ';
  return isPressed || ofItsOwn || takesKey(target, code) || target.matches('.chart-plot');
}

function TimeLine({ app, scrubber }: { app: App; scrubber: Scrubber }) {
  const { recording, playhead } = app.store;
  if (recording === null) {
    return null;
  }
  const { length, name, path } = recording;
  const { place = 0, playing = false, rate = 1 } = playhead ?? {};
  const word = playing ? 'Pause' : 'Play';
  const rates = RATES.includes(rate) ? RATES : [...RATES, rate];
  return (
    <>
      <Button icon={playing ? 'pause' : 'play'} title={`${word} (Space)`} onClick={() => scrubber.playOrPause()} />
      <span class="time-line-name" title={path}>
        {name}
      </span>
      <input
        type="range"
        min={0}
        max={length}
        step={STEP}
        value={place}
        aria-label="Time of the recording"
        aria-valuetext={`${place.toFixed(1)} of ${length.toFixed(1)} seconds`}
        title="Left and right: 1 s, with Shift 0.1 s; Home and End"
        onInput={({ currentTarget }) => scrubber.move(Number(currentTarget.value))}
      />
      <output class="time-line-place">{`${place.toFixed(2)} / ${length.toFixed(1)} s`}</output>
      <select
        aria-label="Rate"
        title="How fast it is played (up and down)"
        onChange={({ currentTarget }) => scrubber.setRate(Number(currentTarget.value))}
      >
        {rates.map((each) => (
          <option key={each} value={each} selected={each === rate}>
            {`${each}×`}
          </option>
        ))}
      </select>
    </>
  );
}
