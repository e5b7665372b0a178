# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Drives a robot from rest to rest over ROS, and records its odometry and the ground truth.

All times are simulation time, from the stamps of messages, so the runs are the same at any
real-time factor.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math
import time

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import GetParameters
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile

from amr_description.clock import NANOSECONDS
from amr_description.controllers.checks.drive_calibration import (
    CalibrationRun,
    Geometry,
    Path,
    Travel,
)
from amr_description.errors import CalibrationError
from amr_description.model.frames import yaw_of
from amr_description.ros.messages import nanoseconds, transform_of
from amr_description.ros.service_calls import ask_until_answered, wait_until
from amr_description.simulation.topics.names import ODOM_TOPIC

MOVING_SPEED = 1e-3
"""m/s and rad/s; a robot whose speeds are not above this is at rest."""

REST = NANOSECONDS // 2
"""ns that a robot must be at rest, so that its odometry has settled too."""

_QOS = QoSProfile(depth=1000)
"""Deep, for a simulation that runs as fast as possible."""
_LARGEST_STEP = math.pi / 2.0
"""rad between two messages; beyond this, whole turns could be missed."""

_ACK_TIMEOUT = Duration(seconds=2.0)
"""How long to wait, in wall-clock time, until the last zero is acknowledged."""

_PARAMETERS = (
    'wheel_separation',
    'wheel_separation_multiplier',
    'left_wheel_radius_multiplier',
    'right_wheel_radius_multiplier',
)


@dataclass(frozen=True, slots=True)
class Manoeuvre:
    """A twist that is commanded until odometry has reached a distance or an angle."""

    name: str
    linear: float
    """m/s."""
    angular: float
    """rad/s."""
    distance: float = math.inf
    """m."""
    turn: float = math.inf
    """rad."""

    @property
    def time_limit(self) -> float:
        """s of simulation time after which the manoeuvre has failed."""
        straight = self.distance / abs(self.linear) if self.linear else math.inf
        turning = self.turn / abs(self.angular) if self.angular else math.inf
        return 4.0 * min(straight, turning) + 5.0

    def is_done(self, travel: Travel) -> bool:
        """Whether the distance or the angle is reached."""
        return abs(travel.distance) >= self.distance or abs(travel.turn) >= self.turn


class DriveTrack:
    """One odometry topic: the latest message, and the path since the last :meth:`restart`."""

    def __init__(self) -> None:
        self.stamp = -1
        self.moved = 0
        """Stamp of the last message in which the robot moved, ns."""
        self.has_jumped = self.has_gap = False
        """Stamps have jumped back; a gap between messages is so long that a turn may be missed."""
        self._path: Path | None = None
        self._pose = (0.0, 0.0, 0.0)

    def add(self, message: Odometry) -> None:
        """Take in a message."""
        stamp = nanoseconds(message.header.stamp)
        self.has_jumped = self.has_jumped or stamp < self.stamp
        gap, self.stamp = (stamp - self.stamp) / NANOSECONDS, stamp
        pose = transform_of(message.pose.pose)
        x, y, _ = pose.translation
        self._pose = x, y, yaw_of(pose.rotation)
        if self._path is not None:
            self._path.add(*self._pose)
        twist = message.twist.twist
        if self._path is not None and gap * abs(twist.angular.z) > _LARGEST_STEP:
            self.has_gap = True
        if max(abs(twist.linear.x), abs(twist.linear.y), abs(twist.angular.z)) > MOVING_SPEED:
            self.moved = stamp

    @property
    def is_at_rest(self) -> bool:
        """Whether the robot has been at rest for long enough."""
        return self.stamp >= 0 and self.stamp - self.moved > REST

    @property
    def travel(self) -> Travel:
        """Distance and angle since the last restart."""
        assert self._path is not None, 'restart() was called'
        return self._path.travel

    def restart(self) -> None:
        """Start the path at the present pose."""
        self._path = Path(*self._pose)


