# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of the robot description for a stack; xacro runs in a child process."""

import shlex
import sys

from amr_description.ament_index import path_of
from amr_description.entry import python_command
from amr_description.errors import BringupError, LimitError, UsageError
from amr_description.limited_child import Limits, run_limited
from amr_description.model.mesh_paths import with_absolute_paths
from amr_description.model.origins import with_file
from amr_description.model.plain_xml import plain_xml
from amr_description.model.xacro_markup import is_xacro

_LIMITS = Limits(seconds=60)  # large robots take one or two
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
    try:
        ended = run_limited([*_EXPAND, *words], _LIMITS)
    except LimitError as error:
        raise BringupError(f'xacro: {words[0]}: {error}; does an expression of it end?') from None
    if ended.code:
        reason = ended.log.splitlines()[-1] if ended.log else f'exit code {ended.code}'
        raise BringupError(f'xacro: {reason}')
    print(ended.log, end='', file=sys.stderr)
    return ended.text
