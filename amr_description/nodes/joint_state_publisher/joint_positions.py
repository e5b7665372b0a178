# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joints of ``joint_state_publisher``: their options, ranges, positions, and what follows what.

Imports no rclpy. Positions are in rad or m, velocities in rad/s or m/s, efforts in N·m or N.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
import math
from typing import Any

from amr_description.errors import DescriptionError, ParameterError
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.text import quote, quote_all

_ZEROS, _DEPENDENT = 'zeros.', 'dependent_joints.'
PREFIXES = (_ZEROS, _DEPENDENT)
"""Prefixes of the parameters that are named after joints."""


@dataclass(frozen=True, slots=True)
class Dependence:
    """position = ``factor`` · position of ``parent`` + ``offset``; velocities without offset."""

    parent: str
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class JointOptions:
    """See the parameters of joint_state_publisher."""

    use_mimic_tags: bool = True
    use_smallest_joint_limits: bool = True
    publish_default_positions: bool = True
    publish_default_velocities: bool = False
    publish_default_efforts: bool = False
    zeros: Mapping[str, float] = field(default_factory=dict)
    dependent_joints: Mapping[str, Dependence] = field(default_factory=dict)


def zeros_of(given: Mapping[str, object]) -> dict[str, float]:
    """Return joint -> initial position, from parameters ``zeros.<joint>``."""
    return {
        name.removeprefix(_ZEROS): _number(name, value)
        for name, value in given.items()
        if name.startswith(_ZEROS)
    }


def dependent_joints_of(given: Mapping[str, object]) -> dict[str, Dependence]:
    """Return joint -> what it follows, from parameters ``dependent_joints.<joint>.…``."""
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


def _number(name: str, value: Any) -> float:
    if type(value) not in (int, float) or not math.isfinite(value):
        raise ParameterError(f"parameter '{name}' must be a finite number, found {value!r}")
    return float(value)


@dataclass(frozen=True, slots=True)
class FreeJoint:
    """A joint that follows no other: range, initial position, and whether it is continuous."""

    name: str
    lower: float
    upper: float
    zero: float
    is_continuous: bool


@dataclass(frozen=True, slots=True)
class JointSample:
    """The joints in the order of the description; arrays without any known value are empty."""

    names: tuple[str, ...]
    positions: list[float]
    velocities: list[float]
    efforts: list[float]


class JointPositions:
    """
    The joints of one robot, without fixed, floating and planar ones.

    A joint is free, or it depends on a free one, directly or through others.
    """

    def __init__(self, robot: Robot, options: JointOptions) -> None:
        """Put every joint at its initial position. Raises DescriptionError for circular mimics."""
        moving = {joint.name: joint for joint in robot.joints if joint.has_position}
        dependent = _dependences(moving, options)
        self.names = tuple(moving)
        """Free and dependent joints, in the order of the description."""
        self.free = {
            name: _free_joint(joint, options)
            for name, joint in moving.items()
            if name not in dependent
        }
        """By name, in the order of the description."""
        self._sources = {name: _resolved(name, dependent, moving) for name in moving}
        self._positions = {}
        if options.publish_default_positions:
            self._positions = {joint.name: joint.zero for joint in self.free.values()}
        zeros = dict.fromkeys(self.free, 0.0)
        self._velocities = dict(zeros) if options.publish_default_velocities else {}
        self._efforts = dict(zeros) if options.publish_default_efforts else {}
        self._directions = dict.fromkeys(self.free, 1.0)
        self.warnings = tuple(_warnings(self, options))
        """Options that do not fit the robot, one line each."""

    def set(
        self,
        names: Sequence[str],
        positions: Sequence[float] = (),
        velocities: Sequence[float] = (),
        efforts: Sequence[float] = (),
    ) -> None:
        """
        Set the values of free joints from a joint state.

        Arrays are as long as ``names``, or empty. Other joints, and values that are not finite,
        are ignored.
        """
        for values, known in (
            (positions, self._positions),
            (velocities, self._velocities),
            (efforts, self._efforts),
        ):
            for name, value in zip(names, values, strict=False):
                if name in self.free and math.isfinite(value):
                    known[name] = value

    def advance(self, delta: float) -> None:
        """Move every free joint by ``delta``: back and forth between its limits, or in circles."""
        for name, position in self._positions.items():
            joint = self.free[name]
            moved = position + self._directions[name] * delta
            if joint.is_continuous and moved > joint.upper:
                moved = joint.lower + (moved - joint.lower) % (joint.upper - joint.lower)
            elif not joint.lower <= moved <= joint.upper:
                moved = min(max(moved, joint.lower), joint.upper)
                self._directions[name] = 1.0 if moved == joint.lower else -1.0
            self._positions[name] = moved

    def sample(self) -> JointSample:
        """Return the present values of all joints."""
        positions, velocities, efforts = self._positions, self._velocities, self._efforts
        sources = self._sources.values()
        return JointSample(
            self.names,
            [s.factor * positions.get(s.parent, 0.0) + s.offset for s in sources if positions],
            [s.factor * velocities.get(s.parent, 0.0) for s in sources if velocities],
            [efforts.get(s.parent, 0.0) for s in sources if efforts],
        )


