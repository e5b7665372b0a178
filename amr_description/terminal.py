# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The keys in what a terminal sends, and whose the terminal is.

An ordinary terminal does not report the release of a key. kitty, foot, WezTerm, Ghostty, Konsole,
iTerm2 and others do, on request (https://sw.kovidgoyal.net/kitty/keyboard-protocol/). Every key
then is

    CSI code:shifted:base ; modifiers:event ; text u

where ``code`` is the key without shift, ``base`` the key in its place on a US keyboard, ``event``
1 for a press, 2 for a repetition and 3 for a release. Arrow and function keys end in another
letter, or ``~``. Ctrl-C and Ctrl-Z are reports too, instead of signals.
"""

from dataclasses import dataclass
import os
import re

CTRL_C = '\x03'
CTRL_Z = '\x1a'

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


def is_in_foreground(descriptor: int) -> bool:
    """
    Return whether this job may read a terminal, and change its settings.

    A job in the background would be stopped by SIGTTIN or SIGTTOU, or overwrite the shell's
    settings. A terminal that is not the controlling one has no foreground job.
    """
    try:
        return os.tcgetpgrp(descriptor) == os.getpgrp()
    except OSError:
        return True


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
