# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Keys out of what a terminal sends: its characters, and the reports of the kitty keyboard protocol.

An ordinary terminal tells no release of a key. kitty, foot, WezTerm, Ghostty, Konsole, iTerm2 and
others do, when asked to (https://sw.kovidgoyal.net/kitty/keyboard-protocol/). Every key then is

    CSI code:shifted:base ; modifiers:event ; text u

where ``code`` is the key without shift, ``base`` the one in its place on a US keyboard, ``event``
1 for a press, 2 for a repetition and 3 for a release. Arrow and function keys end in another
letter, or ``~``. Ctrl-C and Ctrl-Z are reports too, and no signals.

This module imports no rclpy and knows no terminal and no clock: text comes in.
"""

from dataclasses import dataclass
import re

CTRL_C = '\x03'
CTRL_Z = '\x1a'

ASK = '\x1b[?u\x1b[c'
"""Ask for the protocol, then for the terminal's identity, which every terminal tells."""
BEGIN_REPORTS = '\x1b[>31u'
"""From now on report all of it: bits 1 to 16 of the protocol."""
END_REPORTS = '\x1b[<u\x1b[c'
"""As before; what was typed until then comes before the answer with the identity."""

# An arrow or function key is one key: ESC [ parameters letter, or ESC O letter.
_TOKEN = re.compile(r'\x1b\[[0-?]*[ -/]*[@-~]|\x1bO.|.', re.DOTALL)
_BEGINNING = re.compile(r'\x1b(?:O|\[[0-?]*[ -/]*)?\Z')
_PROTOCOL = re.compile(r'\x1b\[\?\d*u')
_IDENTITY = re.compile(r'\x1b\[\?[\d;]*c')
_REPORT = re.compile(r'\x1b\[([\d:;]*)([u~A-Z])')

_SHIFT, _OTHER_MODIFIERS, _CAPS_LOCK = 0b1, 0b111110, 0b1000000
_CTRL = 0b100
_SIGNAL_KEYS = {'c': CTRL_C, 'z': CTRL_Z}
# Shift and the like, by themselves: Caps Lock, Scroll Lock, Num Lock; then Left Shift and on.
_MODIFIER_KEYS = frozenset({*range(57358, 57361), *range(57441, 57455)})
_SHIFTED = {',': '<', '.': '>'}  # of a US keyboard, as far as it matters
_RELEASE = 3


@dataclass(frozen=True, slots=True)
class KeyEvent:
    """
    One press, or repetition, or release of a key.

    ``key`` is what it types, or a whole escape sequence; ``name`` is the same for the press and
    the release of one key, whatever became of Shift in between.
    """

    key: str
    name: str = ''
    is_release: bool = False


class KeyParser:
    """
    The keys in what a terminal sends, piece by piece.

    A sequence may arrive in two pieces: its end must not be taken for keys of its own (the ``u``
    of a report drives a robot).
    """

    def __init__(self) -> None:
        self.offers_releases = False
        """Whether the terminal has said that it knows the kitty keyboard protocol."""
        self.identities = 0
        """How often the terminal has told its identity."""
        self._beginning = ''

    @property
    def has_escape(self) -> bool:
        """Whether an Escape came last: the key, or the beginning of a sequence."""
        return self._beginning in ('\x1b', '\x1bO') and not self.offers_releases

    def feed(self, text: str) -> list[KeyEvent]:
        """Return the keys that are whole with ``text``, and remember the rest of it."""
        text = self._beginning + text
        beginning = _BEGINNING.search(text)
        self._beginning = beginning[0] if beginning else ''
        whole = text.removesuffix(self._beginning)
        return [event for token in _TOKEN.findall(whole) if (event := self._event(token))]

    def flush(self) -> list[KeyEvent]:
        """Return the Escape that nothing followed, as the key that it was."""
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
    """Return the key of a report; None for Shift and the like."""
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
    """Return what a key types, '' for nothing that an ordinary terminal would tell."""
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
    """Return a parameter, 0 if it is left out or no character's."""
    number = int(word[:8] or 0)
    return number if number <= 0x10FFFF else 0


def _character(code: int) -> str:
    return chr(code) if code else ''
