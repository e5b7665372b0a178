# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What pages show of the ROS graph itself: topics and nodes, services, the TF tree, the log.

Each is collected only while a page shows it, but for the last warnings. On the ROS thread.
"""

from collections.abc import Callable, Sequence, Set as AbstractSet
from typing import TypeAlias

from rclpy.node import Node

from amr_description.viewer.forms import Services
from amr_description.viewer.introspection import Findings, Log, Topics, Transforms
from amr_description.viewer.requests import Part
from amr_description.viewer.ros.health import Health
from amr_description.viewer.ros.log_lines import RosoutLines
from amr_description.viewer.ros.topic_list import list_services, list_topics, TopicRates
from amr_description.viewer.ros.transform_list import TransformList

_EVERY = 3
"""Polls from one list of topics to the next: to make it takes 100 µs a topic."""

GraphMessage: TypeAlias = Topics | Services | Transforms | Log | Findings
Tell: TypeAlias = Callable[[Part, GraphMessage], object]


class Introspection:
    """
    Collects while it is open; ``tell`` gets what is new, on the ROS thread.

    :attr:`latest` has what a page that begins to show a part is sent; it is replaced as a whole.
    """

    def __init__(self, node: Node, tell: Tell) -> None:
        self._node = node
        self._tell = tell
        self._parts: AbstractSet[Part] = frozenset()
        self._rates = TopicRates(node)
        self._topics: Topics | None = None
        self._services: Services | None = None
        self._transforms: TransformList | None = None
        self._namespaces: tuple[str, ...] = ()
        self._log: RosoutLines | None = None
        self._polls = 0
        self._health = Health(node, self._tell_findings)

    def open(self) -> None:
        """The first page is there."""
        self._log = RosoutLines(self._node)

    def close(self) -> None:
        """There are no pages any more."""
        self.watch(frozenset(), ())
        if self._log is not None:
            self._log.destroy()
            self._log = None

    def latest(self, part: Part) -> GraphMessage | None:
        """Return what a page that begins to show a part is sent at once; on any thread."""
        log = self._log
        if part == 'log' and log is not None:
            return Log(log.kept)
        if part in {'findings', 'alarms'}:
            return self._health.latest
        if part == 'services':
            return self._services
        return self._topics if part == 'topics' else None

    def watch(self, parts: AbstractSet[Part], namespaces: Sequence[str]) -> None:
        """Collect these parts; ``namespaces``: of robots with a TF of their own."""
        begun = parts - self._parts
        self._health.watch(is_shown='findings' in parts, is_watched='alarms' in parts)
        self._parts = parts
        if 'rates' not in parts:
            self._rates.measure(())
        if 'topics' not in parts:
            self._topics = None
        if 'services' not in parts:
            self._services = None
        if self._transforms is not None and (
            'transforms' not in parts or tuple(namespaces) != self._namespaces
        ):
            self._transforms.destroy()
            self._transforms = None
        if 'transforms' in parts and self._transforms is None:
            self._namespaces = tuple(namespaces)
            self._transforms = TransformList(self._node, namespaces)
        if 'topics' in begun:
            self._list_topics()
        if 'services' in begun:
            self._list_services()

    def poll(self) -> None:
        """Tell what is new."""
        self._polls += 1
        self._health.poll()
        if self._log is not None and (lines := self._log.take()) and 'log' in self._parts:
            self._tell('log', Log(lines))
        if self._transforms is not None:
            self._tell('transforms', self._transforms.poll())
        if self._polls % _EVERY:
            return
        if 'topics' in self._parts:
            self._list_topics()
        if 'services' in self._parts:
            self._list_services()

    def _tell_findings(self, found: Findings) -> None:
        self._tell('findings', found)
        self._tell('alarms', found)

    def _list_topics(self) -> None:
        if 'rates' in self._parts:
            names = [name for name, _ in self._node.get_topic_names_and_types()]
            self._rates.measure(names)
        topics = list_topics(self._node, self._rates)
        if topics != self._topics:
            self._topics = topics
            self._tell('topics', topics)

    def _list_services(self) -> None:
        services = list_services(self._node)
        if services != self._services:
            self._services = services
            self._tell('services', services)
