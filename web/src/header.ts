// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The line on top: which robot, how the connection stands, the simulator's clock and its keys. */
import { ask, type App } from './app';
import { button, h, icon, setText } from './dom';
import { recordButton } from './recording/record_button';
import { ageText } from './freshness';
import { clock, factor, robotName, UNKNOWN } from './format';
import type { State } from './state';

const LINKS = {
  connecting: 'Connecting …',
  open: 'Connected',
  waiting: 'Reconnecting …',
} as const;
const TONES = { connecting: 'warning', open: 'good', waiting: 'error' } as const;

export class Header {
  readonly element: HTMLElement;
  private wasOld = false;
  private readonly link = h('span', { class: 'chip link' });
  private readonly robots = h('select', { 'aria-label': 'Robot' });
  private readonly name = h('span', { class: 'robot-name' });
  private readonly transport: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly time = h('span', { class: 'time', title: 'Time of the simulation since its start or reset, min:s' }, UNKNOWN);
  private readonly real = h('span', { class: 'factor', title: 'Real-time factor: seconds of the simulation in one of yours' }, UNKNOWN);
  private readonly domain = h('span', { class: 'fine domain' });

  constructor(
    private readonly app: App,
    actions: { flipTheme: () => void; openPanels: () => void; reset: () => void },
  ) {
    this.play = button('', () => this.playOrPause(), { title: 'Pause' });
    this.play.classList.add('play');
    const step = button('', () => this.simulate('step'), { icon: 'step', title: 'One step' });
    step.classList.add('step');
    const reset = button('', () => this.simulate('reset_simulation'), {
      icon: 'reset',
      title: 'Reset: robots to their starts, time to 0',
    });
    reset.classList.add('reset');
    this.transport = h(
      'div',
      { class: 'transport', role: 'group', 'aria-label': 'Simulation' },
      this.play,
      step,
      reset,
    );
    this.robots.addEventListener('change', () => app.store.choose(this.robots.value));
    const theme = button('', actions.flipTheme, { icon: 'theme', title: 'Light or dark' });
    const layout = button('', actions.reset, { icon: 'layout', title: 'Layout as at first' });
    layout.classList.add('reset-layout');
    const panels = button('Panels', actions.openPanels, { icon: 'panels', title: 'Panels' });
    panels.classList.add('open-panels');
    panels.setAttribute('aria-label', 'Panels'); // on a narrow page only the icon is seen
    this.element = h(
      'header',
      { class: 'top' },
      h('img', { class: 'mark', src: 'icon.svg', alt: '' }),
      h('h1', {}, this.name, this.robots),
      this.link,
      this.domain,
      h('span', { class: 'grow' }),
      this.transport,
      recordButton(app),
      h('div', { class: 'clock' }, this.time, this.real),
      h('span', { class: 'grow' }),
      layout,
      theme,
      panels,
    );
    const { store } = app;
    store.watch(['graph', 'robot'], () => this.showRobots());
    store.watch(['link', 'hello', 'silence', 'recording'], () => this.showLink());
    store.watch(['simulation', 'graph', 'silence'], () => this.showSimulation());
  }

  pulse(state: State): void {
    setText(this.time, clock(state.time));
  }

  private showRobots(): void {
    const { robots, robot } = this.app.store;
    this.robots.hidden = robots.length < 2;
    this.name.hidden = robots.length >= 2;
    setText(this.name, robot === null ? 'No robot' : robotName(robot));
    this.robots.replaceChildren(
      ...robots.map((each) => h('option', { value: each.id }, robotName(each))),
    );
    this.robots.value = robot?.id ?? '';
    document.title = robot === null ? 'amr viewer' : `${robotName(robot)} · amr viewer`;
  }

  /** Say when nothing new comes; called ten times a second. */
  tick(now: number): void {
    const { store } = this.app;
    const isPaused = store.simulation !== null && store.simulation.state !== 'playing';
    const silence = store.freshness.silence(now) ?? 0;
    const age = silence > 0.5 || !isPaused ? store.freshness.stalenessOfAll(now) : null;
    // Twice in a row: where the page itself was busy, what has come is dealt with in between.
    const isOld = age !== null && this.wasOld;
    this.wasOld = age !== null;
    if (isOld !== document.body.classList.contains('stale')) {
      document.body.classList.toggle('stale', isOld);
    }
    const stale = isOld && store.link.state === 'open' ? `No data for ${ageText(age)}` : '';
    store.setSilence(stale);
  }

  private showLink(): void {
    const { link, hello, recording } = this.app.store;
    const isRecorded = link.state === 'open' && recording !== null;
    const word = isRecorded ? 'Bag' : LINKS[link.state];
    setText(this.link, this.app.store.silence === '' ? word : this.app.store.silence);
    this.link.dataset.tone = this.app.store.silence === '' ? TONES[link.state] : 'error';
    setText(this.domain, hello === null || isRecorded ? '' : `${hello.client} · domain ${hello.domain}`);
    this.domain.title = hello === null ? '' : `amr_description ${hello.version}`;
  }

  private showSimulation(): void {
    const { simulator, simulation } = this.app.store;
    this.transport.hidden = simulator === null;
    this.real.hidden = simulator === null;
    const paused = simulation !== null && simulation.state !== 'playing';
    const word = paused ? 'Play' : 'Pause';
    if (this.play.title !== word || this.play.childElementCount === 0) {
      this.play.replaceChildren(icon(paused ? 'play' : 'pause'));
      this.play.title = word;
      this.play.setAttribute('aria-label', word);
    }
    this.play.classList.toggle('primary', paused);
    const real = this.app.store.silence === '' ? (simulation?.real_factor ?? null) : null;
    setText(this.real, paused ? simulation.state : factor(real));
    this.real.classList.toggle('paused', paused);
  }

  private playOrPause(): void {
    const playing = this.app.store.simulation?.state === 'playing';
    this.simulate(playing ? 'pause' : 'play');
  }

  private simulate(type: 'play' | 'pause' | 'step' | 'reset_simulation'): void {
    const simulator = this.app.store.simulator?.id;
    if (simulator === undefined) {
      return;
    }
    void ask(this.app, type === 'step' ? { type, simulator, steps: 1 } : { type, simulator });
  }
}
