# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topic ``robot_description``, from which a controller manager has the URDF of its robot.

It takes the first one that can be used; until then it has no hardware and no services.
"""

from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from typing import TypeAlias

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.time import ClockType
from std_msgs.msg import String

from amr_description.errors import DescriptionError
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.plugin_errors import log_error
from amr_description.ros.qos import LATCHED

TOPIC = 'robot_description'

BringUp: TypeAlias = Callable[[Robot, Sequence[HardwareInfo]], Awaitable[None]]
"""Brings a robot's hardware up; raises what keeps it from doing so."""

_LOG_PERIOD = 1.0  # s of the steady clock, between two lines about what is waited for


class DescriptionSource:
    """
    The subscription of a manager's node; everything here runs on the ROS thread.

    The executor has to know coroutines (SingleThreadedExecutor).
    """

    def __init__(
        self, node: Node, log: Log, bring_up: BringUp | None = None, robot: Robot | None = None
    ) -> None:
        """
        Subscribe.

        Args:
            node: Of the manager.
            log: Of the manager.
            bring_up: Awaited with the first description that can be read; when it raises, the
                next one is tried.
            robot: Instead of ``bring_up``, for a manager that has its robot from elsewhere.
        """
        self.robot = robot
        """The robot that the manager has; None while it waits."""
        self._bring_up = bring_up
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
            # By the steady clock: a simulated one may stand still until there is a robot.
            self._timer = node.create_timer(
                _LOG_PERIOD,
                self._log_waiting,
                callback_group=group,
                clock=Clock(clock_type=ClockType.STEADY_TIME),
            )

    async def _receive(self, message: String) -> None:
        text = message.data
        if self.robot is not None:
            # A robot that was spawned usually comes from this same topic: no reason for a warning.
            if self._bring_up is not None or text.strip() != self.robot.text.strip():
                self._log(
                    Severity.WARN,
                    'ResourceManager has already loaded a urdf and is initialized. Ignoring '
                    'attempt to reload a robot description.',
                )
            return
        self._log(Severity.INFO, 'Received robot description from topic.')
        try:
            robot = parse(text, TOPIC)
            warn = partial(self._log, Severity.WARN)
            hardware = hardware_of(robot, strict=True, warn=warn)
            if not hardware:
                raise DescriptionError(
                    f"{TOPIC}: the robot '{robot.name}' has no <ros2_control> block, so there is "
                    'nothing to control; add one to the URDF'
                )
            await self._bring_up(robot, hardware)
        except Exception as error:  # a plugin may raise anything
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

    def _log_waiting(self) -> None:
        self._log(Severity.WARN, f"Waiting for data on '{TOPIC}' topic to finish initialization")
