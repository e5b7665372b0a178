# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An extension of colcon: a package that cannot be built does not stop those that do not need it.

colcon stops at the first failure unless told ``--continue-on-error``. Here a workspace of others
often has a package that needs a C++ library which PyPI lacks; the descriptions and messages beside
it are what the user wants. colcon ends with 1 all the same, and names what failed.

A ``setup.py`` that cannot be read is no failure to colcon, but an exception, which ends it with
three tracebacks. Here it is a failure, in one line.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import functools
import os
import re
import subprocess
import tempfile
from typing import Any

from colcon_core.event.output import StderrLine
from colcon_core.package_selection import PackageSelectionExtensionPoint
from colcon_core.plugin_system import satisfies_version
from colcon_core.task import TaskExtensionPoint

_OPTIONS = 'get_python_setup_options'
"""What colcon calls to read a setup.py, among the metadata of a package."""
_FRAME = re.compile(r'^ *File "([^"]+)", line (\d+)', re.MULTILINE)
_OF_SETUP_PY = '<string>'
"""As what distutils executes it."""


class ContinueOnError(PackageSelectionExtensionPoint):
    """Makes ``--continue-on-error`` the default; it selects nothing."""

    def __init__(self) -> None:
        """Check that colcon is one that this is made for."""
        super().__init__()
        satisfies_version(PackageSelectionExtensionPoint.EXTENSION_POINT_VERSION, '^1.0')

    def add_arguments(self, *, parser: Any) -> None:
        """Change the default: the verb has added the flag before."""
        parser.set_defaults(continue_on_error=True)

    def select_packages(self, *, args: Any, decorators: Any) -> None:
        """Leave the selection as it is; have each setup.py fail in one line."""
        for each in decorators:
            read = each.descriptor.metadata.get(_OPTIONS)
            if read is not None:
                each.descriptor.metadata[_OPTIONS] = in_one_line(read)
        # colcon has no other place where an exception of a task can become an exit code.
        TaskExtensionPoint.__call__ = failing(TaskExtensionPoint.__call__)


class SetupPyError(Exception):
    """A setup.py cannot be read; the text is the line about it."""


def in_one_line(read: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return what reads a setup.py, and raises SetupPyError in place of a traceback."""

    def guarded(environment: Any) -> Any:
        with captured_stderr() as said:
            try:
                return read(environment)
            except subprocess.CalledProcessError:
                raise SetupPyError(cause(said())) from None

    return guarded


@contextmanager
def captured_stderr() -> Iterator[Callable[[], str]]:
    """
    Keep what is written to stderr, also by child processes; yields a function that takes it.

    What nobody has taken is written at the end.
    """
    with tempfile.TemporaryFile() as file:

        def take() -> str:
            file.seek(0)
            text = file.read()
            file.seek(0)
            file.truncate()
            return text.decode(errors='replace')

        before = os.dup(2)
        os.dup2(file.fileno(), 2)
        try:
            yield take
        finally:
            os.dup2(before, 2)
            os.close(before)
            os.write(2, take().encode())


def cause(traceback: str) -> str:
    """Return the place in a setup.py and the error, of the traceback that Python printed."""
    lines = [line for line in traceback.splitlines() if line.strip()]
    places = [match[2] for match in _FRAME.finditer(traceback) if match[1] == _OF_SETUP_PY]
    where = f':{places[-1]}' if places else ''
    return f'setup.py{where}: {lines[-1] if lines else "it cannot be read"}'


def failing(call: Callable[..., Any]) -> Callable[..., Any]:
    """Return what calls a task, and takes a setup.py that cannot be read for a failure of it."""

    @functools.wraps(call)
    async def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        try:
            return await call(self, *args, **kwargs)
        except SetupPyError as error:
            self.context.put_event_into_queue(StderrLine(f'{error}\n'.encode()))
            return 1

    return called
