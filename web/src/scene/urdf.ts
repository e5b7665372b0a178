// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A URDF, made ready for urdf-loader: what RViz reads in it, though the loader does not. */
import type { Files } from './meshes';

const PLAIN = '0.52 0.6 0.7 1';

/** A URDF that cannot be drawn; the message is the reason. */
export class BadModel extends Error {
  override readonly name = 'BadModel';
}

/**
 * The XML of a URDF, with
 *
 * - materials that are defined within one visual and named in others written out there too,
 * - textures that the node did not find left out; their names are given to `onMissing`,
 * - a colour for visuals that have none of their own: white would not be seen on a white map.
 */
export function readUrdf(urdf: string, files: Files, onMissing: (name: string) => void): Document {
  const xml = new DOMParser().parseFromString(urdf, 'text/xml');
  const fault = xml.querySelector('parsererror');
  if (fault !== null || xml.documentElement.localName !== 'robot') {
    throw new BadModel(`the robot's description is no URDF: ${fault?.textContent ?? ''}`.trim());
  }
  for (const texture of xml.querySelectorAll('material > texture')) {
    const name = texture.getAttribute('filename');
    if (name !== null && files[name] === undefined) {
      onMissing(name);
      texture.remove();
    }
  }
  writeMaterialsOut(xml);
  colourPlainVisuals(xml);
  return xml;
}

function colourPlainVisuals(xml: Document): void {
  for (const visual of xml.querySelectorAll('visual')) {
    const file = visual.querySelector('geometry > mesh')?.getAttribute('filename') ?? '.stl';
    const hasColour = visual.querySelector(':scope > material') !== null || !/\.stl$/i.test(file);
    if (!hasColour) {
      const colour = xml.createElement('color');
      colour.setAttribute('rgba', PLAIN);
      const material = xml.createElement('material');
      material.setAttribute('name', 'plain');
      material.append(colour);
      visual.append(material);
    }
  }
}

function writeMaterialsOut(xml: Document): void {
  const defined = new Map<string, Element>();
  const materials = [...xml.querySelectorAll('robot > material, visual > material')];
  for (const material of materials) {
    const name = material.getAttribute('name');
    if (name && material.childElementCount > 0 && !defined.has(name)) {
      defined.set(name, material);
    }
  }
  for (const material of materials) {
    const definition = defined.get(material.getAttribute('name') ?? '');
    if (definition !== undefined && material.childElementCount === 0) {
      material.replaceWith(definition.cloneNode(true));
    }
  }
}

/** The mass of a robot, kg. */
export function massOf(urdf: string): number {
  const xml = new DOMParser().parseFromString(urdf, 'text/xml');
  const masses = [...xml.querySelectorAll('robot > link > inertial > mass')];
  return masses.reduce((sum, one) => sum + (Number(one.getAttribute('value')) || 0), 0);
}
