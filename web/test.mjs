// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * Run the unit tests: bundle all test/*.test.ts(x), or those that are named, into one file and
 * `node --test` it. A process for each of the files would load the same libraries fifty times.
 */
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
const bundle = path.join(out, 'tests.mjs');
try {
  await esbuild.build({
    absWorkingDir: here,
    stdin: {
      contents: tests.map((name) => `import './test/${name}';`).join('\n'),
      resolveDir: here,
    },
    outfile: bundle,
    bundle: true,
    external: ['happy-dom'], // large, and of no use to most tests
    format: 'esm',
    platform: 'node',
    target: 'node20',
    sourcemap: 'inline',
    logLevel: 'warning',
  });
  const { status } = spawnSync(
    process.execPath,
    ['--enable-source-maps', '--test', '--test-reporter=spec', bundle],
    { stdio: 'inherit' },
  );
  process.exitCode = status ?? 1;
} finally {
  await rm(out, { recursive: true, force: true });
}
