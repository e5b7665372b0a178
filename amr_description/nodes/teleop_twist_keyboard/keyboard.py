# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Single keys from a terminal, whose settings are restored however the program ends.

:class:`Keyboard` reads keys at once and without echo; Ctrl-C and Ctrl-Z remain signals for the
whole job. Ctrl-Z is also reported as a key, so that the reader can stop the robot and then call
:meth:`Keyboard.suspend`; ``fg`` takes the terminal again.

:class:`KeyParser` finds the keys in what the terminal sends. An ordinary terminal does not report
the release of a key. kitty, foot, WezTerm, Ghostty, Konsole, iTerm2 and others do, on request
(https://sw.kovidgoyal.net/kitty/keyboard-protocol/). Every key then is

    CSI code:shifted:base ; modifiers:event ; text u

where ``code`` is the key without shift, ``base`` the key in its place on a US keyboard, ``event``
1 for a press, 2 for a repetition and 3 for a release. Arrow and function keys end in another
letter, or ``~``. Ctrl-C and Ctrl-Z are reports too, alternative of signals.

The terminal is asked for the protocol at the start; until its answer comes, if ever, keys are
ordinary ones. An answer that is still due when the terminal is given back is awaited for 0.5 s at
most: otherwise the shell would read it as input.

Imports no rclpy.
"""

import codecs
import contextlib
import copy
from dataclasses import dataclass
import os
import re
import select
import signal
import termios
import time
import tty
from types import FrameType, TracebackType
from typing import Self

from amr_description.errors import AmrError

CTRL_C = '\x03'
CTRL_Z = '\x1a'

ASK = '\x1b[?u\x1b[c'
"""Query the protocol, then the terminal's identity, which every terminal reports."""
BEGIN_REPORTS = '\x1b[>31u'
"""Enable all reports: bits 1 to 16 of the protocol."""
END_REPORTS = '\x1b[<u\x1b[c'
"""Restore the mode; everything typed before it precedes the answer with the identity."""

# An arrow or function key is one key: ESC [ parameters letter, or ESC O letter.
_TOKEN = re.compile(r'\x1b\[[0-?]*[ -/]*[@-~]|\x1bO.|.', re.DOTALL)
_BEGINNING = re.compile(r'\x1b(?:O|\[[0-?]*[ -/]*)?\Z')
_PROTOCOL = re.compile(r'\x1b\[\?\d*u')
_IDENTITY = re.compile(r'\x1b\[\?[\d;]*c')
_REPORT = re.compile(r'\x1b\[([\d:;]*)([u~A-Z])')

_SHIFT, _OTHER_MODIFIERS, _CAPS_LOCK = 0b1, 0b111110, 0b1000000
_CTRL = 0b100
_SIGNAL_KEYS = {'c': CTRL_C, 'z': CTRL_Z}
# Modifier keys by themselves: Caps Lock, Scroll Lock, Num Lock; from Left Shift on.
_MODIFIER_KEYS = frozenset({*range(57358, 57361), *range(57441, 57455)})
_SHIFTED = {',': '<', '.': '>'}  # on a US keyboard, of the keys in use
_RELEASE = 3

_RESUMED = '\x00'
_ON_SIGNAL = {signal.SIGTSTP: CTRL_Z, signal.SIGCONT: _RESUMED, signal.SIGQUIT: CTRL_C}
_SIGNAL_OF = {CTRL_C: signal.SIGINT, CTRL_Z: signal.SIGTSTP}
_MUTE_TERMINALS = ('', 'dumb', 'linux')  # values of TERM: they do not answer, or send garbage
_NO_KEY = b'\x00'  # _POSIX_VDISABLE of Linux

# s; within a sequence the next byte follows at once, after the key Escape nothing follows.
_ESCAPE_TIMEOUT = 0.05
_ANSWER_TIMEOUT = 0.5  # s: more than a round trip around the world


@dataclass(frozen=True, slots=True)
class KeyEvent:
    """
    One press, repetition or release of a key.

    ``key`` is the character that it types, or a whole escape sequence. ``name`` is the same for
    the press and the release of one key, even if Shift was pressed or released in between.
    """

    key: str
    name: str = ''
    is_release: bool = False


class KeyParser:
    """
    Finds the keys in the text that a terminal sends, piece by piece; no terminal, no clock.

    A sequence may arrive in two pieces. Its end must not be taken for other keys: the ``u`` of a
    report would drive the robot.
    """

    def __init__(self) -> None:
        self.offers_releases = False
        """Whether the terminal supports the kitty keyboard protocol."""
        self.identities = 0
        """How often the terminal has reported its identity."""
        self._beginning = ''

    @property
    def has_escape(self) -> bool:
        """Whether the text so far ends with Escape: the key, or the beginning of a sequence."""
        return self._beginning in ('\x1b', '\x1bO') and not self.offers_releases

    def feed(self, text: str) -> list[KeyEvent]:
        """Return the keys that are complete with ``text``; keep the rest."""
        text = self._beginning + text
        beginning = _BEGINNING.search(text)
        self._beginning = beginning[0] if beginning else ''
        whole = text.removesuffix(self._beginning)
        return [event for token in _TOKEN.findall(whole) if (event := self._event(token))]

    def flush(self) -> list[KeyEvent]:
        """Return an Escape that nothing has followed, as a key."""
        key, self._beginning = self._beginning, ''
        return [KeyEvent(key, key)] if key else []

    def _event(self, token: str) -> KeyEvent | None:
        if _PROTOCOL.fullmatch(token):
            self.offers_releases = True
        elif _IDENTITY.fullmatch(token):
            self.identities += 1
        elif report := _REPORT.fullmatch(token):
            return _reported(token, *report.groups())
        else:
            return KeyEvent(token, token)
        return None


def _reported(token: str, parameters: str, final: str) -> KeyEvent | None:
    """Return the key of a report; None for modifier keys."""
    fields = [[_number(word) for word in field.split(':')] for field in parameters.split(';')]
    code, _, base = (*fields[0], 0, 0)[:3]
    modifiers, kind = (*(fields[1] if len(fields) > 1 else ()), 0, 0)[:2]
    is_release = kind == _RELEASE
    if final != 'u':
        return KeyEvent(token, f'{code}{final}', is_release)
    if code in _MODIFIER_KEYS:
        return None
    letter = _character(code)
    if not letter.isascii() and base:  # a keyboard without Latin letters
        letter = _character(base)
    typed = ''.join(_character(each) for each in fields[2]) if len(fields) > 2 else ''
    return KeyEvent(
        _key(letter, typed, max(0, modifiers - 1)) or token, _character(code), is_release
    )


def _key(letter: str, typed: str, modifiers: int) -> str:
    """Return the character that an ordinary terminal would send for a key, or ''."""
    if modifiers & _OTHER_MODIFIERS:
        is_ctrl = modifiers & (_SHIFT | _OTHER_MODIFIERS) == _CTRL
        return _SIGNAL_KEYS.get(letter, '') if is_ctrl else ''
    if typed and typed.isascii():
        return typed
    if modifiers & _SHIFT:
        letter = _SHIFTED.get(letter, letter)
    is_upper = bool(modifiers & _SHIFT) != bool(modifiers & _CAPS_LOCK)
    return letter.upper() if is_upper else letter


def _number(word: str) -> int:
    """Return a parameter; 0 if it is empty, or above all characters."""
    number = int(word[:8] or 0)
    return number if number <= 0x10FFFF else 0


def _character(code: int) -> str:
    return chr(code) if code else ''


class Keyboard:
    """
    A context manager that reads the keys of a terminal; usable once, in the main thread only.

    Args:
        descriptor: the terminal, such as ``sys.stdin.fileno()``.
        alternative: what the user can do without a terminal, for the error.
        releases: request reports of the releases of keys.

    Raises:
        AmrError: ``descriptor`` is not a terminal.
    """

    def __init__(self, descriptor: int, *, alternative: str, releases: bool) -> None:
        if not os.isatty(descriptor):
            raise AmrError(
                'standard input is not a terminal, so there are no keys to read; run '
                'teleop_twist_keyboard in a terminal of its own, outside of a launch file or a '
                f'pipe, or {alternative}'
            )
        self._descriptor = descriptor
        self._parser = KeyParser()
        self._decoder = codecs.getincrementaldecoder('utf-8')(errors='replace')
        self._wants_reports = releases and os.environ.get('TERM', '') not in _MUTE_TERMINALS
        self._reports = False
        self._questions = 0
        self._answer_by = 0.0
        self._pipe_out, self._pipe_in = os.pipe()

    def __enter__(self) -> Self:
        self._attributes = termios.tcgetattr(self._descriptor)
        self._poll = select.poll()
        self._poll.register(self._pipe_out, select.POLLIN)
        self._poll.register(self._descriptor, select.POLLIN)
        self._handlers = {s: signal.signal(s, self._on_signal) for s in _ON_SIGNAL}
        self._take_terminal()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._give_terminal()
        for signum, handler in self._handlers.items():
            signal.signal(signum, handler)
        os.close(self._pipe_in)
        os.close(self._pipe_out)

    def stop(self) -> None:
        """Make :meth:`read` return Ctrl-C; on any thread."""
        os.write(self._pipe_in, CTRL_C.encode())

    def read(self, timeout: float | None) -> list[KeyEvent]:
        """
        Return the keys pressed so far; wait up to ``timeout`` s for the first, None: for ever.

        An arrow or function key is one string, its whole escape sequence. A closed terminal is
        reported as Ctrl-C.
        """
        if self._parser.has_escape:
            timeout = min(_ESCAPE_TIMEOUT, _ESCAPE_TIMEOUT if timeout is None else timeout)
        ready = dict(self._poll.poll(None if timeout is None else 1000.0 * timeout))
        if self._pipe_out in ready:
            keys = os.read(self._pipe_out, 16).decode()
            if _RESUMED in keys:
                self._take_terminal()
            return [KeyEvent(key) for key in keys.replace(_RESUMED, '')]
        events = ready.get(self._descriptor, 0)
        if events & ~select.POLLIN:
            return [KeyEvent(CTRL_C)]
        if events:
            return self._typed()
        return self._parser.flush() if self._parser.has_escape else []

    def suspend(self) -> None:
        """Give the terminal back, and stop until ``fg``; ignored by the kernel without a shell."""
        self._give_terminal()
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTSTP)
        signal.signal(signal.SIGTSTP, self._on_signal)
        self._take_terminal()

    def _typed(self) -> list[KeyEvent]:
        """Return the typed keys; none if a Ctrl-Z, which drops input, came in the meantime."""
        try:
            events = self._read_input()
        except OSError:  # EIO: the terminal is gone
            return [KeyEvent(CTRL_C)]
        if self._parser.offers_releases:
            self._enable_reports()
        for event in events:
            if event.key in _SIGNAL_OF and not event.is_release:
                os.killpg(0, _SIGNAL_OF[event.key])  # as the terminal would without the protocol
        return [event for event in events if event.key not in _SIGNAL_OF]

    def _read_input(self) -> list[KeyEvent]:
        return self._parser.feed(self._decoder.decode(os.read(self._descriptor, 1024)))

    def _on_signal(self, signum: int, _frame: FrameType | None) -> None:
        os.write(self._pipe_in, _ON_SIGNAL[signal.Signals(signum)].encode())

    def _take_terminal(self) -> None:
        if not self._is_in_foreground():
            return
        attributes = copy.deepcopy(self._attributes)
        tty.cfmakecbreak(attributes)
        attributes[tty.CC][termios.VMIN] = 0  # a read never waits
        attributes[tty.CC][termios.VQUIT] = _NO_KEY  # Ctrl-\ would end us without restoring
        attributes[tty.IFLAG] &= ~termios.IXON  # Ctrl-S and Ctrl-V are keys like any other
        attributes[tty.LFLAG] &= ~termios.IEXTEN
        with contextlib.suppress(termios.error):  # the terminal is gone
            termios.tcsetattr(self._descriptor, termios.TCSANOW, attributes)
        if self._wants_reports:
            self._wants_reports = False
            self._ask(ASK)
        elif self._parser.offers_releases:
            self._enable_reports()

    def _give_terminal(self) -> None:
        """Restore the settings, and drop the keys not yet read: they are not for the shell."""
        if not self._is_in_foreground():
            return
        if self._reports:
            self._reports = False
            self._ask(END_REPORTS)
        self._await_answers()
        with contextlib.suppress(termios.error):  # the terminal is gone
            termios.tcsetattr(self._descriptor, termios.TCSANOW, self._attributes)
            termios.tcflush(self._descriptor, termios.TCIFLUSH)

    def _enable_reports(self) -> None:
        if not self._reports:
            self._reports = True
            self._write(BEGIN_REPORTS)

    def _ask(self, question: str) -> None:
        self._questions += 1
        self._answer_by = time.monotonic() + _ANSWER_TIMEOUT
        self._write(question)

    def _await_answers(self) -> None:
        """Read what the terminal sends up to its last answer, within the time for it."""
        terminal = select.poll()
        terminal.register(self._descriptor, select.POLLIN)
        while self._parser.identities < self._questions:
            left = self._answer_by - time.monotonic()
            if left <= 0.0 or terminal.poll(1000.0 * left) != [(self._descriptor, select.POLLIN)]:
                return
            try:
                self._read_input()
            except OSError:  # EIO: the terminal is gone
                return

    def _write(self, text: str) -> None:
        with contextlib.suppress(OSError):  # opened for reading only, or gone
            os.write(self._descriptor, text.encode())

    def _is_in_foreground(self) -> bool:
        """
        Return whether this job may change the settings of the terminal.

        A job in the background would be stopped by SIGTTOU, or overwrite the shell's settings. A
        terminal that is not the controlling one has no foreground job.
        """
        try:
            return os.tcgetpgrp(self._descriptor) == os.getpgrp()
        except OSError:
            return True
