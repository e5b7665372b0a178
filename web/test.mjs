// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Run the unit tests: bundle each test/*.test.ts(x) into a directory of its own and `node --test` it. */
import { spawnSync } from 'node:child_process';
import { mkdtemp, readdir, rm } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const wanted = process.argv.slice(2);
const tests = (await readdir(path.join(here, 'test')))
  .filter((name) => /\.test\.tsx?$/.test(name))
  .filter((name) => wanted.length === 0 || wanted.some((part) => name.includes(part)));
if (tests.length === 0) {
  console.error(`no test/*${wanted.join('|')}*.test.ts(x)`);
  process.exit(2);
}

// Below node_modules, where what is not bundled is found.
const out = await mkdtemp(path.join(here, 'node_modules', '.amr-web-test-'));
try {
  await esbuild.build({
    absWorkingDir: here,
    entryPoints: tests.map((name) => path.join('test', name)),
    outdir: out,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    external: ['happy-dom'], // large, and of no use to most tests
    format: 'esm',
    platform: 'node',
    target: 'node20',
    sourcemap: 'inline',
    logLevel: 'warning',
  });
  const files = tests.map((name) => path.join(out, name.replace(/\.tsx?$/, '.mjs')));
  const { status } = spawnSync(
    process.execPath,
    ['--enable-source-maps', '--test', '--test-reporter=spec', ...files],
    { stdio: 'inherit' },
  );
  process.exitCode = status ?? 1;
} finally {
  await rm(out, { recursive: true, force: true });
}
