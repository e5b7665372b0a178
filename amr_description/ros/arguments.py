# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The words of a node's command line: its ROS arguments, and a robot description named before them.

``robot_state_publisher robot.urdf.xacro wheel_radius:=0.2 --ros-args …``

rcl's grammar of ROS arguments, between ``--ros-args`` and ``--`` (or the end)::

    -r, --remap [NODE:]FROM:=TO     -p, --param [NODE:]NAME:=VALUE     --params-file FILE
    --log-level LEVEL   --log-config-file FILE   -e, --enclave ENCLAVE
    --enable-… and --disable-… rosout-logs, stdout-logs, external-lib-logs
"""

from collections.abc import Callable, Iterator, Sequence
import sys

from amr_description.model.description_file import (
    description_at,
    mappings_of,
    takes_arguments,
)
from amr_description.model.urdf import parse

_IDENTITY = ('__node:=', '__name:=', '__ns:=')
_RULES = ('-r', '--remap', '-p', '--param')
_WITHOUT_VALUE = ('--enable-', '--disable-')


def ros_arguments(words: Sequence[str]) -> list[str]:
    """Return the ROS arguments among the words of a command line, without ``--ros-args``."""
    found: list[str] = []
    is_ros = False
    for word in words:
        if word == '--ros-args':
            is_ros = True
        elif word == '--':
            is_ros = False
        elif is_ros:
            found.append(word)
    return found


def other_arguments(words: Sequence[str]) -> list[str]:
    """
    Return what :func:`ros_arguments` leaves.

    rclpy's ``remove_ros_args`` also takes ``name:=value`` away, the remapping rules of ROS 1.
    """
    found: list[str] = []
    is_ros = False
    for word in words:
        if word == '--ros-args':
            is_ros = True
        elif is_ros and word == '--':
            is_ros = False
        elif not is_ros:
            found.append(word)
    return found


def files_in(arguments: Sequence[str]) -> list[str]:
    """Return the parameter files among ROS arguments, in their order."""
    return [value[0] for flag, *value in _flags(arguments) if flag == '--params-file' and value]


def parameters_in(words: Sequence[str]) -> dict[str, str]:
    """Return the parameters that a command line sets for any node, as they are written."""
    pairs = [
        _remapped(value).partition(':=')
        for flag, *value in _flags(ros_arguments(words))
        if flag in ('-p', '--param')
    ]
    return {name: value for name, sign, value in pairs if sign}


def inherited(arguments: Sequence[str], *, with_parameters: bool = True) -> list[str]:
    """
    Return what of a node's ROS arguments goes on to the nodes that it makes.

    Not its name and namespace, which would make all of them namesakes. ``with_parameters``: its
    parameters and parameter files too, as a controller manager's go to its controllers, all but
    where it has its ``robot_description`` from.
    """
    own = (*_IDENTITY, 'robot_description:=') if with_parameters else _IDENTITY
    kept: list[str] = []
    for flag, *value in _flags(arguments):
        is_own = flag in _RULES and _remapped(value).startswith(own)
        is_parameter = flag in ('-p', '--param', '--params-file')
        if not is_own and (with_parameters or not is_parameter):
            kept += [flag, *value]
    return kept


def _flags(arguments: Sequence[str]) -> Iterator[list[str]]:
    """Each flag with its value, if it takes one."""
    words = iter(arguments)
    for flag in words:
        value = None if flag.startswith(_WITHOUT_VALUE) else next(words, None)
        yield [flag] if value is None else [flag, value]


def _remapped(value: Sequence[str]) -> str:
    """The rule without the node that it may be limited to: ``amr:__ns:=/a`` is ``__ns:=/a``."""
    rule = value[0] if value else ''
    node, colon, rest = rule.partition(':')
    return rest if colon and not rest.startswith('=') else rule


def split_arguments(args: Sequence[str] | None) -> tuple[list[str], list[str]]:
    """
    Return the words about the description, which may be none, and what rclpy is to be given.

    :param args: The command line without the program's name; None: that of the process.

    rcl takes every ``name:=value`` for a remapping rule of ROS 1, and it stays one where there is
    no xacro file that it could be an argument of.
    """
    given = list(sys.argv[1:] if args is None else args)
    words = other_arguments(given)
    files = [word for word in words if ':=' not in word]
    if files and takes_arguments(files[0]):
        words.remove(files[0])
        return [files[0], *words], ['--ros-args', *ros_arguments(given)]
    return files[:1], given


def read_description(words: Sequence[str], warn: Callable[[str], object]) -> str:
    """
    Return the URDF that the words name: ``FILE NAME:=VALUE …``; it is sound as a tree of links.

    FILE is a path, or a URI: ``package://amr_description/urdf/amr.urdf``.

    :raises AmrError: It cannot be read, expanded or parsed; the line names the file.
    """
    path, *mappings = words
    text = description_at(path, mappings_of(mappings), warn=warn)
    parse(text, path)
    return text
