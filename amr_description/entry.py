# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The way into every executable: Ctrl-C is quiet from here on, also while libraries are imported.

``setup.py`` names ``amr_description.entry:nodes.talker.main`` in the place of
``amr_description.nodes.talker:main``. Importing rclpy or MuJoCo takes 0.1 s to 1 s, in which a
Ctrl-C would show where Python was. There is nothing to clean up yet, so the process just ends,
with exit code 130 as programs do on SIGINT. What the program itself does with Ctrl-C begins with
its ``main``; what it leaves to Python ends quietly, too.

Before it lies what no module can reach: the start of Python itself, and the few lines of the
script that setuptools writes, some 50 ms. Who starts the program can hold SIGINT back until then
by starting it with that signal blocked, as the bring-up does.
"""

from collections.abc import Callable
import importlib
import os
import signal

INTERRUPTED = 128 + signal.SIGINT


class LazyEntryPoint:
    """A function that is imported when it is called: ``LazyEntryPoint('package').module.function()``."""

    def __init__(self, path: str) -> None:
        """``path``: dotted name."""
        self.path = path

    def __getattr__(self, name: str) -> 'LazyEntryPoint':
        """Return what is below."""
        return LazyEntryPoint(f'{self.path}.{name}')

    def __call__(self) -> int | None:
        """Import the function and call it; return the exit code."""
        return run(self.find)

    def find(self) -> Callable[[], int | None]:
        """Import the function."""
        module, _, function = self.path.rpartition('.')
        return getattr(importlib.import_module(module), function)


def run(
    find: Callable[[], Callable[[], int | None]], interrupted: int = INTERRUPTED
) -> int | None:
    """
    Call the function that ``find`` imports; return its exit code, ``interrupted`` after Ctrl-C.

    SIGINT stays ignored where it was (a job in the background of a script).
    """
    is_heard = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if is_heard:
        # Not by an exception: out of an import it would be lost, or told by who catches it.
        signal.signal(signal.SIGINT, lambda *_: os._exit(interrupted))
    # A bring-up starts programs of this package with SIGINT blocked, so that its own Ctrl-C waits
    # until here: before, Python itself would tell of it.
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    main = find()
    try:
        if is_heard:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        return main()
    except KeyboardInterrupt:
        return interrupted


bringup = LazyEntryPoint('amr_description.bringup')
nodes = LazyEntryPoint('amr_description.nodes')
xacro = LazyEntryPoint('xacro')
