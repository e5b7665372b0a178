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
import time

from rclpy.node import Node

from amr_description.doctor.findings import Finding
from amr_description.doctor.ros.collector import PROBES, RosExamination, WINDOW
from amr_description.doctor.ros.sensors import SensorsProbe
from amr_description.doctor.table import examine
from amr_description.viewer.introspection import FindingInfo, Findings

_PERIOD = 25.0
"""s from one examination to the next: each takes 0.2 s of a processor."""
_DISCOVERY = 1.0
"""s from a page's first look to the examination: until then what there is has been discovered."""
_NODE = '_viewer_doctor'
_PROBES = {name: probe for name, probe in PROBES.items() if name != 'navigation'} | {
    'sensors': partial(SensorsProbe, only_subscribed=True)
}


class Health:
    """Examines the graph again and again while pages watch it; on the ROS thread."""

    def __init__(self, node: Node, tell: Callable[[Findings], object]) -> None:
        """``node``: of the viewer; ``tell`` gets the findings of each examination."""
        self._node = node
        self._tell = tell
        self._is_watched = False
        self._began = -_PERIOD
        self._doctor: Node | None = None
        self._examination: RosExamination | None = None
        self.latest: Findings | None = None
        """Those of the last examination, while pages watch them; replaced as a whole."""

    def watch(self, *, is_watched: bool) -> None:
        """Begin to examine, or cease."""
        if is_watched == self._is_watched:
            return
        self._is_watched = is_watched
        self._began = time.monotonic() + _DISCOVERY - _PERIOD
        if not is_watched:
            self._end()
            self.latest = None

    def poll(self) -> None:
        """Go on with the examination; a few times a second."""
        if not self._is_watched:
            return
        now = time.monotonic()
        if self._examination is None:
            if now - self._began >= _PERIOD:
                self._began = now
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


def _info(found: Finding) -> FindingInfo:
    return FindingInfo(found.severity.value, found.rule, found.what, found.why, found.fix)