class CalibrationDrive:
    """
    Drives a robot through the topics of its controller, and spins ``node`` while it waits.

    Args:
        node: of the program.
        controller: full name of the controller's node.
        timeout: how long to wait for anything that is needed, s of wall-clock time.
        check: called periodically; raises an exception when the program has been asked to stop.

    Raises:
        CalibrationError: the controller or the ground truth is not there.
        NoAnswerError: the controller does not answer.
    """

    def __init__(
        self, node: Node, controller: str, timeout: float, check: Callable[[], object]
    ) -> None:
        self._node = node
        self._timeout = timeout
        self._check = check
        self._command: tuple[float, float] | None = None
        self._namespace, _, self._name = controller.rpartition('/')
        self.geometry = self._read_geometry(controller)
        self._truth, self._odometry = DriveTrack(), DriveTrack()
        truth_topic = f'{self._namespace}/{ODOM_TOPIC}'
        odometry_topic, command_topic = self._find_topics(truth_topic)
        self._commands = node.create_publisher(TwistStamped, command_topic, 10)
        node.create_subscription(Odometry, odometry_topic, self._odometry.add, _QOS)
        node.create_subscription(Odometry, truth_topic, self._on_truth, _QOS)
        self._wait_for_messages(truth_topic, self._truth)
        self._command = 0.0, 0.0  # the controller publishes odometry from the first command on
        self._wait_for_messages(odometry_topic, self._odometry)

    def run(self, manoeuvre: Manoeuvre) -> CalibrationRun:
        """Drive a manoeuvre, from rest to rest. Raises CalibrationError."""
        self._wait_for_rest()
        self._truth.restart()
        self._odometry.restart()
        limit = self._odometry.stamp + round(manoeuvre.time_limit * NANOSECONDS)
        # A fast simulation may reach the limit before the first command has arrived.
        wall_limit = time.monotonic() + self._timeout
        self._command = manoeuvre.linear, manoeuvre.angular
        self._send()
        self._spin_until(
            lambda: (
                manoeuvre.is_done(self._odometry.travel)
                or (self._odometry.stamp > limit and time.monotonic() > wall_limit)
            )
        )
        if not manoeuvre.is_done(self._odometry.travel):
            travel = self._odometry.travel
            raise CalibrationError(
                f"'{manoeuvre.name}': in {manoeuvre.time_limit:.0f} s the wheels went "
                f'{travel.distance:.2f} m and turned the robot by {math.degrees(travel.turn):.0f} '
                'degrees only; is the controller active, does it limit speeds, does another '
                'program command it?'
            )
        self._wait_for_rest()
        return CalibrationRun.from_odometry(
            manoeuvre.name, self._odometry.travel, self._truth.travel, self.geometry
        )

    def stop_robot(self) -> None:
        """Command zero, and wait until it is acknowledged."""
        self._command = 0.0, 0.0
        self._send()
        self._commands.wait_for_all_acked(_ACK_TIMEOUT)

    # --- driving ------------------------------------------------------------------------------

    def _on_truth(self, message: Odometry) -> None:
        self._truth.add(message)
        if self._command is not None:
            self._send()  # 50 Hz of simulation time: without commands the controller brakes

    def _send(self) -> None:
        """
        Send the command with a zero stamp, which the controller takes as stamped on arrival: at a
        high real-time factor any other stamp would be too old by then.
        """
        if self._command is None:
            return
        message = TwistStamped()
        message.twist.linear.x, message.twist.angular.z = self._command
        self._commands.publish(message)

    def _wait_for_rest(self) -> None:
        self._command = 0.0, 0.0
        self._send()
        # Of the newer one: messages of the other may still be on their way.
        since = max(self._truth.stamp, self._odometry.stamp)
        self._spin_until(
            lambda: (
                self._truth.is_at_rest
                and self._odometry.is_at_rest
                and min(self._truth.stamp, self._odometry.stamp) > since + REST
            )
        )

    def _spin_until(self, condition: Callable[[], bool]) -> None:
        """
        Spin the node until a condition holds.

        Raises CalibrationError when simulation time has stopped or jumped back, or messages are
        lost.
        """
        stamp, since = self._truth.stamp, time.monotonic()

        def is_over() -> bool | None:
            nonlocal stamp, since
            self._check()
            if self._truth.has_jumped:
                raise CalibrationError('simulated time went back: the simulation was reset')
            if self._truth.has_gap or self._odometry.has_gap:
                raise CalibrationError(
                    'messages get lost: the simulation is faster than they can be read; try again '
                    'after: ros2 param set /mujoco_sim real_time_factor 5.0'
                )
            if self._truth.stamp != stamp:
                stamp, since = self._truth.stamp, time.monotonic()
            elif time.monotonic() - since > self._timeout:
                raise CalibrationError(
                    f'the truth has stood still for {self._timeout:g} s: is the simulation '
                    'paused, or gone?'
                )
            return condition() or None

        wait_until(self._node, is_over)

    # --- discovery ----------------------------------------------------------------------------

    def _read_geometry(self, controller: str) -> Geometry:
        request = GetParameters.Request(names=_PARAMETERS)
        service = f'{controller}/get_parameters'
        self._wait(
            lambda: service in dict(self._node.get_service_names_and_types()),
            f"there is no controller '{controller}' after {self._timeout:g} s: is the robot up, "
            'and is it called so (--controller)?',
        )
        client = self._node.create_client(GetParameters, service)
        values = ask_until_answered(self._node, client, request, timeout=self._timeout).values
        found = [value.double_value for value in values]
        if len(found) != len(_PARAMETERS) or not all(found):
            raise CalibrationError(
                f"'{controller}' is no differential drive: it lacks one of the parameters "
                f'{", ".join(_PARAMETERS)}'
            )
        return Geometry(*found)

    def _find_topics(self, truth: str) -> tuple[str, str]:
        """Return the topics of the controller's odometry and of its commands."""
        found: dict[str, str] = {}

        def look() -> bool:
            found.update(self._topics())
            return len(found) == 2

        self._wait(
            look,
            f"'{self._namespace}/{self._name}' has no topics of odometry and of TwistStamped "
            'commands: is it configured (ros2 control list_controllers)?',
        )
        self._wait(
            lambda: self._node.count_publishers(truth) > 0,
            f"nobody publishes the truth on '{truth}': it takes a robot in mujoco_sim, with a "
            'ground_truth_rate above 0',
        )
        return found['odometry'], found['commands']

    def _topics(self) -> dict[str, str]:
        namespace = self._namespace or '/'
        if (self._name, namespace) not in self._node.get_node_names_and_namespaces():
            return {}
        published = self._node.get_publisher_names_and_types_by_node(self._name, namespace)
        subscribed = self._node.get_subscriber_names_and_types_by_node(self._name, namespace)
        return {
            kind: topic
            for kind, topics, type_name in (
                ('odometry', published, 'nav_msgs/msg/Odometry'),
                ('commands', subscribed, 'geometry_msgs/msg/TwistStamped'),
            )
            for topic, types in topics
            if type_name in types
        }

    def _wait_for_messages(self, topic: str, track: DriveTrack) -> None:
        self._wait(
            lambda: track.stamp >= 0,
            f"no message has come on '{topic}' for {self._timeout:g} s: is the simulation paused, "
            'or the controller inactive?',
        )

    def _wait(self, condition: Callable[[], bool], error: str) -> None:
        def holds() -> bool | None:
            self._check()
            return condition() or None

        if not wait_until(self._node, holds, timeout=self._timeout):
            raise CalibrationError(error)
