# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Keys of a terminal that control recorders and players, read in a thread of its own."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
import os
import re
import select
import signal
import sys
import termios
import threading
import tty

from amr_description.terminal import is_in_foreground, KeyParser

SPACE, UP, DOWN, RIGHT = 'SPACE', 'CURSOR_UP', 'CURSOR_DOWN', 'CURSOR_RIGHT'
_NAMES = {' ': SPACE, 'A': UP, 'B': DOWN, 'C': RIGHT}
_ARROW = re.compile(r'\x1b[\[O]([ABC])')
_LOCAL_MODES = 3  # of what tcgetattr returns
_PERIOD = 0.3  # s between two looks whose the terminal is


def names_of(text: str, parser: KeyParser | None = None) -> list[str]:
    """Return the names of the keys in what a terminal has sent; others are left out."""
    found = []
    for event in (parser or KeyParser()).feed(text):
        arrow = _ARROW.fullmatch(event.key)
        name = _NAMES.get(arrow[1] if arrow else event.key if event.key == ' ' else '')
        if name and not event.is_release:
            found.append(name)
    return found


@contextmanager
def keys(bindings: Mapping[str, Callable[[], object]]) -> Iterator[bool]:
    """
    Call functions when keys are pressed, in another thread, while inside.

    The settings of the terminal are restored at the end. While the job is in the background of a
    shell nothing is read: that would stop it.

    Args:
        bindings: The function of each key, by its name.

    Yields:
        False: there are no keys; a line on stderr says so if standard input is no terminal.
    """
    terminal = _terminal() if bindings else None
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
        if is_in_foreground(terminal):
            termios.tcsetattr(terminal, termios.TCSADRAIN, settings)


def _terminal() -> int | None:
    try:
        descriptor = sys.stdin.fileno()
        if os.isatty(descriptor):
            return descriptor if is_in_foreground(descriptor) else None
    except (AttributeError, OSError, ValueError):  # closed
        pass
    print('stdin is not a terminal device. Keyboard handling disabled.', file=sys.stderr)
    return None


def _read(terminal: int, ended: int, bindings: Mapping[str, Callable[[], object]]) -> None:
    # After Ctrl-Z and `bg` a read fails, instead of stopping the job.
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTTIN, signal.SIGTTOU])
    parser = KeyParser()
    while True:
        is_ours = is_in_foreground(terminal)
        if is_ours:
            _have_keys_at_once(terminal)
        sources = [terminal, ended] if is_ours else [ended]
        ready, _, _ = select.select(sources, [], [], _PERIOD)
        if ended in ready:
            return
        if terminal not in ready or not is_in_foreground(terminal):
            continue
        # It may have been a line for the shell, which has read it and given the terminal back.
        _have_keys_at_once(terminal)
        if not select.select([terminal], [], [], 0)[0]:
            continue
        try:
            text = os.read(terminal, 1024).decode(errors='replace')
        except OSError:
            if is_in_foreground(terminal):  # it was closed
                return
            continue
        if not text:
            return
        for name in names_of(text, parser):
            if name in bindings:
                bindings[name]()


def _have_keys_at_once(terminal: int) -> None:
    """
    Set the terminal to send keys, not lines, if a shell has set it otherwise.

    A shell does so when it takes the terminal, and need not give it back as it was: after Ctrl-Z,
    ``bg`` and ``fg`` bash leaves it to send lines. All that may pass between two looks.
    """
    with suppress(termios.error):  # it was closed, which is read next
        if termios.tcgetattr(terminal)[_LOCAL_MODES] & termios.ICANON:
            tty.setcbreak(terminal, termios.TCSANOW)
