# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``coverage_table.py FILE [FOLDER ...]``: the branches that tests take, from ``coverage json``.

By the folders of the package; with arguments, of these only.
"""

from collections import Counter
from collections.abc import Sequence
import json
from pathlib import Path, PurePosixPath
import sys


def table(report: dict, folders: Sequence[str] = ()) -> str:
    """Return a table of Markdown: for each folder, and for all, branches and lines in percent."""
    sums: dict[str, Counter[str]] = {}
    for name, file in report['files'].items():
        parts = PurePosixPath(name).parts[1:-1]
        if folders and not set(parts) & set(folders):
            continue
        summary = {key: file['summary'][key] for key in KEYS}
        for folder in ('/'.join(parts[:2]) or '.', 'all'):
            sums.setdefault(folder, Counter()).update(summary)
    rows = ['| folder | branches | taken | lines |', '| --- | --: | --: | --: |']
    for folder, each in sorted(sums.items(), key=lambda pair: (pair[0] == 'all', pair[0])):
        branches, lines = each['num_branches'], each['num_statements']
        taken = f'{100 * each["covered_branches"] / branches:.1f} %' if branches else ''
        covered = f'{100 * each["covered_lines"] / lines:.1f} %' if lines else ''
        rows.append(f'| {folder} | {branches} | {taken} | {covered} |')
    return '\n'.join(rows)


KEYS = ('num_branches', 'covered_branches', 'num_statements', 'covered_lines')

if __name__ == '__main__':
    print(table(json.loads(Path(sys.argv[1]).read_text()), sys.argv[2:]))
