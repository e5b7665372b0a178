# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The transforms of the links of all robots, for a recording of the simulator.

Of a robot that runs ``robot_state_publisher`` publishes them, which is another process, or is not
there in a test. In the recording they are as it would publish them: those of moving joints on
``/tf``, 20 times a second, those of fixed ones latched on ``/tf_static``; but as they truly are.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

from amr_description.cdr.writer import Writer
from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.model.kinematics import joint_transform
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.model.sensors import frame_in
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld

TYPE = 'tf2_msgs/msg/TFMessage'
MOVING, FIXED = '/tf', '/tf_static'

_PERIOD = NANOSECONDS // 20


class SpawnedRobot(NamedTuple):
    """A robot in the world."""

    name: str
    namespace: str
    """Absolute."""
    robot: Robot
    pose: Transform = Transform()
    """Where it was spawned: from its root link to the world."""


_Placed: TypeAlias = tuple[str, str, Transform]
"""Frames of parent and child of a joint, and where the child is in the parent."""


def fixed_places(each: SpawnedRobot) -> Iterator[_Placed]:
    """Yield where links are that never move in their parents."""
    for joint in each.robot.joints:
        if joint.type in (JointType.FIXED, JointType.PLANAR):
            yield *_frames(each, joint), joint_transform(joint)


def moving_places(each: SpawnedRobot, view: RobotView) -> Iterator[_Placed]:
    """Yield where links are now that move in their parents."""
    for joint in each.robot.joints:
        if joint.has_position:
            place = view.pose(joint.parent).inverse() @ view.pose(joint.child)
            yield *_frames(each, joint), place


def _frames(each: SpawnedRobot, joint: Joint) -> tuple[str, str]:
    return frame_in(each.namespace, joint.parent), frame_in(each.namespace, joint.child)


class LinkTransforms:
    """See the module; messages are bytes. All but :meth:`set_robots` is for the control thread."""

    def __init__(self, world: MujocoWorld) -> None:
        self._world = world
        self._interval = -1
        self._robots: tuple[SpawnedRobot, ...] = ()

    def set_robots(self, robots: Sequence[SpawnedRobot]) -> bytes:
        """Take these robots; return the transforms of their fixed joints."""
        self._robots = tuple(robots)
        return _message([place for each in robots for place in fixed_places(each)], 0)

    def restart(self) -> None:
        """Have the next instant be due."""
        self._interval = -1

    def moving(self, time: int) -> bytes | None:
        """Return the transforms of moving joints at ``time``, ns; None: they are not due."""
        interval = time // _PERIOD
        if interval == self._interval:
            return None
        self._interval = interval
        world = self._world
        places = [
            place
            for each in self._robots
            if each.name in world.names
            for place in moving_places(each, world.robot(each.name))
        ]
        return _message(places, time) if places else None


def _message(places: Sequence[_Placed], time: int) -> bytes:
    """Return a tf2_msgs/msg/TFMessage."""
    out = Writer()
    out.count(len(places))
    for parent, child, place in places:
        out.stamp(time)
        out.text(parent)
        out.text(child)
        out.doubles((*place.translation, *place.rotation))
    return out.bytes()
