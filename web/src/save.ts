// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
import { h } from './dom';

/** Hand a file to the person, as a download. */
export function saveFile(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  h('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000); // the download has begun by then
}
