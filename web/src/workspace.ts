// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Where tools stand on a desk: one in the column, chosen by its tab, and one large at each of two
 * places. It is kept in this browser, and in the link. The scene is never covered: the robot stays in sight.
 */
import { forgetLink, linkPart } from './address';
import { recall, remember } from './remember';

/** beside: right of the scene, as high as it; below: under the scene, where else the plots are. */
export const PLACES = ['beside', 'below'] as const;
export type Place = (typeof PLACES)[number];

const NAME = 'tools';
const AT_HOME = 'plots'; // stands below wherever nothing else does
const SMALL = 'drive.small';

export class Workspace {
  private at: Partial<Record<Place, string>>;
  private small: boolean;
  /** Something stands elsewhere, or Drive has another size. */
  onChange: () => void = () => {};

  constructor() {
    const text = linkPart(NAME, () => this.text) ?? recall(NAME) ?? '';
    this.at = decode(text);
    this.small = text.split(',').includes(SMALL);
  }

  /** The place of a tool; null: the column. */
  placeOf(id: string): Place | null {
    return PLACES.find((place) => this.at[place] === id) ?? null;
  }

  /** Have a tool stand large at a place, or in the column; what stood there goes back to the column. */
  put(id: string, place: Place | null): void {
    const others = PLACES.filter((each) => each !== place && this.at[each] !== id);
    this.at = Object.fromEntries(others.map((each) => [each, this.at[each]]));
    if (place !== null && !(id === AT_HOME && place === 'below')) {
      this.at[place] = id;
    }
    this.changed();
  }

  /** Whether Drive is stick and STOP alone. */
  get isDriveSmall(): boolean {
    return this.small;
  }

  setDriveSmall(small: boolean): void {
    this.small = small;
    this.changed();
  }

  /** All as at first. */
  reset(): void {
    this.at = {};
    this.small = false;
    this.changed();
  }

  /** "beside.graph,below.log,drive.small". */
  private get text(): string {
    const places = PLACES.filter((place) => this.at[place] !== undefined);
    const words = places.map((place) => `${place}.${this.at[place]}`);
    return [...words, ...(this.small ? [SMALL] : [])].join(',');
  }

  private changed(): void {
    remember(NAME, this.text);
    forgetLink();
    this.onChange();
  }
}

/** Of what is no place nothing; of a tool at two places the first. */
function decode(text: string): Partial<Record<Place, string>> {
  const pairs = text.split(',').map((each) => each.split('.') as [Place, string | undefined]);
  const known = pairs.filter(([place, id]) => PLACES.includes(place) && /^\w+$/.test(id ?? ''));
  const once = known.filter(([, id], at) => known.findIndex(([, other]) => other === id) === at);
  return Object.fromEntries(once.filter(([place, id]) => !(place === 'below' && id === AT_HOME)));
}
