# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of the robot description for a stack; xacro runs in a child process."""

import contextlib
import resource
import shlex
import signal
import subprocess
import sys

from amr_description.ament_index import path_of
from amr_description.entry import python_command
from amr_description.errors import BringupError, UsageError
from amr_description.model.mesh_paths import with_absolute_paths
from amr_description.model.origins import with_file
from amr_description.model.plain_xml import plain_xml
from amr_description.model.xacro_markup import is_xacro

_PROCESSOR_TIME = 60  # s; large robots take one or two
_MEMORY = 4 * 2**30  # bytes of address space
_EXPAND = python_command(
    'from amr_description.model.description_file import main; sys.exit(main(sys.argv[1:]))'
)


def robot_description(urdf: str, xacro_args: str = '') -> str:
    """
    Return the text of a URDF file, or what a xacro file expands to.

    Relative paths of meshes in it are made absolute.

    xacro runs in a child process, like launch's ``Command(['xacro ', …])``, with limits on time
    and memory: third-party expressions cannot harm the supervisor.

    Args:
        urdf: the file, as :func:`path_of` takes it.
        xacro_args: arguments of a xacro file as in a shell, ``a:=1 b:=2``.

    Raises:
        ResourceError: there is no such file.
        BringupError: it cannot be read or expanded.
        UsageError: ``xacro_args`` cannot be split, or the file is no xacro file.
    """
    path = path_of(urdf, 'urdf')
    if is_xacro(path):
        text = _expanded([str(path), *_words(xacro_args)])
        return with_absolute_paths(text, path.parent)
    if xacro_args.strip():
        raise UsageError(f"xacro_args:='{xacro_args}': {path} is no xacro file: it holds no xacro")
    try:
        text = plain_xml(path.read_text('utf-8-sig'))
        return with_absolute_paths(with_file(text, str(path)), path.parent)
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
        _limit(process.pid)
        try:
            text, log = (stream.decode(errors='replace') for stream in process.communicate())
        except BaseException:  # Ctrl-C
            process.kill()
            raise
    if process.returncode == -signal.SIGXCPU:
        raise BringupError(
            f'xacro: {words[0]}: no end after {_PROCESSOR_TIME} s; does an expression of it end?'
        )
    if process.returncode:
        reason = log.splitlines()[-1] if log else f'exit code {process.returncode}'
        raise BringupError(f'xacro: {reason}')
    print(log, end='', file=sys.stderr)
    return text


def _limit(pid: int) -> None:
    """Limit time and memory of a process; it then ends even if the supervisor is killed."""
    limits = {
        resource.RLIMIT_CPU: (_PROCESSOR_TIME, _PROCESSOR_TIME + 1),
        resource.RLIMIT_AS: (_MEMORY, _MEMORY),
        resource.RLIMIT_CORE: (0, 0),
    }
    for kind, limit in limits.items():
        # It may have ended already, or a lower limit may be set.
        with contextlib.suppress(ProcessLookupError, PermissionError, ValueError):
            resource.prlimit(pid, kind, limit)
