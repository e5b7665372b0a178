# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Commands to the robot as Nav2's velocity smoother sends them, and what odometry says of them."""

from collections.abc import Callable
import math
import time

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration

from amr_description.clock import NANOSECONDS
from amr_description.errors import UsageError
from amr_description.navigation.contract.command_rules import (
    ANGULAR_SPEED,
    LINEAR_SPEED,
    LONGEST_BRAKING,
    PROGRESS,
    PROGRESS_TIME,
    STANDING,
)
from amr_description.navigation.contract.observations import (
    ContractTopic,
    OdometrySeen,
    Phase,
    STAMPED_TWIST_TYPE,
    TWIST_TYPE,
)
from amr_description.navigation.contract.series import names_of
from amr_description.navigation.ros.contract.collector import Collector, COMMAND_TOPIC
from amr_description.navigation.ros.contract.graph import topic_of, UNNAMED
from amr_description.ros.service_calls import wait_until

_PERIOD = 0.05
"""s: ``smoothing_frequency`` 20.0 of Nav2's velocity smoother."""
_REACHED = 0.98
_TURNING_TIME = 5 * NANOSECONDS
_LONGEST_WAY = 2.0
"""m."""
_BRAKING_TIME = 3 * LONGEST_BRAKING
_STANDING_TIME = NANOSECONDS // 4
_SILENCE = 5.0
"""s by the system clock, after which odometry has ended."""
_LOOK_PERIOD = 0.25
"""s between two looks for others that command the robot."""
_ACK_TIMEOUT = Duration(seconds=2.0)


class RivalWatch:
    """Looks for others that command the robot, before it is driven."""

    def __init__(self, collector: Collector) -> None:
        """Look from now on."""
        self._collector = collector
        self._looked = -_LOOK_PERIOD

    def look(self) -> None:
        """
        Look, unless it was done a moment ago; may be called after every message.

        Raises:
            UsageError: somebody else publishes commands to a robot that has odometry.
        """
        now = time.monotonic()
        if not self._collector.odometry or now - self._looked < _LOOK_PERIOD:
            return
        self._looked = now
        topic = topic_of(self._collector.node, COMMAND_TOPIC)
        if all(each.node != UNNAMED for each in topic.publishers):  # else it has its name soon
            _refuse_rivals(topic)


def _refuse_rivals(topic: ContractTopic) -> None:
    if topic.publishers:
        raise UsageError(
            f'--drive: {names_of(topic.publishers)} publishes commands on {topic.name}, and '
            'two would fight over the robot; end it, or leave --drive out'
        )


class ContractDrive:
    """Drives a robot ahead and on the spot; makes a publisher, so one at a time."""

    def __init__(self, collector: Collector, check: Callable[[], object]) -> None:
        """
        Take the command topic.

        Args:
            collector: has the node, which is spun here, and gets the odometry.
            check: called often; raises an exception when the program was asked to stop.

        Raises:
            UsageError: somebody else publishes commands, or nobody subscribes to them.
        """
        self._collector = collector
        self._node = collector.node
        self._check = check
        topic = topic_of(self._node, COMMAND_TOPIC)
        _refuse_rivals(topic)
        kinds = {each.type_name for each in topic.subscriptions}
        if not kinds & {TWIST_TYPE, STAMPED_TWIST_TYPE}:
            raise UsageError(
                f'--drive: nobody subscribes to velocities on {topic.name}; remap it: '
                '--ros-args -r cmd_vel:=TOPIC'
            )
        self._is_stamped = TWIST_TYPE not in kinds
        kind = TwistStamped if self._is_stamped else Twist
        self._publisher = self._node.create_publisher(kind, COMMAND_TOPIC, 1)
        self._command: tuple[float, float] | None = None
        self._sent = 0
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self._node.create_timer(_PERIOD, self._send, clock=steady)
        self._node.get_logger().warning(
            f'driving: about a metre ahead at {LINEAR_SPEED:g} m/s, then on the spot at '
            f'{ANGULAR_SPEED:g} rad/s, by {kind.__name__} on {topic.name}; Ctrl-C stops it'
        )

    def run(self) -> tuple[Phase, ...]:
        """Drive ahead, brake, turn, brake; return what was seen."""
        return (
            self._phase(LINEAR_SPEED, 0.0, self._is_far_enough),
            self._phase(0.0, ANGULAR_SPEED, self._is_turning),
        )

    def stop(self) -> None:
        """Command zero until it is acknowledged, and let go of the topic."""
        self._node.destroy_timer(self._timer)
        self._command = (0.0, 0.0)
        self._send()
        self._publisher.wait_for_all_acked(_ACK_TIMEOUT)
        self._node.destroy_publisher(self._publisher)

    def _phase(
        self, linear: float, angular: float, is_done: Callable[[list[OdometrySeen]], bool]
    ) -> Phase:
        seen = self._collector.odometry
        first = max(0, len(seen) - 1)
        began = seen[first].stamp
        self._command = (linear, angular)
        self._wait(lambda: is_done(seen[first:]))
        self._command = None
        sent = self._sent
        self._wait(lambda: _stands(seen, _stamp_at(seen, sent)))
        ceased = _stamp_at(seen, sent)
        return Phase(linear, angular, began, ceased or seen[-1].stamp, tuple(seen[first:]))

    def _is_far_enough(self, seen: list[OdometrySeen]) -> bool:
        way = math.hypot(seen[-1].x - seen[0].x, seen[-1].y - seen[0].y)
        is_fast = max(each.linear[0] for each in seen) >= _REACHED * LINEAR_SPEED
        is_over = seen[-1].stamp - seen[0].stamp > PROGRESS_TIME
        return (way >= PROGRESS and is_fast) or way >= _LONGEST_WAY or is_over

    def _is_turning(self, seen: list[OdometrySeen]) -> bool:
        is_fast = max(each.angular for each in seen) >= _REACHED * ANGULAR_SPEED
        return is_fast or seen[-1].stamp - seen[0].stamp > _TURNING_TIME

    def _wait(self, condition: Callable[[], bool]) -> None:
        """Spin until a condition holds, or odometry ends."""
        count, since = len(self._collector.odometry), time.monotonic()

        def is_over() -> bool | None:
            nonlocal count, since
            self._check()
            if len(self._collector.odometry) != count:
                count, since = len(self._collector.odometry), time.monotonic()
            return condition() or time.monotonic() - since > _SILENCE or None

        wait_until(self._node, is_over, of_message=True)

    def _send(self) -> None:
        """
        Send the command, if there is one.

        A stamp of zero is taken as the time of arrival: at another real-time factor than 1 any
        other may be too old by then.
        """
        if self._command is None:
            return
        message = TwistStamped() if self._is_stamped else Twist()
        twist = message.twist if self._is_stamped else message
        twist.linear.x, twist.angular.z = self._command
        self._sent = time.time_ns()
        self._publisher.publish(message)


def _stamp_at(seen: list[OdometrySeen], sent: int) -> int | None:
    """
    Return the stamp of the first odometry that came after something was sent; None: none yet.

    The last that this process has looked at may be older.
    """
    return next((each.stamp for each in seen if each.received >= sent), None)


def _stands(seen: list[OdometrySeen], ceased: int | None) -> bool:
    """Return whether the robot has stood for a while, or was waited for long enough."""
    if ceased is None:
        return False
    last = seen[-1].stamp
    if last - ceased > _BRAKING_TIME:
        return True
    if last - ceased < _STANDING_TIME:
        return False
    latest = [each for each in seen if each.stamp >= last - _STANDING_TIME]
    return all(max(*map(abs, e.linear), abs(e.angular)) < STANDING for e in latest)
