# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which files of packages a launch file reads, however it does: for the notes on other copies.

A launch file in Python opens files as it likes, so Python itself is asked. What a Command reads is
not seen; those of its words that are files are noted in its place.
"""

from collections.abc import Iterator
from contextlib import contextmanager
import functools
from pathlib import Path
import sys
from typing import Any

_KINDS = (
    '.launch.py', '_launch.py', '.urdf', '.xacro', '.yaml', '.yml', '.xml', '.sdf', '.world',
    '.srdf',
)  # fmt: skip
_MANIFEST = 'package.xml'
_recorded: list[Path] | None = None


@contextmanager
def recording() -> Iterator[list[Path]]:
    """Note what is opened within the context, in the order in which it is; each file once."""
    global _recorded
    files: list[Path] = []
    before = _recorded
    _listen()
    _recorded = files
    try:
        yield files
    finally:
        _recorded = before


def note(path: str) -> None:
    """Note a file, if it is of a package and of a kind that people edit."""
    if _recorded is None or not path.endswith(_KINDS):
        return
    file = Path(path).absolute()
    if file.name == _MANIFEST or file in _recorded:
        return
    if file.is_file() and _is_in_a_package(file):
        _recorded.append(file)


def _is_in_a_package(file: Path) -> bool:
    return any((folder / _MANIFEST).is_file() for folder in file.parents)


@functools.cache
def _listen() -> None:
    """Have Python tell; it goes on until the end of the process."""
    sys.addaudithook(_on_event)


def _on_event(event: str, arguments: tuple[Any, ...]) -> None:
    if _recorded is not None and event == 'open':
        path, mode, _ = arguments
        if isinstance(path, str) and (mode is None or not set(mode) & set('wax+')):
            note(path)
