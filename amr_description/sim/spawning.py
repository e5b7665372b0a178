# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The request to spawn an entity, checked before MuJoCo sees it.

Every refusal is a SpawnError with the ``result`` code of ``simulation_interfaces/SpawnEntity``.
"""

from collections.abc import Collection
import enum
import math
import re

from amr_description.control.contracts import Log, null_log, Severity
from amr_description.errors import DescriptionError, SpawnError
from amr_description.model.checks import require_sound
from amr_description.model.frames import Quaternion, Transform
from amr_description.model.robot import Robot

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
    """Refuse a name that is taken, or that is not made of letters, digits and ``_ . -``."""
    if not _NAME.fullmatch(name):
        raise SpawnError(
            f"'{name}' cannot name an entity: letters, digits and _ . - will do",
            SpawnCode.NAME_INVALID,
        )
    if name in taken:
        raise SpawnError(
            f"there is already an entity '{name}'; give another name, or remove it first "
            f'(there are: {", ".join(taken)})',
            SpawnCode.NAME_NOT_UNIQUE,
        )


def free_name(name: str, taken: Collection[str]) -> str:
    """``name``, or with ``allow_renaming`` the first of ``name_1``, ``name_2`` … that is free."""
    candidate, number = name, 0
    while candidate in taken:
        number += 1
        candidate = f'{name}_{number}'
    return candidate


def checked_pose(pose: Transform) -> Transform:
    """The pose with a unit quaternion; refused when not finite or without a direction."""
    values = (*pose.translation, *pose.rotation)
    length = math.hypot(*pose.rotation)
    if not all(map(math.isfinite, values)) or length < 1e-6:
        raise SpawnError(
            f'the initial pose is position {pose.translation}, orientation (x, y, z, w) '
            f'{pose.rotation}; finite numbers and a quaternion of length 1 are needed',
            SpawnCode.INVALID_POSE,
        )
    x, y, z, w = (part / length for part in pose.rotation)
    rotation: Quaternion = (x, y, z, w)
    return Transform(pose.translation, rotation)


def read_description(text: str, source: str, log: Log = null_log) -> Robot:
    """
    The robot of a URDF; ``source`` names the text in messages.

    What the checker warns of goes to the log. Refused: no text, another format than URDF, and what
    the checker calls an error.
    """
    if not text.strip():
        raise SpawnError('no robot description: resource_string is empty', SpawnCode.NO_RESOURCE)
    for tag, language in (('<sdf', 'SDF'), ('<mujoco', 'MJCF')):
        head, found, _ = text.partition(tag)
        if found and '<robot' not in head:
            raise SpawnError(
                f'{source}: the description is {language}; this simulator spawns URDF',
                SpawnCode.UNSUPPORTED_FORMAT,
            )
    try:
        robot, warnings = require_sound(text, source)
    except DescriptionError as cause:
        raise SpawnError(str(cause), SpawnCode.RESOURCE_PARSE_ERROR) from cause
    for warning in warnings:
        log(Severity.WARN, warning.text)
    return robot