def _dependences(moving: Mapping[str, Joint], options: JointOptions) -> dict[str, Dependence]:
    """Return joint -> what it follows; options take precedence over the description."""
    found = {}
    for name, joint in moving.items():
        if name in options.dependent_joints:
            found[name] = options.dependent_joints[name]
        elif joint.mimic is not None and options.use_mimic_tags:
            mimic = joint.mimic
            found[name] = Dependence(mimic.joint, mimic.multiplier, mimic.offset)
    return found


def _resolved(
    name: str, dependent: Mapping[str, Dependence], moving: Mapping[str, Joint]
) -> Dependence:
    """Return how a joint depends on a free joint; a free joint depends on itself."""
    result, chain = Dependence(name), [name]
    while result.parent in dependent:
        step = dependent[result.parent]
        if step.parent in chain:
            raise DescriptionError(f'Found an infinite recursive mimic chain: {chain}')
        if step.parent not in moving:
            raise DescriptionError(
                f'joint {quote(result.parent)} follows {quote(step.parent)}, which is no joint '
                f'that moves; these are: {quote_all(list(moving))}'
            )
        chain.append(step.parent)
        offset = result.offset + result.factor * step.offset
        result = Dependence(step.parent, result.factor * step.factor, offset)
    return result


def _free_joint(joint: Joint, options: JointOptions) -> FreeJoint:
    """Return the range of a joint, and its initial position: option, else 0, else the middle."""
    is_continuous = joint.type is JointType.CONTINUOUS
    if is_continuous or joint.limit is None:
        lower, upper = -math.pi, math.pi
    else:
        lower, upper = joint.limit.lower, joint.limit.upper
    if joint.safety is not None and options.use_smallest_joint_limits:
        lower = max(lower, joint.safety.soft_lower_limit)
        upper = min(upper, joint.safety.soft_upper_limit)
    middle = 0.0 if lower <= 0.0 <= upper else (lower + upper) / 2.0
    return FreeJoint(
        joint.name, lower, upper, options.zeros.get(joint.name, middle), is_continuous
    )


def _warnings(joints: JointPositions, options: JointOptions) -> Iterator[str]:
    for name, zero in options.zeros.items():
        joint = joints.free.get(name)
        if joint is None:
            yield f'zeros.{name}: the robot has no such joint of its own; {_free_joints(joints)}'
        elif not joint.lower <= zero <= joint.upper:
            yield f'zeros.{name}: {zero:g} is not within {joint.lower:g} to {joint.upper:g}'
    for name in options.dependent_joints:
        if name not in joints.names:
            yield f'dependent_joints.{name}: the robot has no such joint that moves'


def _free_joints(joints: JointPositions) -> str:
    return f'these are: {quote_all(list(joints.free))}'
