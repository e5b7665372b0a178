# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Joint positions to transforms, and how often: what ``robot_state_publisher`` knows without ROS.

This module imports no rclpy. Times are integer nanoseconds.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
import math
from typing import NamedTuple

from amr_description.model.frames import Transform
from amr_description.model.kinematics import joint_transform
from amr_description.model.robot import Joint, JointType, Mimic, Robot

_RESTART = 1_000_000_000  # ns: messages of one source do not overtake one another by so much
_PATIENCE = 2  # periods that a joint may be late before its turns are counted anew


@dataclass(frozen=True, slots=True)
class LinkTransform:
    """The pose of link ``child`` in link ``parent`` (``transform_child_to_parent``), for /tf."""

    parent: str
    child: str
    transform: Transform


class RobotState:
    """
    The transforms of a robot, a joint each.

    Fixed joints make ``static`` transforms, sorted by joint name. Revolute, continuous and
    prismatic ones move. A floating joint makes none (its position is not one number: who knows
    it, publishes it). A planar joint counts as fixed, at its origin, as in KDL.
    """

    def __init__(self, robot: Robot) -> None:
        joints = sorted(robot.joints, key=lambda joint: joint.name)
        self.warnings = tuple(_warnings(robot, joints))
        """What the user should know about this description, a line each."""
        self.static = tuple(
            _link_transform(joint, 0.0)
            for joint in joints
            if joint.type in (JointType.FIXED, JointType.PLANAR)
        )
        self._moving = {joint.name: joint for joint in joints if joint.has_position}
        self._mimics = tuple(_mimics_in_order(self._moving))

    def moving(self, positions: Mapping[str, float]) -> list[LinkTransform]:
        """
        Return the transforms of the moving joints in ``positions`` (rad; m), sorted by joint.

        A mimic joint that is not in ``positions`` follows its source joint if that one is:
        multiplier · source + offset, also along a chain of mimics. Names that are no moving joint
        of this robot, and positions that are not finite, are left out.
        """
        known = dict(positions) if self._mimics else positions
        for joint, mimic in self._mimics:
            if joint not in known and mimic.joint in known:
                known[joint] = mimic.multiplier * known[mimic.joint] + mimic.offset
        return [
            _link_transform(self._moving[name], known[name])
            for name in sorted(known)
            if name in self._moving and math.isfinite(known[name])
        ]


class Throttle:
    """
    How often the transforms of a joint are published: once a period, by message stamps.

    Each joint counts for itself, so that two sources of joint states (wheels, an arm) do not
    starve one another. A message is published whole when one of its joints is due.

    A joint falls due at whole periods after it was published first, whatever stamps come, but half
    a period after it was published last at the earliest. So the rate is kept, on average, also
    where joint states come as often, but unevenly, or not much more often. (The original waits for
    a whole period from each stamp: of 33 Hz it makes 17 instead of 20, and of 1 kHz, as programs
    send it, 600 Hz instead of 1 kHz.)
    """

    def __init__(self) -> None:
        self._joints: dict[str, _Turn] = {}

    def admit(self, names: Iterable[str], stamp: int) -> bool:
        """
        Tell whether a message stamped ``stamp`` about the joints ``names`` is to be published.

        That is so if one of them is due, or has never been published, or the stamp is so much
        older than the last that its source must have started anew. Call :meth:`note` for what was
        published.
        """
        joints = self._joints
        for name in names:
            turn = joints.get(name)
            if turn is None or stamp >= turn.earliest or stamp < turn.last - _RESTART:
                return True
        return False

    def note(self, names: Iterable[str], stamp: int, period: int) -> None:
        """Remember that a message with ``stamp`` was published, and that ``period`` ns follow."""
        for name in names:
            turn = self._joints.get(name)
            due = stamp + period
            if turn is not None and turn.due <= stamp < turn.due + _PATIENCE * period:
                due = turn.due + period
            self._joints[name] = _Turn(due, max(due, stamp + period // 2), stamp)

    def forget(self) -> None:
        """Start anew: time went back, or the period is another."""
        self._joints.clear()


class _Turn(NamedTuple):
    """When a joint is due by its rate, when at the earliest, and when it was published (ns)."""

    due: int
    earliest: int
    last: int


def period_of(frequency: float) -> int:
    """Return 1 / ``frequency`` (Hz) in ns; 0 for 0 Hz."""
    return round(1e9 / frequency) if frequency else 0


def _link_transform(joint: Joint, position: float) -> LinkTransform:
    return LinkTransform(joint.parent, joint.child, joint_transform(joint, position))


def _mimics_in_order(moving: Mapping[str, Joint]) -> Iterator[tuple[str, Mimic]]:
    """Yield the mimic joints, each after the joint it follows; a ring of mimics in any order."""
    waiting = {joint.name: joint.mimic for joint in moving.values() if joint.mimic is not None}
    while waiting:
        ready = [name for name, mimic in waiting.items() if mimic.joint not in waiting]
        for name in ready or list(waiting):
            yield name, waiting.pop(name)


def _warnings(robot: Robot, joints: Iterable[Joint]) -> Iterator[str]:
    """Yield the original's words, where it has some: people search for them."""
    if '<xacro:' in robot.text:
        yield (
            'the description holds <xacro:…> elements, which are left out; expand them: name the '
            'xacro file instead of its text, or run xacro FILE > robot.urdf'
        )
    if robot.root.inertial is not None:
        yield (
            f'The root link {robot.root.name} has an inertia specified in the URDF, but KDL does '
            'not support a root link with an inertia.  As a workaround, you can add an extra '
            'dummy link to your URDF.'
        )
    for joint in joints:
        if joint.type is JointType.PLANAR:
            yield f"Converting unknown joint type of joint '{joint.name}' into a fixed joint"
