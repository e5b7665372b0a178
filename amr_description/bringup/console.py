# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The screen and the log files of a run: lines as launch prints them, coloured on a terminal."""

from collections.abc import Callable, Mapping
import contextlib
import errno
import io
import itertools
import re
import shutil
import time
from typing import TextIO

from amr_description.bringup.handlers import Level
from amr_description.bringup.run_log import LogFolder, with_tilde
from amr_description.bringup.terminal import as_foreground

LAUNCH = 'launch'
"""The name under which the orchestrator itself logs."""
LAUNCH_USER = 'launch.user'
"""… and that of what a launch file logs by LogInfo."""

# Shown even while a process has the terminal: ``[WARN] [1795273609.66] [name]: text``.
_ALARM = re.compile(r'\[(WARN|ERROR|FATAL)\] \[')
_ERASE_LINE = '\r\x1b[K'
_RESET = '\x1b[0m'
_LEVEL_COLOURS: dict[Level, str] = {'WARNING': '\x1b[33m', 'ERROR': '\x1b[31m'}
_NAME_COLOURS = [f'\x1b[{code}m' for code in (36, 32, 35, 34, 96, 92, 95, 94)]


def wants_colour(screen: TextIO, environment: Mapping[str, str]) -> bool:
    """Return whether to colour: RCUTILS_COLORIZED_OUTPUT decides, else NO_COLOR, else a TTY."""
    forced = environment.get('RCUTILS_COLORIZED_OUTPUT', '')
    if forced in ('0', '1'):
        return forced == '1'
    if environment.get('NO_COLOR') or environment.get('TERM') == 'dumb':
        return False
    return screen.isatty()


def can_erase(screen: TextIO, environment: Mapping[str, str]) -> bool:
    """Return whether a line on the screen can be erased and rewritten."""
    return screen.isatty() and environment.get('TERM', 'dumb') != 'dumb'


def _with_buffer(screen: TextIO) -> TextIO:
    """
    Return ``screen`` with a buffer, if it has none (``python -u``, PYTHONUNBUFFERED).

    Without a buffer, Python drops the rest of a write that a signal interrupts: SIGCHLD, while a
    full pipe waits for its reader.
    """
    if not isinstance(getattr(screen, 'buffer', None), io.RawIOBase):
        return screen
    return open(screen.fileno(), 'w', encoding=screen.encoding, closefd=False)


class Console:
    """All lines that a run prints go through here, one at a time."""

    def __init__(
        self,
        screen: TextIO,
        folder: LogFolder,
        *,
        colour: bool,
        erases: bool = False,
    ) -> None:
        """
        Write nothing yet.

        Args:
            screen: a text stream.
            folder: where the log files are.
            colour: whether the screen shows colours; see :func:`wants_colour`.
            erases: whether it can erase a line; see :func:`can_erase`.
        """
        self._screen: TextIO | None = _with_buffer(screen)
        self._folder = folder
        self._colour = colour
        self._reader_gone = False
        self._reader_gone_callback: Callable[[], None] | None = None
        self._name_colours: dict[str, str] = {}
        self._free_colours = itertools.cycle(_NAME_COLOURS)
        self._log_failure_shown = False
        self.erases = erases
        """Whether there is a status line."""
        self._status = ''
        self._is_lent = False
        if isinstance(self._screen, io.TextIOWrapper):
            self._screen.reconfigure(errors='backslashreplace')

    def on_reader_gone(self, callback: Callable[[], None]) -> None:
        """Call ``callback`` once, now or when nobody reads the screen any more (``| head``)."""
        self._reader_gone_callback = callback
        if self._reader_gone:
            callback()

    def log(self, level: Level, name: str, text: str) -> None:
        """Print ``[INFO] [name]: text``."""
        colour = _LEVEL_COLOURS.get(level, '')
        shown = f'[{level}] [{self._named(name, name)}]: {self._painted(text, colour)}'
        self._show(shown, f'[{level}] [{name}]: {text}', alarm=level != 'INFO')

    def output(self, name: str, line: str) -> None:
        """Print a line of a process's output, ``[name] line``; it goes to its log file, too."""
        self._folder.write(name, line)
        shown = f'{self._named(name, f"[{name}]")} {line}'
        self._show(shown, f'[{name}] {line}', alarm=bool(_ALARM.search(line)))

    @property
    def log_folder(self) -> str:
        """The path of the log files."""
        return str(self._folder.path)

    def log_path(self, name: str) -> str:
        """Return the path of a log file for a message, with ``~`` for the home folder."""
        return with_tilde(self._folder.path / f'{name}.log')

    def status(self, text: str) -> None:
        """Show ``text`` as the last line of the screen, in place of the one before."""
        text = text[: shutil.get_terminal_size().columns - 1]
        if self.erases and text != self._status and not self._is_lent:
            self._status = text
            self._write(_ERASE_LINE + text)

    def set_lent(self, is_lent: bool) -> None:
        """Show only warnings and errors while a process of the stack has the terminal."""
        self.status('')
        self._is_lent = is_lent

    def _show(self, line: str, logged: str, *, alarm: bool) -> None:
        self._folder.write(LAUNCH, f'{time.time():.7f} {logged}')
        if alarm or not self._is_lent:
            self._print(line)
        if self._folder.failure is not None and not self._log_failure_shown:
            self._log_failure_shown = True
            self._print(f'[WARNING] [{LAUNCH}]: no log files from here on: {self._folder.failure}')

    def _print(self, line: str) -> None:
        if self._is_lent and self.erases:  # it may be in raw mode, with the cursor in a line
            self._write(f'{_ERASE_LINE}{line}\r\n')
        elif self._status:
            self._write(f'{_ERASE_LINE}{line}\n{self._status}')
        else:
            self._write(f'{line}\n')

    def _write(self, text: str) -> None:
        if self._screen is None:
            return
        try:
            with as_foreground() if self._is_lent else contextlib.nullcontext():
                self._screen.write(text)
                self._screen.flush()
        except BlockingIOError:  # a terminal that another program made non-blocking is busy
            pass
        except OSError as error:  # a full disk costs the output, never the run
            screen, self._screen = self._screen, None
            with contextlib.suppress(OSError):
                screen.close()  # or else what it still holds would be a traceback at its end
            self._reader_gone = error.errno in (errno.EPIPE, errno.EIO)
            if self._reader_gone and self._reader_gone_callback:
                self._reader_gone_callback()

    def _named(self, name: str, text: str) -> str:
        if name == LAUNCH:
            return text
        if name not in self._name_colours:
            self._name_colours[name] = next(self._free_colours)
        return self._painted(text, self._name_colours[name])

    def _painted(self, text: str, colour: str) -> str:
        return f'{colour}{text}{_RESET}' if self._colour and colour else text
