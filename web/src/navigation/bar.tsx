// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Over the view, where somebody navigates: the tools for goals and poses, and how the goal goes. */
import { render } from 'preact';
import { ask, type App } from '../app';
import { h } from '../dom';
import type { Navigator } from '../protocol';
import type { Scene } from '../scene/scene';
import { Button } from '../ui';
import type { Place, Point } from './gesture';
import { PoseTools, type Bench, type Tool } from './tool';
import { goalWords, mapFrameOf } from './words';

/** The bar; `scene`: null where there is none, and no tool. */
export function navigationBar(app: App, scene: Scene | null): HTMLElement {
  const element = h('div', { class: 'navigation-place' });
  const tools = scene === null ? null : new PoseTools(benchOf(app, scene));
  render(<NavigationBar app={app} tools={tools} />, element);
  if (scene !== null) {
    app.store.watch(['goal', 'robot', 'graph'], () => {
      const goals = app.store.robots.flatMap(({ id }) => app.store.goal(id) ?? []);
      scene.showGoals(goals.filter(({ state }) => state === 'active' || state === 'published'));
    });
    app.store.watch(['graph', 'robot', 'link'], () => {
      const { tool } = tools ?? { tool: null };
      if (tool !== null && !hears(app, tool)) {
        tools?.take(null);
      }
    });
  }
  return element;
}

/** Who navigates the chosen robot; null: nobody. */
function navigatorOf({ store }: App): Navigator | null {
  return store.graph?.navigators.find(({ robot }) => robot === store.robot?.id) ?? null;
}

function hears(app: App, tool: Tool): boolean {
  const navigator = navigatorOf(app);
  const isOpen = app.store.link.state === 'open';
  const ends = tool === 'goal' ? [navigator?.goal, navigator?.action] : [navigator?.initial_pose];
  return isOpen && ends.some((end) => typeof end === 'string');
}

function benchOf(app: App, scene: Scene): Bench {
  const { store } = app;
  const frame = (): string => mapFrameOf(store.layout, store.robot?.id ?? '/');
  return {
    canvas: scene.canvas,
    groundAt: (x, y) => scene.groundIn(frame(), x, y),
    yawAt: (tool, at) => {
      const robot = scene.placeIn(frame(), store.robot?.id ?? '/');
      return robot === null ? 0 : headingTo(tool, robot, at);
    },
    preview: (tool, place) => scene.showDraft(tool, place && { ...place, frame: frame() }),
    give: (tool, place) => {
      const robot = store.robot?.id;
      if (robot !== undefined) {
        const type = tool === 'goal' ? 'set_goal' : 'set_initial_pose';
        void ask(app, { type, robot, frame: frame(), ...place });
      }
    },
    canTake: (tool) => hears(app, tool),
    isDriven: () => store.isDriven,
  };
}

/** A goal looks the way the robot comes; a robot that is elsewhere still looks where it did. */
function headingTo(tool: Tool, robot: Place, at: Point): number {
  return tool === 'goal' ? Math.atan2(at.y - robot.y, at.x - robot.x) : robot.yaw;
}

interface BarProps {
  app: App;
  tools: PoseTools | null;
}

function NavigationBar({ app, tools }: BarProps) {
  const { store } = app;
  if (navigatorOf(app) === null) {
    return null;
  }
  return (
    <section class="navigation" aria-label="Navigation">
      {tools !== null && (
        <>
          <ToolButton app={app} tools={tools} tool="goal" text="Goal" keycap="G" />
          <ToolButton app={app} tools={tools} tool="pose" text="Initial pose" keycap="P" />
        </>
      )}
      {tools?.tool != null ? (
        <span class="fine">
          Press {tools.tool === 'goal' ? 'where it is to go' : 'where it is'}, drag to where it looks; Esc leaves
        </span>
      ) : (
        <Progress app={app} robot={store.robot?.id ?? '/'} />
      )}
    </section>
  );
}

function ToolButton({ app, tools, tool, text, keycap }: {
  app: App; tools: PoseTools; tool: Tool; text: string; keycap: string;
}) {
  if (!hears(app, tool)) {
    return null;
  }
  const what = tool === 'goal' ? 'Send the robot to a pose' : 'Say where the robot is';
  return (
    <button
      type="button"
      class="toggle"
      aria-pressed={tools.tool === tool}
      aria-keyshortcuts={keycap}
      title={`${what}: press there, drag to where it looks (${keycap})`}
      onClick={() => tools.take(tool)}
    >
      {text} <kbd aria-hidden="true">{keycap}</kbd>
    </button>
  );
}

/** How the goal goes: for whoever hears a screen, too. */
function Progress({ app, robot }: { app: App; robot: string }) {
  const goal = app.store.goal(robot);
  const words = goal && goalWords(goal);
  return (
    <>
      <output class="goal-words" data-tone={words?.tone}>
        {words?.text ?? ''}
      </output>
      {goal?.state === 'active' && (
        <Button
          text="Cancel"
          kind="quiet"
          title="Cancel the goal; the robot stops"
          onClick={() => void ask(app, { type: 'cancel_goal', robot })}
        />
      )}
    </>
  );
}
