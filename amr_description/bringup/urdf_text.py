# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of the robot description that a stack is started with."""

import contextlib
import resource
import shlex
import signal
import subprocess
import sys

from amr_description.ament_index import path_of
from amr_description.errors import BringupError, UsageError
from amr_description.model.mesh_paths import with_absolute_paths

_PROCESSOR_TIME = 60  # s; large robots take one or two
_MEMORY = 4 * 2**30  # bytes of address space
_EXPAND = (sys.executable, '-P', '-m', 'amr_description.model.description_file')


def robot_description(urdf: str, xacro_args: str = '') -> str:
    """
    Return the URDF in a file or, of a xacro file, what it expands to; relative paths of meshes
    in it are made absolute.

    xacro runs in a process of its own, as launch's ``Command(['xacro ', …])`` has it: what a
    stranger's expressions do cannot harm the supervisor, and has bounded time and memory.

    :param urdf: The file, as :func:`path_of` takes it.
    :param xacro_args: Arguments of a xacro file as a shell would take them, ``a:=1 b:=2``.
    :raises BringupError: The file is not there, or cannot be read or expanded.
    """
    path = path_of(urdf)
    if path.suffix == '.xacro':
        text = _expanded([str(path), *_words(xacro_args)])
        return with_absolute_paths(text, path.parent)
    if xacro_args.strip():
        raise UsageError(f"xacro_args:='{xacro_args}': {path} is no xacro file (*.xacro)")
    try:
        return with_absolute_paths(path.read_text('utf-8'), path.parent)
    except (OSError, UnicodeDecodeError) as error:
        raise BringupError(f'cannot read the description {path}: {error}') from None


def _words(xacro_args: str) -> list[str]:
    try:
        return shlex.split(xacro_args)
    except ValueError as error:
        raise UsageError(f"xacro_args:='{xacro_args}': {error}") from None


def _expanded(words: list[str]) -> str:
    with subprocess.Popen(
        [*_EXPAND, *words],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        _bound(process.pid)
        try:
            text, said = (stream.decode(errors='replace') for stream in process.communicate())
        except BaseException:  # Ctrl-C
            process.kill()
            raise
    if process.returncode == -signal.SIGXCPU:
        raise BringupError(
            f'xacro: {words[0]}: no end after {_PROCESSOR_TIME} s; does an expression of it end?'
        )
    if process.returncode:
        reason = said.splitlines()[-1] if said else f'exit code {process.returncode}'
        raise BringupError(f'xacro: {reason}')
    print(said, end='', file=sys.stderr)
    return text


def _bound(pid: int) -> None:
    """Limit what a process may take, so that it ends also if the supervisor is killed."""
    limits = {
        resource.RLIMIT_CPU: (_PROCESSOR_TIME, _PROCESSOR_TIME + 1),
        resource.RLIMIT_AS: (_MEMORY, _MEMORY),
        resource.RLIMIT_CORE: (0, 0),
    }
    for kind, limit in limits.items():
        # It has ended already, or a lower limit is set.
        with contextlib.suppress(ProcessLookupError, PermissionError, ValueError):
            resource.prlimit(pid, kind, limit)
