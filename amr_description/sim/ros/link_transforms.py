# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The transforms of the links of all robots, for a recording of the simulator.

Of a robot that runs ``robot_state_publisher`` publishes them, which is another process, or is not
there in a test. In the recording they are as it would publish them: those of moving joints on
``/tf``, 20 times a second, those of fixed ones latched on ``/tf_static``; but as they truly are.
"""

from collections.abc import Sequence
from typing import NamedTuple

from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.model.kinematics import joint_transform
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.model.sensors import frame_in
from amr_description.ros.messages import fill_stamp
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


class LinkTransforms:
    """See the module; all but :meth:`set_robots` is called on the control thread."""

    def __init__(self, world: MujocoWorld) -> None:
        self._world = world
        self._interval = -1
        self._robots: tuple[SpawnedRobot, ...] = ()

    def set_robots(self, robots: Sequence[SpawnedRobot]) -> TFMessage:
        """Take these robots; return the transforms of their fixed joints."""
        self._robots = tuple(robots)
        fixed = TFMessage()
        for each in robots:
            for joint in each.robot.joints:
                if joint.type in (JointType.FIXED, JointType.PLANAR):
                    fixed.transforms.append(_stamped(each, joint, joint_transform(joint), 0))
        return fixed

    def restart(self) -> None:
        """Have the next instant be due."""
        self._interval = -1

    def moving(self, time: int) -> TFMessage | None:
        """Return the transforms of moving joints at ``time``, ns; None: they are not due."""
        interval = time // _PERIOD
        if interval == self._interval:
            return None
        self._interval = interval
        message, present = TFMessage(), self._world.names
        for each in self._robots:
            if each.name in present:
                self._add(message, each, time)
        return message if message.transforms else None

    def _add(self, message: TFMessage, each: SpawnedRobot, time: int) -> None:
        view = self._world.robot(each.name)
        for joint in each.robot.joints:
            if joint.has_position:
                place = view.pose(joint.parent).inverse() @ view.pose(joint.child)
                message.transforms.append(_stamped(each, joint, place, time))


def _stamped(each: SpawnedRobot, joint: Joint, place: Transform, time: int) -> TransformStamped:
    message = TransformStamped()
    message.header.frame_id = frame_in(each.namespace, joint.parent)
    message.child_frame_id = frame_in(each.namespace, joint.child)
    fill_stamp(time, message.header.stamp)
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = place.translation
    rotation.x, rotation.y, rotation.z, rotation.w = place.rotation
    return message
