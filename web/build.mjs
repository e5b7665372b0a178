// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Build the page into amr_description/viewer/static/, where users find it without Node.js.
 *
 * The bytes written depend on the sources and the lock file alone, not on the machine or the day,
 * so that a test can tell whether the built page is of the sources beside it.
 */
import { createHash } from 'node:crypto';
import { copyFile, mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.join(here, '..', 'amr_description', 'viewer', 'static');

await rm(out, { recursive: true, force: true });
await mkdir(out, { recursive: true });
await esbuild.build({
  absWorkingDir: here,
  entryPoints: ['src/main.ts', 'src/style.css'],
  outdir: out,
  bundle: true,
  format: 'esm',
  target: 'es2022',
  minify: true,
  legalComments: 'linked', // the licences of three, urdf-loader and uPlot go with the page
  logLevel: 'warning',
});
for (const name of ['index.html', 'icon.svg']) {
  await copyFile(path.join(here, 'src', name), path.join(out, name));
}
await writeFile(path.join(out, 'sources.sha256'), `${await digestOfSources()}\n`);

/** One digest over all that the page is built from: "<digest of the file>  <path>" a line, sorted. */
async function digestOfSources() {
  const below = await readdir(path.join(here, 'src'), { recursive: true, withFileTypes: true });
  const files = below
    .filter((entry) => entry.isFile())
    .map((entry) => path.relative(here, path.join(entry.parentPath, entry.name)));
  const lines = [];
  for (const file of ['build.mjs', 'package-lock.json', 'tsconfig.json', ...files].sort()) {
    const content = await readFile(path.join(here, file));
    lines.push(`${createHash('sha256').update(content).digest('hex')}  ${file}\n`);
  }
  return createHash('sha256').update(lines.join('')).digest('hex');
}
