// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The chosen link: mass, inertia, collision shapes, and the joint that it hangs on. */
import { useMemo } from 'preact/hooks';
import { linkFacts, type JointFacts, type LinkFacts } from '../links';
import type { Store } from '../store';
import { Facts, Section } from '../ui';

const DIGITS = 4;
const RIGHT = 180 / Math.PI;

/** Nothing where the chosen frame is no link. */
export function LinkSection({ store }: { store: Store }) {
  const { selection, models } = store;
  const robot = selection?.robot ?? '';
  const urdf = models.get(robot)?.urdf ?? '';
  const frame = selection?.frame ?? '';
  const facts = useMemo(() => chosenLink(urdf, robot, frame), [urdf, robot, frame]);
  if (facts === null) {
    return null;
  }
  return (
    <Section title={`Link ${facts.name}`}>
      <Facts numbers pairs={inertiaPairs(facts)} />
      {facts.joint !== null && <Facts numbers pairs={jointPairs(facts.joint)} />}
    </Section>
  );
}

/** The link that a frame is, with or without the robot's namespace before its name. */
function chosenLink(urdf: string, robot: string, frame: string): LinkFacts | null {
  const prefix = `${robot.slice(1)}/`;
  const own = frame.startsWith(prefix) ? frame.slice(prefix.length) : frame;
  return urdf === '' || frame === '' ? null : linkFacts(urdf, own);
}

function inertiaPairs({ mass, centre, inertia, collisions }: LinkFacts): [string, string][] {
  const shapes = collisions.length === 0 ? 'none: it touches nothing' : collisions.join('; ');
  if (mass === null) {
    return [['Mass', 'none'], ['Collision', shapes]];
  }
  return [
    ['Mass', `${short(mass)} kg`],
    ['Centre of mass x y z, m', centre.xyz.map(short).join('  ')],
    ['Inertia xx yy zz, kg m²', inertia?.tensor.slice(0, 3).map(short).join('  ') ?? 'none'],
    ['xy xz yz', inertia?.tensor.slice(3).map(short).join('  ') ?? 'none'],
    ['Principal, kg m²', inertia?.principal.map(short).join('  ') ?? 'none'],
    ['As an ellipsoid, m', inertia?.ellipsoid?.map((half) => short(2 * half)).join(' × ') ?? 'no body has it'],
    ['Collision', shapes],
  ];
}

function jointPairs({ name, kind, parent, axis, lower, upper, velocity, effort }: JointFacts): [string, string][] {
  const turns = kind !== 'prismatic';
  const position = (value: number): string =>
    turns ? `${short(value)} rad (${Math.round(value * RIGHT)}°)` : `${short(value)} m`;
  const pairs: [string, string | null][] = [
    ['Joint', name],
    ['Kind', `${kind}, on ${parent}`],
    ['Axis x y z', kind === 'fixed' ? null : axis.map(short).join('  ')],
    ['From', lower === null ? null : position(lower)],
    ['To', upper === null ? null : position(upper)],
    ['Velocity, at most', velocity === null ? null : `${short(velocity)} ${turns ? 'rad/s' : 'm/s'}`],
    ['Effort, at most', effort === null ? null : `${short(effort)} ${turns ? 'N m' : 'N'}`],
  ];
  return pairs.filter((pair): pair is [string, string] => pair[1] !== null);
}

/** A number of few digits. */
function short(value: number): string {
  return String(Number(value.toPrecision(DIGITS)));
}
