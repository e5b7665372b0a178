# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node of ``teleop_twist_keyboard``: parameters, commands, and the type subscribers expect."""

from collections.abc import Sequence
from dataclasses import dataclass

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.duration import Duration
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher

from amr_description.errors import ParameterError
from amr_description.nodes.teleop_twist_keyboard.keys import Velocity
from amr_description.parameters import parameter
from amr_description.ros.parameters import declare
from amr_description.ros.polled_topic import PollingNode
from amr_description.ros.runtime import await_executor
from amr_description.ros.type_mismatch import (
    await_listeners,
    choice,
    is_wanted,
    listeners,
    nobody,
    other_topics,
    TYPE_NAMES,
    wants_stamped,
    warnings,
)

_ACK_TIMEOUT = Duration(seconds=0.2)
_TOPIC = 'cmd_vel'
_SPEED = (1e-6, 1e3)  # m/s, rad/s
_DISCOVERY_TIMEOUT = 1.0  # s to wait for the first subscription


@dataclass(frozen=True)
class TeleopSettings:
    """The parameters of teleop_twist_keyboard; none can be changed while it runs."""

    stamped: bool = parameter(
        False,
        'Publish TwistStamped instead of Twist; not given: what the listeners want',
        read_only=True,
    )
    frame_id: str = parameter('', 'Frame of the commands, with stamped only', read_only=True)
    speed: float = parameter(
        0.5, 'Linear speed at the start', unit='m/s', read_only=True, magnitude=_SPEED
    )
    turn: float = parameter(
        1.0, 'Angular speed at the start', unit='rad/s', read_only=True, magnitude=_SPEED
    )
    repeat_rate: float = parameter(
        10.0,
        'How often a held command is repeated; 0: one message per key press',
        unit='Hz',
        read_only=True,
        minimum=0.0,
        maximum=1000.0,
        magnitude=(1e-3, 1000.0),
    )
    key_timeout: float = parameter(
        0.7,
        'How long a single key press holds; above the delay of the auto-repeat. 0: for ever',
        unit='s',
        read_only=True,
        minimum=0.0,
        magnitude=(1e-3, 1e6),
    )


class TeleopTwistKeyboard(PollingNode):
    """
    The publisher of commands; it knows no keys.

    Args:
        latch: commands hold until the next one, so ``key_timeout`` is 0.

    Raises:
        ParameterError: the parameters contradict each other.
    """

    def __init__(self, *, latch: bool = False) -> None:
        super().__init__('teleop_twist_keyboard')
        self._is_automatic = 'stamped' not in self._parameter_overrides
        defaults = {'key_timeout': 0.0} if latch else {}
        if self._is_automatic:
            found = await_listeners(self, _TOPIC, _DISCOVERY_TIMEOUT)
            defaults['stamped'] = wants_stamped(found, otherwise=False)
        self.settings = declare(self, TeleopSettings, defaults=defaults)
        if latch and self.settings.key_timeout:
            raise ParameterError(
                f"'key_timeout' is {self.settings.key_timeout:g} s, but --latch holds a key until "
                'the next one: give one of them'
            )
        if self.settings.frame_id and not self.settings.stamped:
            raise ParameterError("'frame_id' can only be set when 'stamped' is True")
        self._is_stamped = self.settings.stamped
        self._commands = self._create_commands()
        self._announced: bool | None = None
        self._printed: set[str] = set()
        self._seeks_listeners = True
        self._said_no_listener = False  # it says, too, when there is one

    @property
    def alternative(self) -> str:
        """A command line that drives without a keyboard, for the error without a terminal."""
        twist = '{linear: {x: 0.2}}'
        message = f'{{twist: {twist}}}' if self._is_stamped else twist
        topic, type_name = self._commands.topic_name, TYPE_NAMES[self._is_stamped]
        return f'drive with: ros2 topic pub -r 10 {topic} {type_name} "{message}"'

    def check(self) -> list[str]:
        """Switch to the type that subscribers expect, unless it was given; return new lines."""
        found = listeners(self, _TOPIC)
        if not found:
            return self._where_others_listen()
        self._seeks_listeners = False
        topic = self._commands.topic_name
        if self._is_automatic and not self.settings.frame_id:
            self._change_type(wants_stamped(found, otherwise=self._is_stamped))
        lines = warnings(topic, found, stamped=self._is_stamped)
        is_news = self._announced != self._is_stamped
        is_asked = self._is_automatic or self._said_no_listener
        if is_asked and is_news and is_wanted(found, self._is_stamped):
            self._announced = self._is_stamped
            lines.insert(0, choice(topic, found, stamped=self._is_stamped))
        new = [line for line in lines if line not in self._printed]
        self._printed.update(new)
        return new

    def check_first(self) -> list[str]:
        """As :meth:`check`, with a line if there is no subscription."""
        if listeners(self, _TOPIC):
            return self.check()
        return self._where_others_listen() or [self._nobody([])]

    def _where_others_listen(self) -> list[str]:
        """Return a line with the topics that have listeners, once; they may be found late."""
        if not self._seeks_listeners:
            return []
        others = [topic for topic in other_topics(self) if topic != self._commands.topic_name]
        self._seeks_listeners = not others
        return [self._nobody(others)] if others else []

    def _nobody(self, others: Sequence[str]) -> str:
        self._said_no_listener = True
        return nobody(self._commands.topic_name, others, stamped=self._is_stamped)

    def publish(self, velocity: Velocity) -> None:
        """Publish one command, stamped with the node's clock."""
        message = TwistStamped()
        twist = message.twist
        twist.linear.x, twist.linear.y, twist.linear.z = velocity.x, velocity.y, velocity.z
        twist.angular.z = velocity.yaw
        if self._is_stamped:
            message.header.stamp = self.get_clock().now().to_msg()
            message.header.frame_id = self.settings.frame_id
            self._commands.publish(message)
        else:
            self._commands.publish(twist)

    def stop_robot(self) -> None:
        """Publish zero, and wait shortly until all subscribers have acknowledged it."""
        self.publish(Velocity())
        self._commands.wait_for_all_acked(_ACK_TIMEOUT)

    def _create_commands(self) -> Publisher:
        return self.create_publisher(TwistStamped if self._is_stamped else Twist, _TOPIC, 10)

    def _change_type(self, stamped: bool) -> None:
        """Publish this type from now on, and set the parameter accordingly."""
        if stamped == self._is_stamped:
            return
        self._is_stamped = stamped
        self.destroy_publisher(self._commands)
        await_executor(self)  # a participant has one type a topic: the old publisher must be gone
        self._commands = self._create_commands()
        # The parameter is read-only: the node can only set it together with a descriptor.
        self._set_parameters_atomically_common(
            [Parameter('stamped', value=stamped)],
            {'stamped': self.describe_parameter('stamped')},
        )
