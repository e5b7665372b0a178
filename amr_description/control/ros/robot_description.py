# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``robot_description`` as a controller manager hears it: the URDF of its robot, latched.

The first one that can be used is taken; until then the manager has no hardware and no services.
"""

from collections.abc import Awaitable, Callable, Sequence

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.time import ClockType
from std_msgs.msg import String

from amr_description.control.contracts import Log, Severity
from amr_description.errors import DescriptionError
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.ros.log_thread import log_error
from amr_description.ros.qos import LATCHED

TOPIC = 'robot_description'

type Take = Callable[[Robot, Sequence[HardwareInfo]], Awaitable[None]]
"""Brings a robot's hardware up; raises what keeps it from doing so."""

_PATIENCE = 1.0  # s of the machine's clock, between two lines that say what is waited for


class DescriptionSource:
    """
    The subscription of a manager's node; everything here runs on the ROS thread.

    ``robot``: the one that the manager has, None while it waits. The executor has to know
    coroutines (SingleThreadedExecutor).
    """

    def __init__(
        self, node: Node, log: Log, take: Take | None = None, robot: Robot | None = None
    ) -> None:
        """
        Subscribe. ``take`` is awaited with the first description that can be read; when it raises,
        the next one is tried. Without it the manager has its ``robot`` from elsewhere.
        """
        self.robot = robot
        self._take = take
        self._log = log
        # A group of its own: bringing hardware up may take long, parameters go on being served.
        group = MutuallyExclusiveCallbackGroup()
        subscription = node.create_subscription(
            String, TOPIC, self._receive, LATCHED, callback_group=group
        )
        self._timer = None
        if robot is None:
            self._log(
                Severity.INFO,
                f"Subscribing to '{subscription.topic_name}' topic for robot description.",
            )
            # By the machine's clock: a simulated one may stand still until there is a robot.
            self._timer = node.create_timer(
                _PATIENCE,
                self._say_what_is_missing,
                callback_group=group,
                clock=Clock(clock_type=ClockType.STEADY_TIME),
            )

    async def _receive(self, message: String) -> None:
        text = message.data
        if self.robot is not None:
            # Whoever spawned the robot had it from here, as a rule: nothing to be warned of then.
            if self._take is not None or text.strip() != self.robot.text.strip():
                self._log(
                    Severity.WARN,
                    'ResourceManager has already loaded a urdf and is initialized. Ignoring '
                    'attempt to reload a robot description.',
                )
            return
        self._log(Severity.INFO, 'Received robot description from topic.')
        try:
            robot = parse(text, TOPIC)
            hardware = hardware_of(robot)
            if not hardware:
                raise DescriptionError(
                    f"{TOPIC}: the robot '{robot.name}' has no <ros2_control> block, so there is "
                    'nothing to control; add one to the URDF'
                )
            await self._take(robot, hardware)
        except Exception as error:  # a stranger's component may raise anything
            log_error(self._log, error)
            self._log(
                Severity.ERROR,
                'Could not load and initialize hardware. Please check previous output for more '
                'details. After you have corrected your URDF, try to publish robot description '
                'again.',
            )
            self._timer.reset()
            return
        self.robot = robot
        self._timer.cancel()

    def _say_what_is_missing(self) -> None:
        self._log(Severity.WARN, f"Waiting for data on '{TOPIC}' topic to finish initialization")
