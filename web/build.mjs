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
import { brotliCompressSync } from 'node:zlib'; // of the best quality by default
import * as esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.join(here, '..', 'amr_description', 'viewer', 'static');

await rm(out, { recursive: true, force: true });
await mkdir(out, { recursive: true });
const { metafile } = await esbuild.build({
  absWorkingDir: here,
  entryPoints: [
    { in: 'src/main.ts', out: 'main' },
    { in: 'src/socket/worker.ts', out: 'socket' },
    { in: 'src/style.css', out: 'style' },
  ],
  outdir: out,
  bundle: true,
  format: 'esm',
  target: 'es2022',
  minify: true,
  legalComments: 'none', // whole licences are written below
  metafile: true,
  logLevel: 'warning',
});
for (const name of ['index.html', 'icon.svg']) {
  await copyFile(path.join(here, 'src', name), path.join(out, name));
}
for (const name of await readdir(out)) {
  if (/\.(js|css)$/.test(name)) {
    const content = await readFile(path.join(out, name));
    await writeFile(path.join(out, `${name}.br`), brotliCompressSync(content));
  }
}
await writeFile(path.join(out, 'licenses.txt'), await licences(Object.keys(metafile.inputs)));
await writeFile(path.join(out, 'sources.sha256'), `${await digestOfSources()}\n`);

/** The licences of the packages that are in the page: name, version and text of each, sorted. */
async function licences(inputs) {
  const found = inputs.map((input) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(input)?.[1]);
  const texts = [];
  for (const name of [...new Set(found.filter(Boolean))].sort()) {
    const folder = path.join(here, 'node_modules', name);
    const about = JSON.parse(await readFile(path.join(folder, 'package.json'), 'utf8'));
    const file = (await readdir(folder)).find((entry) => /^licen[cs]e/i.test(entry));
    if (file === undefined && about.license !== 'Apache-2.0') {
      throw new Error(`${name} is in the page, but has no licence file to go with it`);
    }
    // A package without the file names its licence alone; that of Apache is in this project, too.
    const text = file === undefined ? path.join(here, '..', 'LICENSE') : path.join(folder, file);
    texts.push(`${name} ${about.version} (${about.license})\n\n${await readFile(text, 'utf8')}`);
  }
  return texts.join(`\n${'-'.repeat(79)}\n\n`);
}

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
