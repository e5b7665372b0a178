# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Check that source files say whose they are, and under which license.

Less than the original does: it does not compare the words of a license with a template, adds no
notices, and does not look at LICENSE and CONTRIBUTING.md.
"""

import argparse
from collections.abc import Iterator, Sequence
import os
from pathlib import Path
import re
import sys

_ENDINGS = {'.c', '.cc', '.cpp', '.cxx', '.h', '.hh', '.hpp', '.hxx', '.cmake', '.py'}
_NOTICE = re.compile(
    r'copyright\s+(?:\(c\)\s*)?(?P<years>\d{4}(?:\s*[-,]\s*\d{4})*),?\s+(?P<name>\S.*?)\s*$',
    re.IGNORECASE | re.MULTILINE,
)
_LICENSE = re.compile(
    r'SPDX-License-Identifier:\s*\S+|Licensed under|licensed under|Permission is hereby granted|'
    r'Redistribution and use in source and binary forms|GNU (?:Lesser |Affero )?General Public|'
    r'Mozilla Public License|All rights reserved'
)


def main(argv: Sequence[str] | None = None) -> int:
    """
    Check files, print a line for each, and say whether all have a notice and a license.

    Args:
        argv: files and folders, and ``--exclude FILE ...``; None: those of the process.

    Returns:
        0: all are fine; 1: some are not.
    """
    parser = argparse.ArgumentParser(prog='ament_copyright', description=main.__doc__)
    parser.add_argument('paths', nargs='*', default=[os.curdir], help='files and folders')
    parser.add_argument('--exclude', nargs='*', default=[], metavar='FILE', help='not these')
    options = parser.parse_args(sys.argv[1:] if argv is None else argv)
    excluded = {Path(each).resolve() for each in options.exclude}
    files = sorted({file for path in options.paths for file in _sources(Path(path))} - excluded)
    faults = 0
    for file in files:
        fault, line = _check(file)
        faults += fault
        print(f'{os.path.relpath(file)}: {line}', file=sys.stderr if fault else sys.stdout)
    print(f'{faults} errors, checked {len(files)} files' if faults else 'No problems found')
    return 1 if faults else 0


def _sources(path: Path) -> Iterator[Path]:
    """Yield the source files below ``path``, or itself; none below AMENT_IGNORE or a dot."""
    if path.is_file():
        yield path.resolve()
    for folder, subfolders, names in os.walk(path):
        if 'AMENT_IGNORE' in names:
            subfolders.clear()
            continue
        subfolders[:] = [name for name in subfolders if name[0] not in '._']
        found = (Path(folder, name) for name in names)
        yield from (file.resolve() for file in found if file.suffix in _ENDINGS)


def _check(file: Path) -> tuple[bool, str]:
    """Return whether something is wrong with a file, and what it says, or lacks."""
    header = _header(file.read_text(encoding='utf-8', errors='replace'))
    if header is None:
        return False, 'file empty'
    notices = [f'{match["name"]} ({match["years"]})' for match in _NOTICE.finditer(header)]
    if not notices:
        return True, "no copyright notice: begin it with 'Copyright YEAR NAME' in a comment"
    if not _LICENSE.search(header):
        return (
            True,
            "a copyright notice, and no known license: 'SPDX-License-Identifier: NAME' is one",
        )
    return False, f'copyright={", ".join(notices)}'


def _header(text: str) -> str | None:
    """Return the comments that a file begins with; None: the file is empty."""
    if not text.strip():
        return None
    lines = []
    is_block = False
    for line in text.splitlines():
        words = line.strip()
        is_block = is_block or words.startswith('/*')
        if words and not is_block and not words.startswith(('#', '//')):
            break
        lines.append(words.strip('/*# '))
        is_block = is_block and '*/' not in words
    return '\n'.join(lines)


if __name__ == '__main__':
    sys.exit(main())
