# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The robot description that the words of a node's command line name, before its ROS arguments.

``robot_state_publisher robot.urdf.xacro wheel_radius:=0.2 --ros-args …``
"""

from collections.abc import Callable, Sequence
import sys

from amr_description.model.description_file import (
    description_at,
    mappings_of,
    takes_arguments,
)
from amr_description.model.urdf import parse
from amr_description.ros_arguments import other_arguments, ros_arguments


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
