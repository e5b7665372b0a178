// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The name of another robot, and a place that is free, until others are written or pointed at. */
import { signal } from '@preact/signals';
import { ask, type App } from '../app';
import { freeName } from '../format';
import type { RobotInfo } from '../protocol';
import type { MarkedPlace } from '../scene/placing';
import type { State } from '../state';
import { freePlace, isFree, type Footprint, type Point } from './free_place';

const RADIUS = 0.5; // m, of a robot that nothing is known of
const EVERY = 4; // states, of ten a second
const PATIENCE = 40; // states, in which the places of robots come
const MARKED = 4000; // ms that a written place is marked in the scene

/** What the form needs of the scene. */
export interface Ground {
  footprints(): readonly Footprint[];
  radiusOf(robot: string): number | null;
  markPlace(place: MarkedPlace | null): void;
  askForPlace(pointed: ((x: number, y: number) => void) | null, chosen?: () => void): void;
  bringIntoView(robot: string): void;
}

/** What the form says, and where a robot would stand by it. */
export class Offer {
  readonly name = signal('');
  readonly x = signal('');
  readonly y = signal('');
  readonly yaw = signal('0');
  readonly busy = signal<string | null>(null); // the name of the robot that is being spawned
  readonly isPointing = signal(false);
  readonly isTaken = signal(false);
  private isNamed = false; // by hand
  private isPlaced = false;
  private hasSeen = false;
  private state: State | null = null;
  private count = 0;
  private marking: ReturnType<typeof setTimeout> | undefined;

  /** `ground`: null where nothing can be drawn. */
  constructor(readonly app: App, private readonly ground: () => Ground | null) {
    app.store.watch(['graph', 'world', 'robot'], () => this.renew());
  }

  /** Robots drive: look now and then whether the offered place is still free. */
  follow(state: State | null): void {
    this.state = state;
    this.count += 1;
    if (this.count % EVERY === 0) {
      this.renew();
    }
  }

  /** Offer a free name and a free place, but leave what was written by hand. */
  renew(): void {
    if (this.busy.peek() !== null) {
      return;
    }
    if (!this.isNamed) {
      const name = this.again?.name.replace(/\W/g, '_') || undefined;
      this.name.value = freeName(this.app.store.simulator?.entities ?? [], name);
    }
    if (!this.isPlaced && this.isBlind()) {
      this.x.value = this.y.value = ''; // what was offered before the robots came
    } else if (!this.isPlaced && (this.x.peek() === '' || !this.isFree())) {
      const place = freePlace(this.radius, this.robots, this.shapes);
      this.x.value = String(place?.x ?? 0);
      this.y.value = String(place?.y ?? 0);
    }
    this.isTaken.value = this.x.peek() !== '' && !this.isFree();
  }

  /**
   * Whether it is not known yet where robots stand that are there; for some states at most. Once it
   * is, another one that comes takes no place back: it could be just when Spawn is pressed.
   */
  private isBlind(): boolean {
    const truths = this.app.store.robots.filter(({ truth }) => truth !== null);
    const isPartial = this.robots.length < truths.length;
    this.hasSeen ||= truths.length > 0 && !isPartial;
    return isPartial && !this.hasSeen && this.count < PATIENCE;
  }

  rename(name: string): void {
    this.isNamed = name !== '';
    this.name.value = name;
  }

  /** A place was written or pointed at. */
  move({ x, y, yaw }: { x?: string; y?: string; yaw?: string }): void {
    this.isPlaced = true;
    this.x.value = x ?? this.x.peek();
    this.y.value = y ?? this.y.peek();
    this.yaw.value = yaw ?? this.yaw.peek();
    this.isTaken.value = !this.isFree();
    this.mark();
  }

  /** Have the place pointed at in the scene, until it is clicked or this is called again. */
  flipPointing(): void {
    const isOn = !this.isPointing.peek();
    this.isPointing.value = isOn;
    const pointed = (x: number, y: number): void => this.move({ x: x.toFixed(2), y: y.toFixed(2) });
    this.ground()?.askForPlace(isOn ? pointed : null, () => this.flipPointing());
    this.mark();
  }

  /** Mark the place in the scene, while it is pointed at and for some time after it was changed. */
  mark(): void {
    clearTimeout(this.marking);
    this.ground()?.markPlace({
      ...this.place,
      yaw: radians(this.yaw.peek()),
      radius: this.radius,
      isFree: !this.isTaken.peek(),
    });
    if (!this.isPointing.peek()) {
      this.marking = setTimeout(() => this.ground()?.markPlace(null), MARKED);
    }
  }

  async spawn(): Promise<void> {
    const { app } = this;
    const { simulator, pattern } = app.store;
    if (simulator === null || pattern === null) {
      app.store.note('error', 'There is no robot here to make another one like it.');
      return;
    }
    if (this.isPointing.peek()) {
      this.flipPointing();
    }
    this.renew(); // a robot may have come to the place that was offered
    const name = this.name.peek();
    this.busy.value = name;
    const { x, y } = this.place;
    const namespace = this.again?.id ?? `/${name}`;
    const isDone = await ask(app, {
      type: 'spawn',
      simulator: simulator.id,
      name,
      namespace,
      position: [x, y, 0],
      yaw: radians(this.yaw.peek()),
      like: pattern.id,
    });
    this.busy.value = null;
    if (isDone) {
      this.isNamed = this.isPlaced = false;
      this.x.value = '';
      this.yaw.value = '0';
      this.ground()?.markPlace(null);
      this.ground()?.bringIntoView(namespace);
    }
    this.renew();
  }

  /** The robot that was deleted, and is offered again; null: it is another one beside those that are there. */
  get again(): RobotInfo | null {
    const { pattern } = this.app.store;
    return pattern?.present === false ? pattern : null;
  }

  private get place(): Point {
    return { x: Number(this.x.peek()) || 0, y: Number(this.y.peek()) || 0 };
  }

  private get radius(): number {
    const { pattern } = this.app.store;
    return (pattern && this.ground()?.radiusOf(pattern.id)) ?? RADIUS;
  }

  /** The shown one first: the new one is to stand beside it. */
  private get robots(): readonly Footprint[] {
    const all = this.ground()?.footprints() ?? footprintsOf(this.state);
    const chosen = this.app.store.robot?.id;
    return [...all.filter(({ id }) => id === chosen), ...all.filter(({ id }) => id !== chosen)];
  }

  private get shapes() {
    return [...this.app.store.worlds.values()].flatMap(({ shapes }) => shapes);
  }

  private isFree(): boolean {
    return isFree(this.place, this.radius, this.robots, this.shapes);
  }
}

/** Robots of which nothing is drawn, by the truth. */
function footprintsOf(state: State | null): Footprint[] {
  return (state?.robots ?? []).flatMap(({ id, truth: [x = NaN, y = NaN] }) =>
    Number.isFinite(x) && Number.isFinite(y) ? [{ id, x, y, yaw: 0, radius: RADIUS }] : [],
  );
}

function radians(degrees: string): number {
  return ((Number(degrees) || 0) * Math.PI) / 180;
}
