# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What comes to and goes from the ROS graph, a line each; the bring-up asks it for its conditions.

It is a process of its own, so that no crash of rclpy takes the bring-up down::

    + topic /odom nav_msgs/msg/Odometry     somebody publishes it, as this type
    + service /sim/pause                    somebody offers it
    + node /sim
    - node /sim                             it is gone

Hidden names (``/_ros2cli``) are left out.
"""

from collections.abc import Iterator, Set as AbstractSet
import os
import re
import threading

from rclpy.node import Node

from amr_description.ros.runtime import program, ros

_PERIOD = 0.05
"""s between two looks: rclpy does not tell when the graph has changed."""
_HIDDEN = re.compile('/_')


def entries(node: Node) -> Iterator[str]:
    """Yield what is there now, in the words of the lines."""
    for name, types in node.get_topic_names_and_types():
        if node.count_publishers(name):
            yield from (f'topic {name} {type_name}' for type_name in types)
    for name, _ in node.get_service_names_and_types():
        if node.count_services(name):  # those that have only clients are listed too
            yield f'service {name}'
    for name, namespace in node.get_node_names_and_namespaces():
        yield f'node {namespace.rstrip("/")}/{name}'


def changes(before: AbstractSet[str], now: AbstractSet[str]) -> list[str]:
    """Return the lines that lead from one state of the graph to another."""
    return [f'- {entry}' for entry in sorted(before - now)] + [
        f'+ {entry}' for entry in sorted(now - before)
    ]


def main(args: list[str] | None = None) -> int:
    """Watch until it is told to stop."""

    def body() -> None:
        with ros(args) as stop:
            node = Node(
                f'_graph_watch_{os.getpid()}', enable_rosout=False, start_parameter_services=False
            )
            stopped = threading.Event()
            try:
                with stop.on_stop(stopped.set):
                    _watch(node, stopped)
            finally:
                node.destroy_node()

    return program(body, stopped=0)


def _watch(node: Node, stopped: threading.Event) -> None:
    before: set[str] = set()
    while True:
        now = {entry for entry in entries(node) if not _HIDDEN.search(entry)}
        for line in changes(before, now):
            print(line)
        before = now
        if stopped.wait(_PERIOD):
            return


if __name__ == '__main__':
    raise SystemExit(main())
