// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Which robot is which: of several each has a colour of its own, for its ring, trails and name. */
import type { RobotEntry } from './entry';
import type { Label } from './labels';
import { Slots } from './slots';
import type { Palette } from './theme';

/** A robot, as far as marks go. */
export interface SceneRobot {
  id: string;
  name: string;
  isChosen: boolean;
  drives: boolean;
}

type Entries = ReadonlyMap<string, RobotEntry>;

export class RobotMarks {
  private readonly slots = new Slots();
  private robots: readonly SceneRobot[] = [];

  /** Have these robots, and no others; each keeps its colour. */
  keep(robots: readonly SceneRobot[]): void {
    this.robots = robots;
    this.slots.keep(robots.map(({ id }) => id));
  }

  /** Give trails and marks their colours. One robot alone has those of the plots, and no ring. */
  dress(entries: Entries, palette: Palette): void {
    const isOne = this.robots.length < 2;
    for (const { id, isChosen, drives } of this.robots) {
      const entry = entries.get(id);
      const colour = this.colourOf(id, palette);
      entry?.trails.setColours(isOne ? palette.truth : colour, isOne ? palette.odometry : colour);
      entry?.mark.setLook({
        colour: isOne ? palette.labelFixed : colour,
        hasRing: !isOne,
        hasFront: drives,
        isChosen,
      });
    }
  }

  /** The names of the robots, where there are several. */
  labels(entries: Entries, palette: Palette): Label[] {
    const robots = this.robots.length < 2 ? [] : this.robots;
    return robots.flatMap(({ id, name, isChosen }): Label[] => {
      const at = entries.get(id)?.top ?? null;
      const colour = this.colourOf(id, palette);
      return at === null ? [] : [{ key: `robot ${id}`, text: name, at, isStrong: isChosen, colour }];
    });
  }

  private colourOf(robot: string, { robots }: Palette): string {
    return robots[this.slots.of(robot) % robots.length] as string;
  }
}
