# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Who uses a topic with another message type: DDS connects only equal types, and tells nobody.

The classic is Twist where a controller wants TwistStamped; without a word nothing moves. So a
publisher of velocity commands looks at the subscriptions on its topic, and follows their type.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.service_calls import wait_until

TYPE_NAMES = {False: 'geometry_msgs/msg/Twist', True: 'geometry_msgs/msg/TwistStamped'}
"""By whether it is stamped."""

NAMELESS = 'a listener'
"""A node is discovered a moment after its subscriptions, and one without ROS never."""


def mismatches(
    ours: str, topic: str, endpoints: Iterable[TopicEndpointInfo], publishing: bool
) -> list[str]:
    """
    Return a warning for each node whose endpoint has another type.

    Args:
        ours: The type that this program uses.
        topic: Its full name.
        endpoints: Those of the other side.
        publishing: Whether this program publishes, or else subscribes.
    """
    here, there = ('publish', 'expects') if publishing else ('subscribe to', 'publishes')
    return sorted(
        {
            f'WARNING: you {here} {ours} on {topic}, but '
            f'{e.node_namespace.rstrip("/")}/{e.node_name} {there} {e.topic_type} there: '
            f'nothing will arrive; use {e.topic_type}'
            for e in endpoints
            if e.topic_type != ours
        }
    )


@dataclass(frozen=True, slots=True, order=True)
class MismatchListener:
    """A node that subscribes to the topic, by its full name, and the type of its subscription."""

    node: str
    type_name: str


def listeners(node: Node, topic: str) -> list[MismatchListener]:
    """Return who subscribes to a topic of ``node``, before remapping, each once."""
    found = node.get_subscriptions_info_by_topic(topic)
    return sorted(
        {MismatchListener(endpoint_node(each) or NAMELESS, each.topic_type) for each in found}
    )


def await_listeners(node: Node, topic: str, timeout: float) -> list[MismatchListener]:
    """As :func:`listeners`, but wait up to ``timeout`` s for the first, and for their names."""

    def known() -> list[MismatchListener] | None:
        found = listeners(node, topic)
        return found if found and NAMELESS not in [each.node for each in found] else None

    return wait_until(node, known, timeout=timeout) or listeners(node, topic)


def other_topics(node: Node) -> list[str]:
    """Return the topics on which somebody subscribes to commands, of either type."""
    return [
        name
        for name, types in node.get_topic_names_and_types()
        if not {*types}.isdisjoint(TYPE_NAMES.values()) and node.count_subscribers(name)
    ]


def wants_stamped(found: Iterable[MismatchListener], *, otherwise: bool) -> bool:
    """Whether all subscribe to the stamped type; ``otherwise``: there are both, or none."""
    wanted = {each.type_name for each in found}
    kinds = [stamped for stamped, name in TYPE_NAMES.items() if name in wanted]
    return kinds[0] if len(kinds) == 1 else otherwise


def is_wanted(found: Iterable[MismatchListener], stamped: bool) -> bool:
    """Whether somebody subscribes to this type."""
    return any(each.type_name == TYPE_NAMES[stamped] for each in found)


def choice(topic: str, found: Iterable[MismatchListener], *, stamped: bool) -> str:
    """Return the line that says which type is published, for whom."""
    ours = TYPE_NAMES[stamped]
    served = [each.node for each in found if each.type_name == ours]
    verb = 'wants' if len(served) == 1 else 'want'
    return f'publishing {_short(ours)} on {topic}: {" and ".join(served)} {verb} it'


def warnings(topic: str, found: Iterable[MismatchListener], *, stamped: bool) -> list[str]:
    """Return a line for each that subscribes to the other type: nothing reaches it."""
    return [
        f'WARNING: {each.node} wants {_short(each.type_name)} on {topic}, but this publishes '
        f'{_short(TYPE_NAMES[stamped])}: nothing will arrive; use '
        f'-p stamped:={str(not stamped).lower()}'
        for each in found
        if each.type_name == TYPE_NAMES[not stamped]
    ]


def unheard_lines(node: Node, topic: str, stamped: bool, option: str) -> list[str]:
    """
    Return a line for each node that subscribes to the other type than is published.

    Args:
        node: publishes.
        topic: the full name.
        stamped: whether it publishes the stamped type.
        option: its parameter that says which type.
    """
    other = TYPE_NAMES[not stamped]
    return [
        f'{each.node} wants {other} on {topic}, but this publishes {TYPE_NAMES[stamped]}: nothing '
        f'will arrive; use -p {option}:={str(not stamped).lower()}'
        for each in listeners(node, topic)
        if each.type_name == other
    ]


def nobody(topic: str, others: Sequence[str], *, stamped: bool) -> str:
    """Return the line that a topic has no listeners, and which topics have some."""
    elsewhere = f'; -r cmd_vel:={" or ".join(others)} has one' if others else ''
    return (
        f'publishing {_short(TYPE_NAMES[stamped])} on {topic}, which has no listener '
        f'yet{elsewhere}'
    )


def _short(type_name: str) -> str:
    return type_name.rpartition('/')[2]
