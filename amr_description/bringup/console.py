# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a person reads: lines as launch prints them, coloured on a terminal, and in log files."""

from collections.abc import Callable, Mapping
import contextlib
import io
import itertools
import time
from typing import Literal, TextIO

from amr_description.bringup.log_folder import LogFolder

type Level = Literal['INFO', 'WARNING', 'ERROR']

LAUNCH = 'launch'
"""The name under which the orchestrator itself speaks."""

_RESET = '\x1b[0m'
_LEVEL_COLOURS: dict[Level, str] = {'WARNING': '\x1b[33m', 'ERROR': '\x1b[31m'}
_NAME_COLOURS = [f'\x1b[{code}m' for code in (36, 32, 35, 34, 96, 92, 95, 94)]


def wants_colour(screen: TextIO, environment: Mapping[str, str]) -> bool:
    """Say whether to colour: ``RCUTILS_COLORIZED_OUTPUT`` decides, else NO_COLOR, else a TTY."""
    forced = environment.get('RCUTILS_COLORIZED_OUTPUT', '')
    if forced in ('0', '1'):
        return forced == '1'
    if environment.get('NO_COLOR') or environment.get('TERM') == 'dumb':
        return False
    return screen.isatty()


def _with_buffer(screen: TextIO) -> TextIO:
    """
    Return ``screen`` with a buffer, if it has none (``python -u``, PYTHONUNBUFFERED).

    Without one, Python drops what is left of a write that a signal cuts short: a child ends while
    a full pipe waits for its reader.
    """
    if not isinstance(getattr(screen, 'buffer', None), io.RawIOBase):
        return screen
    return open(screen.fileno(), 'w', encoding=screen.encoding, closefd=False)


class Console:
    """The screen and the log files of one run; all lines go through here, one at a time."""

    def __init__(
        self,
        screen: TextIO,
        folder: LogFolder,
        *,
        colour: bool,
    ) -> None:
        """Write to ``screen`` and below ``folder``."""
        self._screen: TextIO | None = _with_buffer(screen)
        self._folder = folder
        self._colour = colour
        self.on_screen_lost: Callable[[], None] = lambda: None
        """Called once, when nobody reads the screen any more (``| head``)."""
        self._name_colours: dict[str, str] = {}
        self._free_colours = itertools.cycle(_NAME_COLOURS)
        self._log_failure_told = False
        with contextlib.suppress(AttributeError):  # not a TextIOWrapper
            self._screen.reconfigure(errors='backslashreplace')

    def say(self, level: Level, name: str, text: str) -> None:
        """Print ``[INFO] [name]: text``."""
        colour = _LEVEL_COLOURS.get(level, '')
        shown = f'[{level}] [{self._named(name, name)}]: {self._painted(text, colour)}'
        self._show(shown, f'[{level}] [{name}]: {text}')

    def output(self, name: str, line: str) -> None:
        """Print a line that a process wrote, ``[name] line``; it has a log file of its own too."""
        self._folder.write(name, line)
        self._show(f'{self._named(name, f"[{name}]")} {line}', f'[{name}] {line}')

    def _show(self, line: str, logged: str) -> None:
        self._folder.write(LAUNCH, f'{time.time():.7f} {logged}')
        self._print(line)
        if self._folder.failure is not None and not self._log_failure_told:
            self._log_failure_told = True
            self._print(f'[WARNING] [{LAUNCH}]: no log files from here on: {self._folder.failure}')

    def _print(self, line: str) -> None:
        if self._screen is None:
            return
        try:
            self._screen.write(f'{line}\n')
            self._screen.flush()
        except BlockingIOError:  # a terminal that another program made non-blocking is busy
            pass
        except OSError:
            self._screen = None
            self.on_screen_lost()

    def _named(self, name: str, text: str) -> str:
        if name == LAUNCH:
            return text
        if name not in self._name_colours:
            self._name_colours[name] = next(self._free_colours)
        return self._painted(text, self._name_colours[name])

    def _painted(self, text: str, colour: str) -> str:
        return f'{colour}{text}{_RESET}' if self._colour and colour else text
