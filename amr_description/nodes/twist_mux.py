# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
``twist_mux``: of several velocity commands, let that of the highest priority go on to the wheels.

::

    ros2 run twist_mux twist_mux --ros-args --params-file twist_mux.yaml \
        -r cmd_vel_out:=/diff_drive_controller/cmd_vel

======================  =======================================================================
subscribes to           ``Twist`` or ``TwistStamped`` on each ``topics.NAME.topic``,
                        ``std_msgs/msg/Bool`` on each ``locks.NAME.topic``
publishes               ``cmd_vel_out``: ``TwistStamped``, or ``Twist`` with ``use_stamped:
                        false``; ``/diagnostics``, once a second
======================  =======================================================================

Parameters, rules, texts and QoS are those of twist_mux 4.5, see
:mod:`amr_description.navigation.twist_mux`. In the original ``use_stamped`` is the type of all
inputs, too, and one of the other type is never heard, without a word. Here each input has the type
of whoever publishes on it, and Twist before anybody does; a command that gets a stamp on its way
has that of its arrival.
"""

from dataclasses import dataclass

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.clock import Clock
from rclpy.qos import QoSPresetProfiles, QoSProfile
from rclpy.subscription import Subscription
from rclpy.time import ClockType
from std_msgs.msg import Bool

from amr_description.errors import ParameterError
from amr_description.navigation.twist_mux import Channel, MuxSettings, read_settings, TwistMux
from amr_description.parameters import parameter
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare, declare_overrides
from amr_description.ros.polled_topic import PollingNode
from amr_description.ros.runtime import run
from amr_description.ros.type_mismatch import TYPE_NAMES, unheard_lines
from amr_description.text import unwrap

_PURPOSE = (
    'Let the velocity command of the highest priority go on to cmd_vel_out, as locks allow. Its '
    'inputs and locks are parameters too: topics.NAME.topic, .timeout (s) and .priority (0 to '
    '255), locks.NAME likewise.'
)
_OUTPUT = 'cmd_vel_out'
_DIAGNOSTICS_PERIOD = 1.0
_CHECK_PERIOD = 0.2
"""s between two looks at who publishes on the inputs: rclpy has no event for that."""


@dataclass(frozen=True)
class MuxParameters:
    """The parameters of the node itself; none can be changed while it runs."""

    use_stamped: bool = parameter(
        True, 'Publish TwistStamped, not Twist; inputs may be of both types', read_only=True
    )


class TwistMuxNode(PollingNode):
    """
    The node.

    Raises:
        ParameterError: inputs and locks are not what they should be.
    """

    def __init__(self) -> None:
        super().__init__('twist_mux', allow_undeclared_parameters=True)
        self._is_stamped = declare(self, MuxParameters).use_stamped
        declare_overrides(self)
        found = read_settings(
            {name: each.value for name, each in self.get_parameters_by_prefix('').items()}
        )
        self._said: set[str] = set()
        self._mux = TwistMux(found.inputs, found.locks)
        output = TwistStamped if self._is_stamped else Twist
        self._commands = self.create_publisher(output, _OUTPUT, QoSProfile(depth=1))
        self._sources = self._subscribe(found)
        self._diagnostics = self.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=1)
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_DIAGNOSTICS_PERIOD, self._publish_diagnostics, clock=steady)
        self.create_timer(_CHECK_PERIOD, self._check, clock=steady)
        for line in found.remarks:
            self.get_logger().warning(line)

    def _subscribe(self, settings: MuxSettings) -> list['_Source']:
        """Subscribe to inputs and locks; return those of the inputs. Raises ParameterError."""
        by_topic: dict[str, list[Channel]] = {}
        for each in settings.inputs:
            topic = self._full_name(each)
            if topic == self._commands.topic_name:
                raise ParameterError(
                    f"parameter '{each.name}.topic' is {topic}, which is also {_OUTPUT}: the node "
                    f'would hear itself; remap one of them, as -r {_OUTPUT}:=/wheels/cmd_vel'
                )
            by_topic.setdefault(topic, []).append(each)
            self._announce(each)
        for lock in settings.locks:
            self._full_name(lock)
            self._subscribe_to_lock(lock)
            self._announce(lock)
        return [_Source(self, topic, channels) for topic, channels in by_topic.items()]

    def _full_name(self, channel: Channel) -> str:
        """Return the topic of a channel after remapping. Raises ParameterError: it is no name."""
        try:
            return self.resolve_topic_name(channel.topic)
        except RuntimeError as error:  # what rclpy raises for what rcl refuses
            raise ParameterError(
                f"parameter '{channel.name}.topic' is '{channel.topic}': {unwrap(str(error))}"
            ) from None

    def _subscribe_to_lock(self, lock: Channel) -> None:
        def receive(message: Bool) -> None:
            self._mux.hear_lock(lock.name, message.data, self._now())

        self.create_subscription(Bool, lock.topic, receive, QoSPresetProfiles.SYSTEM_DEFAULT.value)

    def _announce(self, channel: Channel) -> None:
        timeout = f'{channel.timeout / 1e9:f}s' if channel.timeout else 'None'
        self.get_logger().info(
            f"Topic handler '{channel.name}' subscribed to topic '{channel.topic}': "
            f'timeout = {timeout} , priority = {channel.priority}.'
        )

    def take(self, channels: list[Channel], message: Twist | TwistStamped) -> None:
        """Let a command of these inputs go on, if it may."""
        now = self._now()
        for each in channels:
            if self._mux.hear_command(each.name, now):
                self._commands.publish(self._converted(message))

    def warn_once(self, line: str) -> None:
        """Log a line, unless it has been logged."""
        if line not in self._said:
            self._said.add(line)
            self.get_logger().warning(line)

    def _converted(self, message: Twist | TwistStamped) -> Twist | TwistStamped:
        """Return a command in the type of the output."""
        if not self._is_stamped:
            return message.twist if isinstance(message, TwistStamped) else message
        if isinstance(message, TwistStamped):
            return message
        stamped = TwistStamped(twist=message)
        stamped.header.stamp = self.get_clock().now().to_msg()
        return stamped

    def _check(self) -> None:
        """Follow the types of the publishers, and say who cannot hear the output."""
        for each in self._sources:
            each.follow()
        topic = self._commands.topic_name
        for line in unheard_lines(self, topic, self._is_stamped, 'use_stamped'):
            self.warn_once(line)

    def _publish_diagnostics(self) -> None:
        status = DiagnosticStatus(
            level=DiagnosticStatus.OK,
            name=f'{self.get_name()}: Twist mux status',
            message='ok',
            hardware_id='none',
            values=[KeyValue(key=key, value=text) for key, text in self._mux.report(self._now())],
        )
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)

    def _now(self) -> int:
        return self.get_clock().now().nanoseconds


class _Source:
    """A topic of inputs, subscribed to with the type of its publishers."""

    def __init__(self, node: TwistMuxNode, topic: str, channels: list[Channel]) -> None:
        """``channels``: those that have this topic, mostly one."""
        self._node, self._topic, self._channels = node, topic, channels
        # What Nav2 and most others publish if they are not told otherwise.
        self._is_stamped = False
        self._subscription: Subscription | None = None
        self._subscribe()

    def follow(self) -> None:
        """Look who publishes; take the other type, if all of them have that."""
        publishers: dict[str, set[str]] = {}
        for each in self._node.get_publishers_info_by_topic(self._topic):
            publishers.setdefault(each.topic_type, set()).add(endpoint_node(each) or 'a publisher')
        ours, other = TYPE_NAMES[self._is_stamped], TYPE_NAMES[not self._is_stamped]
        if ours not in publishers and other in publishers and self._subscription is not None:
            self._is_stamped = not self._is_stamped
            self._node.destroy_subscription(self._subscription)
            self._subscription = None
            # A participant has one type a topic, and the executor lets go of the old one first.
            assert self._node.executor is not None, 'it calls this'
            self._node.executor.create_task(self._subscribe)
            return
        for type_name, nodes in publishers.items():
            if type_name != ours:
                self._node.warn_once(
                    f'{", ".join(sorted(nodes))} publishes {type_name} on {self._topic}, where '
                    f'{ours} is published too: only the latter is heard; give each a topic'
                    if ours in publishers
                    else f'{", ".join(sorted(nodes))} publishes {type_name} on {self._topic}: '
                    f'commands are {ours} or {other}'
                )

    def _subscribe(self) -> None:
        self._subscription = self._node.create_subscription(
            TwistStamped if self._is_stamped else Twist,
            self._topic,
            lambda message: self._node.take(self._channels, message),
            QoSPresetProfiles.SYSTEM_DEFAULT.value,
        )


def main(args: list[str] | None = None) -> int:
    """Multiplex until asked to stop."""
    if print_help(args, 'twist_mux', _PURPOSE, MuxParameters):
        return 0
    return run(TwistMuxNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
