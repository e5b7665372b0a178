# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
From joint positions to transforms, and how often they are published; without ROS.

Times are integer nanoseconds.
"""

from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
import math
from typing import NamedTuple

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.model.kinematics import joint_transform
from amr_description.model.robot import Joint, JointType, Mimic, Robot
from amr_description.model.xacro_markup import has_xacro_elements

# ns; stamps of one publisher do not go back by more, unless it was restarted
_RESTART_GAP = NANOSECONDS
_MOST_LATE_PERIODS = 2  # periods that a joint may be late before its schedule starts again
_REMEMBERED = 4  # messages by which the next one is predicted: one that was late stands out
_JITTER = NANOSECONDS // 2000  # by which a message is mostly later than the earliest of them
_SHORTEST_REST = NANOSECONDS // 500  # a shorter one costs more than it saves
_LONGEST_REST = NANOSECONDS // 20  # at 1 kHz 50 messages are waiting then


@dataclass(frozen=True, slots=True)
class LinkTransform:
    """The pose of link ``child`` in link ``parent`` (``transform_child_to_parent``), for /tf."""

    parent: str
    child: str
    transform: Transform


class RobotState:
    """
    The transforms of a robot, one per joint.

    Fixed joints have ``static`` transforms, sorted by joint name; revolute, continuous and
    prismatic joints have moving ones. A floating joint has none, as a joint state cannot hold its
    pose. A planar joint is treated as fixed at its origin, as in KDL.
    """

    def __init__(self, robot: Robot) -> None:
        joints = sorted(robot.joints, key=lambda joint: joint.name)
        self.warnings = tuple(_warnings(robot, joints))
        """Problems of the description, one line each."""
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
        multiplier · source + offset, also along a chain of mimics. Names of other joints, and
        positions that are not finite, are ignored.
        """
        known = positions
        if self._mimics:
            known = completed = dict(positions)
            for joint, mimic in self._mimics:
                if joint not in completed and mimic.joint in completed:
                    completed[joint] = mimic.multiplier * completed[mimic.joint] + mimic.offset
        return [
            _link_transform(self._moving[name], known[name])
            for name in sorted(known)
            if name in self._moving and math.isfinite(known[name])
        ]


class JointThrottle:
    """
    Decides which joint states are published: each joint once per period, by message stamps.

    Joints are scheduled independently, so two publishers of joint states (wheels, an arm) do not
    starve each other. If one joint of a message is due, all of them are published.

    A joint is due at whole periods after it was first published, and at least half a period after
    it was last published. So the rate is kept on average even if joint states arrive at about this
    rate, or with jitter. (The original waits for a whole period after each stamp: 33 Hz become 17
    instead of 20 Hz, and 1 kHz with the jitter of real programs 600 Hz instead of 1 kHz.)
    """

    def __init__(self) -> None:
        self._joints: dict[str, _Schedule] = {}
        self.earliest: int | None = None
        """
        The stamp before which no joint is due that was published within a second, as of the last
        :meth:`note`; None: a joint is due whatever its stamp.
        """

    def admit(self, names: Iterable[str], stamp: int) -> bool:
        """
        Return whether to publish a message with this stamp (ns) about these joints.

        It is published if one of the joints is due or has never been published, or if the stamp is
        so much older than the last one that the publisher must have been restarted. Call
        :meth:`note` for every message that was published.
        """
        joints = self._joints
        for name in names:
            schedule = joints.get(name)
            if (
                schedule is None
                or stamp >= schedule.earliest
                or stamp < schedule.last - _RESTART_GAP
            ):
                return True
        return False

    def note(self, names: Iterable[str], stamp: int, period: int) -> None:
        """Note that a message was published; ``stamp`` and ``period`` in ns."""
        for name in names:
            schedule = self._joints.get(name)
            due = stamp + period
            if (
                schedule is not None
                and schedule.due <= stamp < schedule.due + _MOST_LATE_PERIODS * period
            ):
                due = schedule.due + period
            self._joints[name] = _Schedule(due, max(due, stamp + period // 2), stamp)
        self.earliest = min(
            (each.earliest for each in self._joints.values() if each.last >= stamp - _RESTART_GAP),
            default=None,
        )

    def forget(self) -> None:
        """Start again: time has jumped back, or the period has changed."""
        self._joints.clear()
        self.earliest = None


class Arrivals:
    """
    Predicts when a message will arrive that has a certain stamp, from those that were published.

    All times in ns. Stamps are taken to be at least as fast as the clock, also those of a
    simulation that stood still, and a message that was late is taken for an exception. A message
    that comes before its time, as a simulation has just become faster, is found late by as much.
    """

    def __init__(self) -> None:
        self._last: deque[tuple[int, int]] = deque(maxlen=_REMEMBERED)  # (stamp, arrival)

    def note(self, stamp: int, arrival: int) -> None:
        """Note when a message with this stamp arrived."""
        if self._last and (stamp <= self._last[-1][0] or arrival <= self._last[-1][1]):
            self._last.clear()  # its publisher was restarted, or the clock set
        self._last.append((stamp, arrival))

    def rest(self, stamp: int, now: int) -> int:
        """Return for how long nobody need look for a message that is at least this old; or 0."""
        if len(self._last) < 2:  # noqa: PLR2004
            return 0
        (first, began), (before, earlier), (last, latest) = (
            self._last[index] for index in (0, -2, -1)
        )
        rate = max(1.0, (last - first) / (latest - began), (last - before) / (latest - earlier))
        _, arrival, *_ = sorted(at + (stamp - each) / rate for each, at in self._last)
        rest = int(arrival) + _JITTER - now
        return min(rest, _LONGEST_REST) if rest >= _SHORTEST_REST else 0


class _Schedule(NamedTuple):
    """When a joint is due, when at the earliest, and when it was last published (ns)."""

    due: int
    earliest: int
    last: int


def period_of(frequency: float) -> int:
    """Return 1 / ``frequency`` (Hz) in ns; 0 for 0 Hz."""
    return round(NANOSECONDS / frequency) if frequency else 0


def _link_transform(joint: Joint, position: float) -> LinkTransform:
    return LinkTransform(joint.parent, joint.child, joint_transform(joint, position))


def _mimics_in_order(moving: Mapping[str, Joint]) -> Iterator[tuple[str, Mimic]]:
    """Yield the mimic joints, each after the joint it follows; circular mimics in any order."""
    waiting = {joint.name: joint.mimic for joint in moving.values() if joint.mimic is not None}
    while waiting:
        ready = [name for name, mimic in waiting.items() if mimic.joint not in waiting]
        for name in ready or list(waiting):
            yield name, waiting.pop(name)


def _warnings(robot: Robot, joints: Iterable[Joint]) -> Iterator[str]:
    """Yield warnings, with the texts of the original if it has them: users search for them."""
    if has_xacro_elements(robot.text):
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
