// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Why nothing of a robot is to be seen in the scene, and the words for it. */

export type Unseen =
  | { reason: 'place'; base: string; frame: string } // nothing leads from the fixed frame to its base
  | { reason: 'shapes'; problems: readonly string[] }; // no visual could be drawn, and why

const PACKAGE = /package:\/\/([^/']+)/;

/** Title and text of a card. */
export function unseenWords(robot: string, unseen: Unseen): [title: string, text: string] {
  if (unseen.reason === 'place') {
    const { base, frame } = unseen;
    const text =
      `No transform that is a number leads from "${frame}" to "${base}". ` +
      'The tab Frames has the tree and another fixed frame, Health who publishes what is wrong.';
    return [`${robot} cannot be placed`, text];
  }
  const { problems } = unseen;
  const counts = new Map<string, number>();
  for (const problem of problems) {
    const from = PACKAGE.exec(problem)?.[1] ?? '';
    counts.set(from, (counts.get(from) ?? 0) + 1);
  }
  const parts = [...counts].map(([from, count]) => {
    const files = count === 1 ? '1 file' : `${count} files`;
    return from === '' ? files : `${files} of the package ${from}`;
  });
  const text =
    `${parts.join(', ')} cannot be drawn: ${problems[0]}. ` +
    'Frames shows its axes. A package is found where its workspace is sourced before the viewer starts.';
  return [`Nothing of ${robot} is drawn`, text];
}
