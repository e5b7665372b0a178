# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The folder of log files of one run: ``launch.log``, a file per process, and ``latest``."""

from collections.abc import Mapping
import contextlib
from datetime import datetime
import os
from pathlib import Path
import socket
import tempfile
from typing import TextIO


def log_base(environment: Mapping[str, str]) -> Path:
    """Return ``$ROS_LOG_DIR``, else ``$ROS_HOME/log``, else ``~/.ros/log``."""
    if environment.get('ROS_LOG_DIR'):
        return Path(environment['ROS_LOG_DIR']).expanduser()
    return Path(environment.get('ROS_HOME') or '~/.ros').expanduser() / 'log'


def run_name(now: datetime) -> str:
    """Return the name of a run, as launch names its log folders; unique by time and pid."""
    return f'{now:%Y-%m-%d-%H-%M-%S-%f}-{socket.gethostname()}-{os.getpid()}'


def with_tilde(path: Path | str) -> str:
    """Return a path as a person reads it, ``~`` for the home."""
    path = Path(path)
    return f'~/{path.relative_to(Path.home())}' if path.is_relative_to(Path.home()) else str(path)


_ROOM = 65_536  # bytes; a disk without so much cannot take the parameters and the first lines


class LogFolder:
    """
    Log files of one run, each opened at its first line.

    A disk that is full costs the logs, never the robot: after the first failure nothing more is
    written, and :attr:`failure` says why.
    """

    def __init__(self, base: Path, run: str) -> None:
        """Make ``<base>/<run>``; where that cannot be, a folder that :meth:`close` removes."""
        self.failure: OSError | None = None
        self._files: dict[str, TextIO] = {}
        self._substitute: tempfile.TemporaryDirectory[str] | None = None
        try:
            self.path = base / run
            self.path.mkdir(parents=True)
            _require_room(self.path)
            _point_to(base / 'latest', self.path)
        except OSError as error:
            self.failure = error
            self._substitute = tempfile.TemporaryDirectory(prefix='bringup-')
            self.path = Path(self._substitute.name)

    def write(self, name: str, line: str) -> None:
        """Append a line to ``<name>.log``."""
        self.append(f'{name}.log', line)

    def append(self, file: str, line: str) -> None:
        """Append a line to a file of the folder; it is written at once."""
        if self.failure is not None:
            return
        try:
            if file not in self._files:
                self._files[file] = (self.path / file).open('w', encoding='utf-8', buffering=1)
            self._files[file].write(f'{line}\n')
        except OSError as error:
            self.failure = error

    def close(self) -> None:
        """Close the files."""
        for file in self._files.values():
            with contextlib.suppress(OSError):
                file.close()
        self._files.clear()
        if self._substitute is not None:
            self._substitute.cleanup()


def _require_room(folder: Path) -> None:
    """Raise OSError if the disk is full: a folder can be made there all the same."""
    with tempfile.TemporaryFile(dir=folder) as file:
        os.posix_fallocate(file.fileno(), 0, _ROOM)


def _point_to(link: Path, folder: Path) -> None:
    """Point ``latest`` to the folder in one step; a ``latest`` that is no link is left alone."""
    if link.exists() and not link.is_symlink():
        return
    fresh = link.with_name(f'.latest-{folder.name}')
    fresh.symlink_to(folder.name)
    fresh.replace(link)
