# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Names of topics, services and actions, as they are typed."""

from rclpy.exceptions import InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_topic_name import validate_topic_name

from amr_description.errors import AmrError
from amr_description.text import shorten


def full_name(node: Node, name: str, what: str = 'a topic') -> str:
    """
    Return the absolute name, ``/chatter`` for ``chatter``.

    Args:
        node: of the verb.
        name: as it is typed.
        what: what it is the name of, for the error; the rules are the same for all.

    Raises:
        AmrError: it is not a name.
    """
    try:
        name.encode()  # rclpy demands Unicode
        validate_topic_name(name)
        expanded = expand_topic_name(name, node.get_name(), node.get_namespace())
        validate_full_topic_name(expanded)
    except (InvalidTopicNameException, ValueError) as error:
        reason = str(error).splitlines()[0].removeprefix('Invalid topic name: ').rstrip(':')
        reason = reason.removeprefix('topic ').partition(', at /')[
            0
        ]  # a location in the sources of rcl
        raise AmrError(f"'{shorten(name)}' is not {what}: {reason}") from error
    return expanded
