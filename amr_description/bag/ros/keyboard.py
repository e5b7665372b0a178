# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Keys of a terminal that control recorders and players, read in a thread of its own."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
import os
import re
import select
import sys
import termios
import threading
import tty

SPACE, UP, DOWN, RIGHT = 'SPACE', 'CURSOR_UP', 'CURSOR_DOWN', 'CURSOR_RIGHT'
_NAMES = {b' ': SPACE, b'A': UP, b'B': DOWN, b'C': RIGHT}
# An arrow is ESC [ letter, or ESC O letter; with other keys held down there are numbers, too.
_TOKEN = re.compile(rb'\x1b(?:\[[0-?]*[ -/]*[@-~]|O.)?|[^\x1b]', re.DOTALL)
_ARROW = re.compile(rb'\x1b[\[O]([ABC])')


def names_of(text: bytes) -> list[str]:
    """Return the names of the keys in what a terminal has sent; others are left out."""
    found = []
    for token in _TOKEN.findall(text):
        arrow = _ARROW.fullmatch(token)
        name = _NAMES.get(arrow[1] if arrow else token if token == b' ' else b'')
        if name:
            found.append(name)
    return found


@contextmanager
def keys(bindings: Mapping[str, Callable[[], object]]) -> Iterator[bool]:
    """
    Call functions when keys are pressed, in another thread, while inside.

    The settings of the terminal are restored at the end. In the background of a shell nothing is
    read: it would stop the whole job.

    Args:
        bindings: The function of each key, by its name.

    Yields:
        False: standard input is no terminal, so there are no keys.
    """
    terminal = _terminal()
    if terminal is None:
        yield False
        return
    settings = termios.tcgetattr(terminal)
    ended, end = os.pipe()
    thread = threading.Thread(
        target=_read, args=(terminal, ended, bindings), name='keyboard', daemon=True
    )
    tty.setcbreak(terminal, termios.TCSANOW)
    try:
        thread.start()
        yield True
    finally:
        os.close(end)
        thread.join()
        os.close(ended)
        termios.tcsetattr(terminal, termios.TCSADRAIN, settings)


def _terminal() -> int | None:
    try:
        descriptor = sys.stdin.fileno()
        is_ours = os.isatty(descriptor) and os.tcgetpgrp(descriptor) == os.getpgrp()
    except (AttributeError, OSError, ValueError):  # closed
        return None
    return descriptor if is_ours else None


def _read(terminal: int, ended: int, bindings: Mapping[str, Callable[[], object]]) -> None:
    while True:
        ready, _, _ = select.select([terminal, ended], [], [])
        if ended in ready:
            return
        try:
            text = os.read(terminal, 1024)
        except OSError:  # the terminal was closed
            return
        if not text:
            return
        for name in names_of(text):
            if name in bindings:
                bindings[name]()
