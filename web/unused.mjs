// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Name what src/ exports and nothing imports, types apart; part of `npm run lint`. */
import { readdir, readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const WRITTEN = path.join('src', 'protocol.ts'); // by protocol.py: all that the node knows
const EXPORT = /^export (?:async )?(?:function|const|class) (\w+)/gm;
const IMPORT = /^(?:import|export)\s+(?:type\s+)?\{([^}]*)\}\s+from/gm;

const imported = new Set();
const exported = []; // [file, name]
for (const folder of ['src', 'test']) {
  const names = await readdir(path.join(here, folder), { recursive: true });
  for (const name of names.filter((each) => /\.tsx?$/.test(each))) {
    const file = path.join(folder, name);
    const text = await readFile(path.join(here, file), 'utf8');
    for (const [, list] of text.matchAll(IMPORT)) {
      list.split(',').forEach((each) => imported.add(each.replace(/\btype\b|\bas\b.*/g, '').trim()));
    }
    if (folder === 'src' && file !== WRITTEN) {
      exported.push(...[...text.matchAll(EXPORT)].map(([, each]) => [file, each]));
    }
  }
}
const unused = exported.filter(([, name]) => !imported.has(name));
for (const [file, name] of unused) {
  console.error(`${file}: nothing imports '${name}': remove it, or do not export it`);
}
process.exitCode = unused.length === 0 ? 0 : 1;
