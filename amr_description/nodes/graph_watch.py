# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Prints a line for each change of the ROS graph; the bring-up reads them for its conditions.

It is a process of its own, so that the bring-up survives a crash of rclpy::

    + topic /odom nav_msgs/msg/Odometry     has a publisher with this type
    + service /sim/pause                    has a server
    + node /sim
    - node /sim                             is gone

Hidden names (``/_ros2cli``) are omitted.
"""

from collections.abc import Iterator, Set as AbstractSet
import os
import re
import threading

from rclpy.node import Node

from amr_description.ros.runtime import program, ros

_PERIOD = 0.05
"""s between two polls: rclpy has no event for changes of the graph."""
_HIDDEN = re.compile('/_')


def entries(node: Node) -> Iterator[str]:
    """Yield the present entries of the graph, as in the lines."""
    for name, types in node.get_topic_names_and_types():
        if node.count_publishers(name):
            yield from (f'topic {name} {type_name}' for type_name in types)
    for name, _ in node.get_service_names_and_types():
        if node.count_services(name):  # those that have only clients are listed too
            yield f'service {name}'
    for name, namespace in node.get_node_names_and_namespaces():
        yield f'node {namespace.rstrip("/")}/{name}'


def changes(before: AbstractSet[str], now: AbstractSet[str]) -> list[str]:
    """Return the lines for the changes from one set of entries to another."""
    return [f'- {entry}' for entry in sorted(before - now)] + [
        f'+ {entry}' for entry in sorted(now - before)
    ]


def main(args: list[str] | None = None) -> int:
    """Print changes until asked to stop."""

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
