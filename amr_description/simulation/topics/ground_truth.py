# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Ground truth topics of every simulated robot, to compare sensors and odometry with.

In the namespace of the robot, reliable, depth 10, stamped with the exact simulated time::

    ground_truth/odom    nav_msgs/msg/Odometry
        pose     of the base in the frame 'world'; no errors, so no covariances
        twist    of the base's origin, in the base's own axes (child_frame_id)
    ground_truth/wheels  control_msgs/msg/DynamicJointState, of a robot that has wheels
        contact           1 while the wheel touches something, else 0
        normal_force      N
        slip_along        m/s, of the wheel's surface over the ground, in its rolling direction
        slip_across       m/s, the same along the axle: the scrub of a skid-steered robot

The base is the root link, or the first child of a root that is called ``world``. The child frame
has the prefix that the controllers' frames have: the namespace.

While time stands still, the present instant is published ten times a second of the wall clock.
Nothing is computed for a topic without subscribers. Of several robots in one namespace the first
has these topics; those of the others are below their names.
"""

from collections.abc import Callable

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Port
from amr_description.control.samples import (
    BodyOdometrySample,
    DynamicJointStateSample,
    DynamicLayout,
    Frames,
)
from amr_description.messages.encoders import bytes_encoder_of
from amr_description.model.robot import Robot, WORLD_LINK
from amr_description.sim.engine import Engine
from amr_description.sim.robot_view import RobotView
from amr_description.sim.wheel_slip import WheelSlipReader
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.advertising import Topic, Topics
from amr_description.simulation.topics.names import ODOM_TOPIC, WHEELS_TOPIC, WORLD_FRAME

WHEEL_VALUES = ('contact', 'normal_force', 'slip_along', 'slip_across')

_ODOMETRY = Port(ODOM_TOPIC, 'nav_msgs/msg/Odometry', sample=BodyOdometrySample)
_WHEELS = Port(WHEELS_TOPIC, 'control_msgs/msg/DynamicJointState', sample=DynamicJointStateSample)


class GroundTruth:
    """
    The ground truth topics of all robots of a world.

    :meth:`add` and :meth:`remove` are called on the ROS thread, :meth:`report` on the control
    thread.
    """

    def __init__(
        self,
        topics: Topics,
        world: MujocoWorld,
        rate: float,
        has_ticked: Callable[[int], bool] = lambda _: False,
    ) -> None:
        """
        Publish from now on, at the end of control cycles.

        Args:
            topics: Publish at the end of a cycle.
            world: The simulated world.
            rate: Hz of simulated time, at most once a cycle; 0: never.
            has_ticked: Whether the controllers have ticked at a time, ns. In such cycles the
                instants are those of the rate alone, so that a recording of them does not
                depend on how time was stepped.
        """
        self._topics = topics
        self._world = world
        self._period = round(NANOSECONDS / rate) if rate else 0
        self._has_ticked = has_ticked
        self._latest = self._interval = self._interval_of_tick = -1
        self._robots: dict[str, _RobotTruth] = {}
        topics.reporters.append(self.report)

    def add(self, name: str, namespace: str) -> None:
        """Create the topics of the robot ``name`` of the world, in a namespace."""
        if self._period:
            prefix = f'/{namespace.strip("/")}'.rstrip('/')
            if prefix in {truth.prefix for truth in self._robots.values()}:
                prefix = f'{prefix}/{name}'
            robot = self._world.robot(name)
            truth = _RobotTruth(self._topics, robot, self._world.engine, prefix)
            self._robots = self._robots | {name: truth}

    def remove(self, name: str) -> None:
        """Remove the topics of a robot that was removed from the world."""
        truth = self._robots.get(name)
        if truth is not None:
            self._robots = {key: each for key, each in self._robots.items() if key != name}
            truth.withdraw(self._topics)

    def restart(self) -> None:
        """Have the next cycle be due; on the control thread."""
        self._latest = self._interval = self._interval_of_tick = -1

    def report(self, time: int) -> None:
        """Publish what is due at ``time``, ns."""
        stands_still, self._latest = time == self._latest, time
        if not self._robots:
            return
        interval = time // self._period
        if self._has_ticked(time):
            is_due = interval != self._interval_of_tick
            self._interval_of_tick = interval
        else:
            is_due = interval != self._interval or stands_still
        self._interval = interval
        if not is_due:
            return
        present = self._world.names
        for name, truth in self._robots.items():
            if name in present:
                truth.report(time)


class _RobotTruth:
    """The topics of one robot; ``prefix``: a namespace, or empty for the root."""

    def __init__(
        self,
        topics: Topics,
        robot: RobotView,
        engine: Engine,
        prefix: str,
    ) -> None:
        self.prefix = prefix
        self._robot = robot
        self._base = _base_of(robot.description)
        self._wheel_slip = WheelSlipReader(engine, robot)
        child_frame = f'{prefix}/{self._base}'.removeprefix('/')
        self._frames = Frames(WORLD_FRAME, child_frame, (), ())
        self._odom = _advertised(topics, prefix, _ODOMETRY)
        self._wheels: Topic | None = None
        joints = self._wheel_slip.joints
        if joints:
            self._wheels = _advertised(topics, prefix, _WHEELS)
            self._layout = DynamicLayout('', joints, (WHEEL_VALUES,) * len(joints))

    def withdraw(self, topics: Topics) -> None:
        """Remove the topics."""
        for topic in (self._odom, self._wheels):
            if topic is not None:
                topics.withdraw(topic)

    def report(self, time: int) -> None:
        """Measure and publish, as far as there are subscribers."""
        if self._odom.has_subscribers:
            pose, velocity = self._robot.pose(self._base), self._robot.velocity(self._base)
            self._odom.send(BodyOdometrySample(time, pose, *velocity, self._frames))
        if self._wheels is not None and self._wheels.has_subscribers:
            values = tuple(
                (float(wheel.is_touching), wheel.normal_force, wheel.along, wheel.across)
                for wheel in self._wheel_slip.read()
            )
            self._wheels.send(DynamicJointStateSample(time, values, self._layout))


def _advertised(topics: Topics, prefix: str, port: Port) -> Topic:
    return topics.advertise(f'{prefix}/{port.name}', port.message, bytes_encoder_of(port))


def _base_of(robot: Robot) -> str:
    root = robot.root.name
    hanging = robot.child_joints(root) if root == WORLD_LINK else ()
    return hanging[0].child if hanging else root
