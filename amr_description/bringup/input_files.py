# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The input files of a stack: their hashes, and a warning where another copy differs.

A workspace that was built without ``--symlink-install`` has every description twice, and an edit
of the source has no effect until the next build. Each note contains the time at which the file was
last saved: that shows changes which an editor has not saved yet.
"""

from collections.abc import Iterator, Sequence
from datetime import datetime
import hashlib
from pathlib import Path
from typing import TypeAlias

from amr_description.ament_index import package_in, package_prefix, source_of
from amr_description.bringup.handlers import Level
from amr_description.errors import ResourceError
from amr_description.model.xacro_markup import is_xacro

Note: TypeAlias = tuple[Level, str]
"""(level, text) of a message in the log."""

_DIGITS = 12  # of the SHA-256; enough to compare by eye
_FIX = 'run scripts/setup, or colcon build --symlink-install, which links instead of copying'


def notes_on(files: Sequence[Path]) -> list[Note]:
    """
    Return a note on each file, with its hash, and a warning for each whose other copy differs.

    The other copy of an installed file is its source, that of a source file the installed one.
    With a xacro file all other files of its folder are compared, since it may include them.
    """
    notes: list[Note] = []
    for file in files:
        saved = datetime.fromtimestamp(file.stat().st_mtime)
        text = f'{file}{_target(file)} ({_hash(file)}, saved {saved:%Y-%m-%d %H:%M:%S})'
        notes.append(('INFO', f'using {text}'))
        compared = _family(file) if is_xacro(file) else [file]
        notes += [('WARNING', text) for each in compared for text in _differences(each)]
    return list(dict.fromkeys(notes))  # files of a folder may be there beside a xacro file of it


def _differences(used: Path) -> Iterator[str]:
    """Yield at most one line: which other copy differs, and how to avoid a second copy."""
    other, what = source_of(used), 'its source'
    if other is None:
        other, what = installed_copy_of(used), 'the installed copy'
    if other is None or other.read_bytes() == used.read_bytes():
        return
    age = 'newer' if other.stat().st_mtime > used.stat().st_mtime else 'older'
    yield (
        f'{used} ({_hash(used)}) is used; {what}, {other} ({_hash(other)}, {age}), is not the '
        f'same; {_FIX}'
    )


def installed_copy_of(source: Path) -> Path | None:
    """Return the installed copy of a package's source file, which ``package://`` finds, if any."""
    for folder in source.parents:
        package = package_in(folder / 'package.xml')
        if package is None:
            continue
        try:
            share = package_prefix(package) / 'share' / package
        except ResourceError:  # not built, or not sourced
            return None
        installed = share / source.relative_to(folder)
        return installed if installed.is_file() else None
    return None


def _family(file: Path) -> list[Path]:
    """Return all files of the folder of ``file``, that one first."""
    others = (other for other in sorted(file.parent.iterdir()) if other.is_file())
    return [file, *(other for other in others if other.name != file.name)]


def _target(file: Path) -> str:
    """Return where a link leads, `` -> …``; '' if it is none."""
    target = file.resolve()
    return '' if target == file else f' -> {target}'


def _hash(file: Path) -> str:
    return f'sha256 {hashlib.sha256(file.read_bytes()).hexdigest()[:_DIGITS]}'
