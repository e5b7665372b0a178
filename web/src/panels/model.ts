// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the robot is: its description in numbers, and what check_urdf has to say of it. */
import type { App, Panel } from '../app';
import { facts, h, section } from '../dom';
import type { Finding, Model } from '../protocol';
import { saveFile } from '../save';

const WORDS = { error: 'Error', warning: 'Warning', note: 'Note' } as const;

export class ModelPanel implements Panel {
  readonly id = 'model';
  readonly title = 'Model';
  readonly element = h('div', {});

  constructor(private readonly app: App) {
    app.store.watch(['model', 'graph', 'robot'], () => this.show());
  }

  /** The number of findings that are errors or warnings. */
  get toLookAt(): number {
    const findings = this.app.store.model?.findings ?? [];
    return findings.filter(({ level }) => level !== 'note').length;
  }

  private show(): void {
    const { store } = this.app;
    const { model, robot } = store;
    if (robot === null || model === null) {
      this.element.replaceChildren(
        h('p', { class: 'empty' }, store.graph?.hint ?? 'No robot description yet.'),
      );
      return;
    }
    const topics: [string, string | null][] = [
      ['Command', robot.command?.topic ?? null],
      ['Odometry', robot.odometry],
      ['Truth', robot.truth],
      ['Joint states', robot.joint_states],
      ['Wheels', robot.wheels],
      ['Controller manager', robot.manager],
    ];
    this.element.replaceChildren(
      section('Description', facts(summary(model, robot.name, robot.id))),
      section('Findings of check_urdf', findings(model.findings)),
      section(
        'In the ROS graph',
        facts(topics.map(([name, topic]) => [name, topic ?? 'nobody publishes it'])),
      ),
      section('URDF', download(model, robot.name)),
    );
  }
}

function summary(model: Model, name: string, id: string): [string, string][] {
  const document = new DOMParser().parseFromString(model.urdf, 'text/xml');
  const links = [...document.querySelectorAll('robot > link')];
  const joints = [...document.querySelectorAll('robot > joint')];
  const masses = links.map((link) =>
    Number(link.querySelector('inertial > mass')?.getAttribute('value') ?? 0),
  );
  const mass = masses.reduce((sum, one) => sum + one, 0);
  return [
    ['Name', name],
    ['Namespace', id],
    ['Root link', model.root],
    ['Links', String(links.length)],
    ['Joints', `${joints.length}, of which ${model.joints.length} move`],
    ['Mass', `${Number(mass.toFixed(3))} kg`],
  ];
}

function findings(list: readonly Finding[]): HTMLElement {
  if (list.length === 0) {
    return h('p', { class: 'verdict', 'data-tone': 'good' }, 'No errors, no warnings.');
  }
  const items = list.map(({ level, line, text, remedy }) =>
    h(
      'li',
      { 'data-tone': level },
      h('p', {}, h('b', {}, line === null ? WORDS[level] : `${WORDS[level]}, line ${line}`)),
      h('p', {}, text),
      remedy === '' ? null : h('p', { class: 'fine' }, remedy),
    ),
  );
  return h('ul', { class: 'findings' }, ...items);
}

function download(model: Model, name: string): HTMLElement {
  const save = h('button', { type: 'button', class: 'button quiet' }, 'Save the URDF');
  save.addEventListener('click', () => {
    saveFile(`${name}.urdf`, new Blob([model.urdf], { type: 'application/xml' }));
  });
  return h(
    'details',
    { class: 'source' },
    h('summary', {}, `${model.urdf.split('\n').length} lines`),
    h('pre', { tabindex: 0 }, model.urdf),
    save,
  );
}
