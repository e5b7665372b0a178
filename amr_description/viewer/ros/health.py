# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The findings of ``ros2 doctor``, for the pages that show them.

One examination at a time serves all pages, by a hidden node that is there as long as it takes.
What costs processor time is left out: sensors without subscribers, which a simulator would measure
for this alone, and what Nav2 demands. The machine and the environment are those of the shell in
which ``ros2 doctor`` is typed.
"""

from collections.abc import Callable
from functools import partial
import math
import re
import time

from rclpy.node import Node

from amr_description.doctor.findings import Finding
from amr_description.doctor.ros.collector import PROBES, RosExamination, WINDOW
from amr_description.doctor.ros.sensors import SensorsProbe
from amr_description.doctor.table import examine
from amr_description.viewer.introspection import FindingInfo, Findings

_PERIOD = 25.0
"""s from one examination to the next while pages show it: each takes 0.2 s of a processor."""
_SLOW_PERIOD = 60.0
"""… at least, while pages only want to know of errors: then it waits for a change of the graph."""
_LOOK = 5.0
"""s between two looks for such a change."""
_DISCOVERY = 1.0
"""s from a page's first look to the examination: until then what there is has been discovered."""
_SLOW_DISCOVERY = 10.0
"""… while pages only want to know of errors: robots and pages have come up by then."""
_NODE = '_viewer_doctor'
_COMMAND = re.compile(
    r'(?:(?<=^)|(?<=, or )|(?<=; )|(?<=: ))(?:ros2|export|unset|source|kill|sudo) .*?'
    r'(?=, or |; | \(|$)'
)
_PROBES = {name: probe for name, probe in PROBES.items() if name != 'navigation'} | {
    'sensors': partial(SensorsProbe, only_subscribed=True)
}


class Health:
    """Examines the graph again and again while pages watch it; on the ROS thread."""

    def __init__(self, node: Node, tell: Callable[[Findings], object]) -> None:
        """``node``: of the viewer; ``tell`` gets the findings of each examination."""
        self._node = node
        self._tell = tell
        self._since = math.inf
        """When pages began to watch, s of a monotonic clock."""
        self._is_shown = False
        self._began = 0.0
        self._looked = 0.0
        self._graph: object = None
        """Of the last examination."""
        self._doctor: Node | None = None
        self._examination: RosExamination | None = None
        self.latest: Findings | None = None
        """Those of the last examination, while pages watch them; replaced as a whole."""

    def watch(self, *, is_shown: bool, is_watched: bool) -> None:
        """Begin to examine, or cease: soon for who is shown all, else after a while."""
        self._is_shown = is_shown
        if is_shown or is_watched:
            self._since = min(self._since, time.monotonic())
        else:
            self._end()
            self._since, self.latest = math.inf, None

    def _is_due(self, now: float) -> bool:
        if self.latest is None:
            return now >= self._since + (_DISCOVERY if self._is_shown else _SLOW_DISCOVERY)
        if self._is_shown:
            return now >= self._began + _PERIOD
        if now < max(self._began + _SLOW_PERIOD, self._looked + _LOOK):
            return False
        self._looked = now
        return self._graph != self._graph_now()

    def _graph_now(self) -> object:
        """Return the nodes and topics that there are: most faults come with a new one."""
        node = self._node
        nodes = [each for each in node.get_node_names_and_namespaces() if each[0] != _NODE]
        return sorted(nodes), sorted(node.get_topic_names_and_types())

    def poll(self) -> None:
        """Go on with the examination; a few times a second."""
        now = time.monotonic()
        if self._examination is None:
            if self._is_due(now):
                self._began, self._graph = now, self._graph_now()
                self._begin()
            return
        if self._examination.is_done or now - self._began >= WINDOW:
            found = examine(self._examination.observe())
            self._end()
            self.latest = Findings(tuple(map(_info, found)))
            self._tell(self.latest)

    def _begin(self) -> None:
        self._doctor = Node(
            _NODE,
            context=self._node.context,
            namespace='/',
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
        )
        assert self._node.executor is not None, 'it is polled by a timer of the node'
        self._node.executor.add_node(self._doctor)
        self._examination = RosExamination(self._doctor, _PROBES)

    def _end(self) -> None:
        if self._examination is not None:
            self._examination.end()
            self._examination = None
        if self._doctor is not None:
            if self._node.executor is not None:
                self._node.executor.remove_node(self._doctor)
            self._doctor.destroy_node()
            self._doctor = None


def with_quotes(fix: str) -> str:
    """Return what mends a fault with its commands between back-quotes, for pages to copy them."""
    return _COMMAND.sub(r'`\g<0>`', fix)


def _info(found: Finding) -> FindingInfo:
    fix = with_quotes(found.fix)
    return FindingInfo(found.severity.value, found.rule, found.what, found.why, fix)
