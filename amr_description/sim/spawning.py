# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Checks of a request to spawn an entity, before MuJoCo gets it: name, pose, description.

What is rejected raises a SpawnError with the ``result`` code of
``simulation_interfaces/srv/SpawnEntity``.
"""

from collections.abc import Collection, Iterable, Iterator, Sequence
import enum
import math
from pathlib import Path
import re

from amr_description.errors import DescriptionError, SpawnError
from amr_description.log import Log, null_log, Severity
from amr_description.model.checks import require_sound
from amr_description.model.findings import Finding
from amr_description.model.frames import Quaternion, Transform
from amr_description.model.gazebo.translation import translate
from amr_description.model.robot import Robot
from amr_description.text import one_line, shorten

_QUOTED = re.compile(r'"[^"]*"')
_MOST_KINDS = 6
_SHORT = 30
_FARTHEST = 1e8
"""m; numerics of physics are lost beyond."""
_LONGEST_NAME = 200
_LONGEST_NAMESPACE = 245
"""rcl's limit."""
_NAME = re.compile(r'[A-Za-z0-9_.-]+')


class SpawnCode(enum.IntEnum):
    """Codes of ``simulation_interfaces`` 1.5.1: ``Result`` below 100, ``SpawnEntity`` above."""

    FEATURE_UNSUPPORTED = 0
    OK = 1
    NOT_FOUND = 2
    INCORRECT_STATE = 3
    OPERATION_FAILED = 4
    NAME_NOT_UNIQUE = 101
    NAME_INVALID = 102
    UNSUPPORTED_FORMAT = 103
    NO_RESOURCE = 104
    NAMESPACE_INVALID = 105
    RESOURCE_PARSE_ERROR = 106
    MISSING_ASSETS = 107
    UNSUPPORTED_ASSETS = 108
    INVALID_POSE = 109


def check_name(name: str, taken: Collection[str]) -> None:
    """
    Raise SpawnError: the name is taken, too long, or has other than letters, digits and ``_ . -``.
    """
    if len(name) > _LONGEST_NAME:
        raise SpawnError(
            f"'{shorten(name)}' cannot name an entity: it has {len(name)} characters, and "
            f'{_LONGEST_NAME} are the most',
            SpawnCode.NAME_INVALID,
        )
    if not _NAME.fullmatch(name):
        raise SpawnError(
            f"'{one_line(name)}' cannot name an entity: letters, digits and _ . - will do",
            SpawnCode.NAME_INVALID,
        )
    if name in taken:
        raise SpawnError(
            f"there is already an entity '{name}'; give another name, or remove it first "
            f'(there are: {", ".join(taken)})',
            SpawnCode.NAME_NOT_UNIQUE,
        )


def free_name(name: str, taken: Collection[str]) -> str:
    """Return ``name``, or the first of ``name_1``, ``name_2`` … that is not taken."""
    candidate, number = name, 0
    while candidate in taken:
        number += 1
        candidate = f'{name}_{number}'
    return candidate


def checked_pose(pose: Transform) -> Transform:
    """Return the pose with a unit quaternion. Raises SpawnError: not finite, huge, or 0."""
    values = (*pose.translation, *pose.rotation)
    length = math.hypot(*pose.rotation)
    if not all(abs(each) <= _FARTHEST for each in values) or length < 1e-6:
        raise SpawnError(
            f'the initial pose is position {pose.translation}, orientation (x, y, z, w) '
            f'{pose.rotation}; finite numbers, up to {_FARTHEST:g}, and a quaternion of length 1 '
            'are needed',
            SpawnCode.INVALID_POSE,
        )
    x, y, z, w = (part / length for part in pose.rotation)
    rotation: Quaternion = (x, y, z, w)
    return Transform(pose.translation, rotation)


def checked_namespace(namespace: str) -> str:
    """Return a namespace, absolute. Raises SpawnError: ROS does not allow it."""
    absolute = f'/{namespace.removeprefix("/")}'
    parts = absolute.removeprefix('/').split('/')
    if len(absolute) > _LONGEST_NAMESPACE or (
        absolute != '/' and not all(part.isidentifier() and part.isascii() for part in parts)
    ):
        raise SpawnError(
            f"the entity's namespace is '{one_line(shorten(namespace))}', which ROS does not "
            "allow: its parts are letters, digits and '_', and do not begin with a digit, and "
            f'{_LONGEST_NAMESPACE} characters are the most',
            SpawnCode.NAMESPACE_INVALID,
        )
    return absolute


def read_description(
    text: str,
    source: str,
    log: Log = null_log,
    strict: bool = False,
    files: Sequence[Path] | None = None,
    namespace: str = '',
) -> Robot:
    """
    Read and check the URDF of a robot; plugins of Gazebo that move it become hardware.

    Args:
        text: The URDF.
        source: What messages call the text, such as its path.
        log: Gets the checker's warnings.
        strict: Refuse also what a simulator can make something of.
        files: The parameter files of its controllers; None: those that it names.
        namespace: In which it is to be spawned, absolute, and so are the sections of its
            controllers; empty: that of the description.

    Raises:
        SpawnError: The text is empty, has another format, or has an error by the checker.
    """
    if not text.strip():
        raise SpawnError('no robot description: resource_string is empty', SpawnCode.NO_RESOURCE)
    for tag, language in (('<sdf', 'SDF'), ('<mujoco', 'MJCF')):
        head, found, _ = text.partition(tag)
        if found and '<robot' not in head:
            raise SpawnError(
                f'{source}: the description is {language}; this simulator spawns URDF: give it '
                'that of the robot, as by -topic robot_description; its <gazebo> tags hold the '
                'plugins and sensors (docs/from_gazebo.md)',
                SpawnCode.UNSUPPORTED_FORMAT,
            )
    try:
        robot, warnings = require_sound(text, source, strict)
    except DescriptionError as cause:
        raise SpawnError(str(cause), SpawnCode.RESOURCE_PARSE_ERROR) from cause
    for line in _lines(warnings, source):
        log(Severity.WARN, line)
    return translate(robot, files, namespace).robot


def _lines(warnings: Iterable[Finding], source: str) -> Iterator[str]:
    """
    Yield a line for each fault with what is made of it, then one line for all others.

    Those are for :program:`check_urdf`, which lists them; one that is alone is told as it is.
    """
    others: dict[str, list[Finding]] = {}
    for warning in warnings:
        if warning.taken:
            yield warning.text
        else:
            others.setdefault(_QUOTED.sub('', warning.what), []).append(warning)
    if not others:
        return
    kinds = list(others.values())
    count = sum(map(len, kinds))
    if count == 1:
        yield kinds[0][0].text
        return
    texts = [_counted(kind) for kind in kinds[:_MOST_KINDS]]
    if len(kinds) > _MOST_KINDS:
        texts.append(f'{sum(map(len, kinds[_MOST_KINDS:]))} others')
    places = {each.source for kind in kinds for each in kind}
    place = places.pop() if len(places) == 1 else source
    yield f'{place}: {count} warnings, which check_urdf lists in full: {"; ".join(texts)}'


def _counted(kind: Sequence[Finding]) -> str:
    """Return the first of some faults alike, and how many more there are."""
    first, *others = kind
    text = first.what
    if 0 < len(first.found) <= _SHORT:
        text += f': found {first.found}'
    return f'{text} (and {len(others)} more like it)' if others else text
