# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What joint_state_publisher is told about single joints, and how it reads a robot.

This module imports no rclpy.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
import math
from typing import Any

from amr_description.errors import ParameterError

_ZEROS, _DEPENDENT = 'zeros.', 'dependent_joints.'
PREFIXES = (_ZEROS, _DEPENDENT)
"""Of the parameters that bear the name of a joint."""


@dataclass(frozen=True, slots=True)
class Dependence:
    """position = ``factor`` · position of ``parent`` + ``offset``; velocities without offset."""

    parent: str
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class JointOptions:
    """How the joints are read; see the parameters of joint_state_publisher."""

    use_mimic_tags: bool = True
    use_smallest_joint_limits: bool = True
    publish_default_positions: bool = True
    publish_default_velocities: bool = False
    publish_default_efforts: bool = False
    zeros: Mapping[str, float] = field(default_factory=dict)
    dependent_joints: Mapping[str, Dependence] = field(default_factory=dict)


def zeros_of(given: Mapping[str, object]) -> dict[str, float]:
    """Return joint -> position from the parameters ``zeros.<joint>``."""
    return {
        name.removeprefix(_ZEROS): _number(name, value)
        for name, value in given.items()
        if name.startswith(_ZEROS)
    }


def dependent_joints_of(given: Mapping[str, object]) -> dict[str, Dependence]:
    """Return joint -> whom it follows, from ``dependent_joints.<joint>.parent`` and so on."""
    rows: dict[str, dict[str, Any]] = {}
    for name, value in given.items():
        joint, _, key = name.removeprefix(_DEPENDENT).rpartition('.')
        if not name.startswith(_DEPENDENT):
            continue
        if key == 'parent' and isinstance(value, str) and joint:
            rows.setdefault(joint, {})[key] = value
        elif key in ('factor', 'offset') and joint:
            rows.setdefault(joint, {})[key] = _number(name, value)
        else:
            raise ParameterError(
                f"parameter '{name}' is {value!r}; below dependent_joints.<joint> stand parent, "
                'the name of a joint, and the numbers factor and offset'
            )
    for joint, row in rows.items():
        if 'parent' not in row:
            raise ParameterError(f"dependent_joints.{joint} has no 'parent', the joint it follows")
    return {joint: Dependence(**row) for joint, row in rows.items()}


def _number(name: str, value: object) -> float:
    if type(value) not in (int, float) or not math.isfinite(value):
        raise ParameterError(f"parameter '{name}' must be a finite number, found {value!r}")
    return float(value)
