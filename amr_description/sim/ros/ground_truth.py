# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is true of every simulated robot, beside what its sensors and its odometry say.

In the namespace of the robot, reliable, depth 10, stamped with the exact simulated time::

    ground_truth/odom    nav_msgs/msg/Odometry
        pose     of the base in the frame 'world'; no errors, so no covariances
        twist    of the base's origin, in the base's own axes (child_frame_id)
    ground_truth/wheels  control_msgs/msg/DynamicJointState, of a robot that has wheels
        contact           1 while the wheel bears on something, else 0
        normal_force      N
        slip_along        m/s, of the tread over the ground, in the wheel's rolling direction
        slip_across       m/s, the same along the axle: the scrub of a skid-steered robot

The base is the root link; of a robot whose root is ``world``, the first link that hangs on it.

While time stands still the present instant is told ten times a second of the wall clock. Nothing
is computed for a topic that nobody hears. The child frame has the prefix that the controllers'
frames have: the namespace. Of several robots in one namespace, the first has these topics; those
of the others lie below their own names.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from control_msgs.msg import DynamicJointState
from nav_msgs.msg import Odometry
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.converters import fill_dynamic_joint_state
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.samples import DynamicJointStateSample, DynamicLayout
from amr_description.model.frames import Transform, Vector
from amr_description.model.robot import Robot, WORLD_LINK
from amr_description.ros.messages import fill_pose, fill_stamp, fill_velocity
from amr_description.sim.engine import Engine
from amr_description.sim.robot_view import RobotView
from amr_description.sim.wheel_slip import WheelSlipReader
from amr_description.sim.world import MujocoWorld

ODOM_TOPIC = 'ground_truth/odom'
WHEELS_TOPIC = 'ground_truth/wheels'
WORLD_FRAME = 'world'
"""The frame of every pose that the simulator takes or gives."""

WHEEL_VALUES = ('contact', 'normal_force', 'slip_along', 'slip_across')

_QOS = QoSProfile(depth=10)


@dataclass(frozen=True, slots=True)
class LinkMotion:
    """Where a link is, and how it moves."""

    stamp: int
    """ns."""
    pose: Transform
    """From the link to the world."""
    velocity: tuple[Vector, Vector]
    """Linear, m/s, and angular, rad/s, in the link's own axes."""


class GroundTruth:
    """
    Of all robots of a world. :meth:`add` and :meth:`remove` on the ROS thread, :meth:`report` on
    the control thread.
    """

    def __init__(
        self, node: Node, loop_publisher: LoopPublisher, world: MujocoWorld, rate: float
    ) -> None:
        """
        ``node`` has the topics; ``rate``: Hz of simulated time, but no more often than the loop
        turns; 0: never.
        """
        self._node = node
        self._loop_publisher = loop_publisher
        self._world = world
        self._period = round(NANOSECONDS / rate) if rate else 0
        self._latest = self._interval = -1
        self._robots: dict[str, _RobotTruth] = {}
        loop_publisher.reporters.append(self.report)

    def add(self, name: str, namespace: str) -> None:
        """Tell of the robot ``name`` of the world, from now on, in its namespace."""
        if self._period:
            place = f'/{namespace.strip("/")}'.rstrip('/')
            if place in {truth.place for truth in self._robots.values()}:
                place = f'{place}/{name}'
            truth = _RobotTruth(self._node, self._world.robot(name), self._world.engine, place)
            self._robots = self._robots | {name: truth}

    def remove(self, name: str) -> None:
        """Remove the topics of a robot that has left the world."""
        truth = self._robots.get(name)
        if truth is not None:
            self._robots = {key: each for key, each in self._robots.items() if key != name}
            truth.destroy(self._node)

    def report(self, time: int) -> None:
        """Send what is due at the turn of ``time``, ns."""
        stands_still, self._latest = time == self._latest, time
        if not self._robots:
            return
        is_due, self._interval = time // self._period != self._interval, time // self._period
        if not (is_due or stands_still):
            return
        present = self._world.names
        for name, truth in self._robots.items():
            if name in present:
                truth.report(time, self._loop_publisher.send)


class _RobotTruth:
    """The topics of one robot, below ``place``: a namespace, or nothing for the root."""

    def __init__(self, node: Node, robot: RobotView, engine: Engine, place: str) -> None:
        self.place = place
        self._robot = robot
        self._base = _base_of(robot.description)
        self._contacts = WheelSlipReader(engine, robot)
        self._odom = node.create_publisher(Odometry, f'{place}/{ODOM_TOPIC}', _QOS)
        self._odometry = Odometry(child_frame_id=f'{place}/{self._base}'.removeprefix('/'))
        self._odometry.header.frame_id = WORLD_FRAME
        self._wheels: Publisher | None = None
        joints = self._contacts.joints
        if joints:
            topic = f'{place}/{WHEELS_TOPIC}'
            self._wheels = node.create_publisher(DynamicJointState, topic, _QOS)
            self._states = DynamicJointState()
            self._layout = DynamicLayout('', joints, (WHEEL_VALUES,) * len(joints))

    def destroy(self, node: Node) -> None:
        """Remove the topics."""
        for publisher in (self._odom, self._wheels):
            if publisher is not None:
                node.destroy_publisher(publisher)

    def report(self, time: int, send: Callable[..., None]) -> None:
        """Look at the robot, as far as anybody listens."""
        if _is_heard(self._odom):
            pose, velocity = self._robot.pose(self._base), self._robot.velocity(self._base)
            send(_fill_motion, LinkMotion(time, pose, velocity), self._odometry, self._odom)
        if self._wheels is not None and _is_heard(self._wheels):
            values = tuple(
                (float(wheel.is_touching), wheel.normal_force, wheel.along, wheel.across)
                for wheel in self._contacts.read()
            )
            sample = DynamicJointStateSample(time, values, self._layout)
            send(fill_dynamic_joint_state, sample, self._states, self._wheels)


def _base_of(robot: Robot) -> str:
    root = robot.root.name
    hanging = robot.child_joints(root) if root == WORLD_LINK else ()
    return hanging[0].child if hanging else root


def _is_heard(publisher: Publisher) -> bool:
    """Whether anybody listens; 1 µs. A topic that is just being removed has no listener."""
    try:
        return publisher.get_subscription_count() > 0
    except InvalidHandle:
        return False


def _fill_motion(motion: LinkMotion, message: Any) -> None:
    fill_stamp(motion.stamp, message.header.stamp)
    fill_pose(motion.pose, message.pose.pose)
    fill_velocity(*motion.velocity, message.twist.twist)
