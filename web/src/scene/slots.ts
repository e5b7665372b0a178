// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Small numbers for names, such as of colours: a name keeps its own for as long as it is there. */

export class Slots {
  private slots = new Map<string, number>();

  /** Have these names, and no others: a new one gets the least number that is free. */
  keep(names: readonly string[]): void {
    const kept = names.flatMap((name): [string, number][] => {
      const slot = this.slots.get(name);
      return slot === undefined ? [] : [[name, slot]];
    });
    const taken = new Set(kept.map(([, slot]) => slot));
    this.slots = new Map(kept);
    for (const name of names.filter((each) => !this.slots.has(each))) {
      let slot = 0;
      while (taken.has(slot)) {
        slot += 1;
      }
      taken.add(slot);
      this.slots.set(name, slot);
    }
  }

  /** The number of a name; 0 for one that is not there. */
  of(name: string): number {
    return this.slots.get(name) ?? 0;
  }
}
