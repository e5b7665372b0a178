# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of the robot description that a stack is started with."""

import shlex
import subprocess
import sys

from amr_description.bringup.packages import path_of
from amr_description.errors import BringupError, UsageError

_EXPAND = (sys.executable, '-P', '-m', 'amr_description.model.description_file')


def robot_description(urdf: str, xacro_args: str = '') -> str:
    """
    Return the URDF in a file or, of a xacro file, what it expands to.

    xacro runs in a process of its own, as launch's ``Command(['xacro ', …])`` has it: what a
    stranger's expressions do cannot harm the supervisor. It ends with Ctrl-C.

    :param urdf: The file, as :func:`path_of` takes it.
    :param xacro_args: Arguments of a xacro file as a shell would take them, ``a:=1 b:=2``.
    :raises BringupError: The file is not there, or cannot be read or expanded.
    """
    path = path_of(urdf)
    if path.suffix == '.xacro':
        return _expanded([str(path), *_words(xacro_args)])
    if xacro_args.strip():
        raise UsageError(f"xacro_args:='{xacro_args}': {path} is no xacro file (*.xacro)")
    try:
        return path.read_text('utf-8')
    except (OSError, UnicodeDecodeError) as error:
        raise BringupError(f'cannot read the description {path}: {error}') from None


def _words(xacro_args: str) -> list[str]:
    try:
        return shlex.split(xacro_args)
    except ValueError as error:
        raise UsageError(f"xacro_args:='{xacro_args}': {error}") from None


def _expanded(words: list[str]) -> str:
    done = subprocess.run([*_EXPAND, *words], stdin=subprocess.DEVNULL, capture_output=True)
    said = done.stderr.decode(errors='replace')
    if done.returncode:
        reason = said.splitlines()[-1] if said else f'exit code {done.returncode}'
        raise BringupError(f'xacro: {reason}')
    print(said, end='', file=sys.stderr)
    return done.stdout.decode()
