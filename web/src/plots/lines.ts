// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The lines of a chart: what each shows, its name, and how it is told from one that it lies on. */
import type { Names } from '../channels';
import { SOURCES } from '../readings';
import { nameOf, parentOf, shortNames, stepsText, type Field } from './field';
import type { ChartSpec, Kind } from './layout';
import { FACTOR_COLUMN, velocityColumn, wheelColumn } from './recorder';

/** Where a line's values are: a column of the robot's record, or a field of a topic. */
export type Source = { column: number } | Field;

export interface Stroke {
  source: Source;
  width: number; // px
  dash: readonly number[]; // px on, off …; none: solid
  step: boolean; // it keeps its value until the next one
}

export interface Line {
  name: string;
  title: string; // the whole of it
  colour: string; // the name of a colour of the style sheet
  stroke: Stroke;
  wanted: Stroke | null; // what it ought to be
  names: Names | null; // of its values, where it is a state
  field: Field | null; // what is taken out to take it out; null: it stays
  columns: readonly string[]; // names in a table: of the stroke, and of what it ought to be
}

export interface ChartLines {
  title: string;
  unit: string;
  lines: Line[];
  always: readonly [number, number] | null; // values always in view
  leastSpan: number; // of the values, so that noise at rest does not fill the plot
  form: 'time' | 'xy' | 'lanes'; // numbers over time, over the first of them, or states side by side
}

const COLOURS = 6;
const THIN = 1.25; // px
const THICKER = 0.9; // px, each line than the one that lies on it
const DASH = [7, 4];
const WANTED_DASH = [4, 3];

const ABOUT: Record<Kind, Omit<ChartLines, 'lines' | 'form'>> = {
  linear: { title: 'Linear velocity', unit: 'm/s', always: null, leastSpan: 0.2 },
  angular: { title: 'Angular velocity', unit: 'rad/s', always: null, leastSpan: 0.2 },
  wheels: { title: 'Wheel speeds', unit: 'rad/s', always: null, leastSpan: 0.2 },
  factor: { title: 'Real-time factor', unit: 'x real time', always: [0, 1], leastSpan: 0.2 },
};

type NamesOf = (field: Field) => Names | null | undefined; // undefined: nothing of it has come

/** What a chart shows of a robot with these wheels. Where all are states, they are lanes. */
export function chartLines(spec: ChartSpec, wheels: readonly string[], namesOf: NamesOf): ChartLines {
  const { kind, fields } = spec;
  const own = kind === null ? [] : ownLines(kind, wheels);
  const lines = [...own, ...fieldLines(fields, kind === null ? 0 : own.length, namesOf)];
  const isXy = spec.isXy && fields.length > 1;
  const isStates = kind === null && lines.some(({ names }) => names !== null) && !fields.map(namesOf).includes(null);
  const form = isXy ? 'xy' : isStates ? 'lanes' : 'time';
  const about = kind === null ? aboutFields(fields) : ABOUT[kind];
  return { ...about, ...(isXy && { unit: `over ${lines[0]?.name}` }), lines, form };
}

function aboutFields(fields: readonly Field[]): Omit<ChartLines, 'lines' | 'form'> {
  const topics = [...new Set(fields.map(({ topic }) => topic))];
  const parents = new Set(fields.map((field) => nameOf(parentOf(field))));
  const [parent] = parents.size === 1 ? fields.map(parentOf) : [];
  const about = parent?.path.split('.').at(-1) ?? ''; // "linear", of its x, y and z
  const made = parent === undefined ? '' : stepsText(parent);
  return { title: `${topics.join(', ')} ${about}`.trim() + made, unit: '', always: null, leastSpan: 0 };
}

function ownLines(kind: Kind, wheels: readonly string[]): Line[] {
  switch (kind) {
    case 'linear':
    case 'angular':
      return SOURCES.map((source, index) => ({
        ...plain(source, source, { column: velocityColumn(index, kind) }),
        stroke: velocity(source, { column: velocityColumn(index, kind) }),
        columns: [`${source}_${kind}_${kind === 'linear' ? 'm_s' : 'rad_s'}`],
      }));
    case 'wheels':
      return wheels.map((name, index) => ({
        ...plain(
          name.replace(/^(joint_)?(wheel_)?/, '').replace(/(_wheel)?(_joint)?$/, ''),
          `wheel-${index % COLOURS}`,
          { column: wheelColumn(index, 'measured') },
        ),
        stroke: strokeOf({ column: wheelColumn(index, 'measured') }, index, wheels.length),
        title: `${name}, measured / commanded`,
        wanted: {
          ...command({ column: wheelColumn(index, 'commanded') }),
          dash: WANTED_DASH,
        },
        columns: [`${name}_rad_s`, `${name}_commanded_rad_s`],
      }));
    case 'factor':
      return [
        { ...plain('real', 'accent', { column: FACTOR_COLUMN }), columns: ['real_time_factor'] },
      ];
  }
}

function fieldLines(fields: readonly Field[], before: number, namesOf: NamesOf): Line[] {
  const names = shortNames(fields);
  return fields.map((field, index) => {
    const stroke = strokeOf(field, index, fields.length);
    return {
      ...plain(names[index] ?? field.path, `wheel-${(index + before) % COLOURS}`, field),
      stroke: before > 0 ? { ...stroke, dash: DASH } : stroke,
      title: nameOf(field),
      names: namesOf(field) ?? null,
      field,
      columns: [nameOf(field)],
    };
  });
}

function plain(name: string, colour: string, source: Source): Line {
  const stroke = { source, width: THIN, dash: [], step: false };
  return { name, title: name, colour, stroke, wanted: null, names: null, field: null, columns: [name] };
}

/** What truly is lies widest below, what was wanted is a thin line of steps on it. */
function velocity(name: (typeof SOURCES)[number], source: Source): Stroke {
  return name === 'command'
    ? command(source)
    : strokeOf(source, name === 'truth' ? 0 : 1, SOURCES.length);
}

/** The first is the widest and lies below; from the fifth on they are dashed as well. */
function strokeOf(source: Source, index: number, count: number): Stroke {
  const above = Math.min(count - 1 - index, 3 - (index % 4));
  const dash = index >= 4 ? DASH : [];
  return { source, width: THIN + THICKER * Math.max(0, above), dash, step: false };
}

function command(source: Source): Stroke {
  return { source, width: THIN, dash: [], step: true };
}
