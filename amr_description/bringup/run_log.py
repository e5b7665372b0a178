# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The logs of one run: its folder with ``launch.log`` and a file per process, and its events.

``events.jsonl`` in that folder is for programs: one event a line, a JSON object that is written
as soon as the event occurs.

=============== ==========================================================================
``time``        s since 1970, by the system clock
``since_start`` s since the start of the run; never goes back
``event``       one of those below
``node``        its name on the screen, ``create-3``; not in events of the whole run
=============== ==========================================================================

================== =================================== ======================================
event              of                                  more keys
================== =================================== ======================================
``begun``          the run                             ``stack``, ``run``, ``pid``, ``domain``,
                                                       ``log_folder``
``waiting``        a node, at the start                ``condition`` in words; ``null``: none
``condition_held`` a node                              ``condition``
``started``        a node                              ``pid``
``not_started``    a node                              ``reason``
``exited``         a node                              ``pid``, ``exit_code`` or ``signal``
``respawn``        a node that will be started again   in ``seconds``; ``restarts`` in a row
``never``          a node that can never start         ``condition``
``ready``          the run                             ``seconds`` it took
``never_ready``    the run, which continues            ``condition`` that cannot hold
``stop_requested`` the run                             ``signal``
``shutdown``       the run, which a handler stops      ``reason``
``signal_sent``    a node                              ``pid``, ``signal``
``failure``        the node that stopped the run       ``reason``
``stopped``        the run, last of all                ``exit_code``
================== =================================== ======================================

Signals are names, ``SIGINT``; more keys and events may be added.
"""

from collections.abc import Callable, Mapping
import contextlib
from datetime import datetime
import json
import os
from pathlib import Path
import socket
import tempfile
import time
from typing import TextIO, TypeAlias

EVENTS_FILE = 'events.jsonl'
_MIN_SPACE = 65_536  # bytes; a disk with less cannot take the parameters and the first lines

Event: TypeAlias = Mapping[str, object]


class EventLog:
    """Passes each event on to its listeners."""

    def __init__(self, *listeners: Callable[[Event], None]) -> None:
        """Store the listeners; each is called with each event at once, in this order."""
        self._listeners = listeners
        self._begin = time.monotonic()

    def note(self, event: str, node: str | None = None, **more: object) -> None:
        """
        Pass on an event that has occurred just now.

        Args:
            event: its name, see the module's docstring.
            node: the name of the node on the screen; None: it is of the whole run.
            more: further keys.
        """
        entry = {
            'time': round(time.time(), 6),
            'since_start': round(time.monotonic() - self._begin, 6),
            'event': event,
            **({} if node is None else {'node': node}),
            **more,
        }
        for listener in self._listeners:
            listener(entry)


def json_line(event: Event) -> str:
    """Return an event as a line of ``events.jsonl``."""
    return json.dumps(event, ensure_ascii=False)


def log_base(environment: Mapping[str, str]) -> Path:
    """Return ``$ROS_LOG_DIR``, else ``$ROS_HOME/log``, else ``~/.ros/log``."""
    if environment.get('ROS_LOG_DIR'):
        return Path(environment['ROS_LOG_DIR']).expanduser()
    return Path(environment.get('ROS_HOME') or '~/.ros').expanduser() / 'log'


def run_name(now: datetime) -> str:
    """Return the name for a run, as launch names its log folders; unique by time and pid."""
    return f'{now:%Y-%m-%d-%H-%M-%S-%f}-{socket.gethostname()}-{os.getpid()}'


def with_tilde(path: Path | str) -> str:
    """Return a path for a message, with ``~`` for the home folder."""
    path = Path(path)
    return f'~/{path.relative_to(Path.home())}' if path.is_relative_to(Path.home()) else str(path)


class LogFolder:
    """
    The log files of one run, each opened at its first line.

    A full disk costs the logs, never the run: after the first error nothing more is written, and
    :attr:`failure` is that error.
    """

    def __init__(self, base: Path, run: str) -> None:
        """Make ``<base>/<run>`` or, if it cannot be made, a folder that :meth:`close` removes."""
        self.failure: OSError | None = None
        self._files: dict[str, TextIO] = {}
        self._substitute: tempfile.TemporaryDirectory[str] | None = None
        try:
            self.path = base / run
            self.path.mkdir(parents=True)
            _require_space(self.path)
            _point_to(base / 'latest', self.path)
        except OSError as error:
            self.failure = error
            self._substitute = tempfile.TemporaryDirectory(prefix='bringup-')
            self.path = Path(self._substitute.name)

    def write(self, name: str, line: str) -> None:
        """Append a line to ``<name>.log``."""
        self.append(f'{name}.log', line)

    def append(self, file: str, line: str) -> None:
        """Append a line to a file of the folder, unbuffered."""
        if self.failure is not None:
            return
        try:
            if file not in self._files:
                self._files[file] = (self.path / file).open('w', encoding='utf-8', buffering=1)
            self._files[file].write(f'{line}\n')
        except OSError as error:
            self.failure = error

    def close(self) -> None:
        """Close the files; remove a substitute folder."""
        for file in self._files.values():
            with contextlib.suppress(OSError):
                file.close()
        self._files.clear()
        if self._substitute is not None:
            self._substitute.cleanup()


def _require_space(folder: Path) -> None:
    """Raise OSError if the disk is full; making a folder may succeed all the same."""
    with tempfile.TemporaryFile(dir=folder) as file:
        os.posix_fallocate(file.fileno(), 0, _MIN_SPACE)


def _point_to(link: Path, folder: Path) -> None:
    """Let ``latest`` point to the folder, atomically; one that is no link is left alone."""
    if link.exists() and not link.is_symlink():
        return
    fresh = link.with_name(f'.latest-{folder.name}')
    fresh.symlink_to(folder.name)
    fresh.replace(link)
