# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Markers of a world, ours (sim/ros/world_markers.py) or a stranger's, as a page draws them.

``/diagnostics`` as pages show it: the last word of each name, by robot.
"""

from collections.abc import Sequence
import math
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from visualization_msgs.msg import Marker, MarkerArray

from amr_description.ros.messages import transform_of
from amr_description.viewer import protocol
from amr_description.viewer.graph import owner
from amr_description.viewer.protocol import DiagnosticItem, Diagnostics

_ENDLESS = 100.0
"""m: a plane that is as wide has no end."""
_KINDS = {
    Marker.CUBE: 'box',
    Marker.SPHERE: 'sphere',
    Marker.CYLINDER: 'cylinder',
    Marker.TRIANGLE_LIST: 'triangles',
}


def shapes_of(message: MarkerArray) -> tuple[protocol.Shape, ...]:
    """Return what a page draws for a message; nothing where a number is none."""
    shapes = (
        _drawn(marker)
        for marker in message.markers
        if marker.action == Marker.ADD and marker.type in _KINDS
    )
    return tuple(shape for shape in shapes if _is_finite(shape))


def _is_finite(shape: protocol.Shape) -> bool:
    numbers = (shape.size, shape.position, shape.orientation, shape.colour, shape.points)
    return all(math.isfinite(number) for each in numbers for number in each)


def _drawn(marker: Any) -> protocol.Shape:
    pose = transform_of(marker.pose)
    color, scale = marker.color, marker.scale
    kind, size, position = _KINDS[marker.type], (scale.x, scale.y, scale.z), pose.translation
    if marker.ns == 'plane' and marker.type == Marker.CUBE:
        kind, position = 'plane', pose.apply((0.0, 0.0, scale.z / 2))
        size = (
            scale.x if scale.x < _ENDLESS else 0.0,
            scale.y if scale.y < _ENDLESS else 0.0,
            0.0,
        )
    points: tuple[float, ...] = ()
    if kind == 'triangles':
        points = tuple(
            value for p in marker.points for value in (p.x * scale.x, p.y * scale.y, p.z * scale.z)
        )
    return protocol.Shape(
        name=marker.text or f'{marker.ns}/{marker.id}',
        kind=kind,  # type: ignore[arg-type]
        size=size,
        position=position,
        orientation=pose.rotation,
        colour=(color.r, color.g, color.b, color.a),
        points=points,
    )


_LEVELS = {
    DiagnosticStatus.OK: 'ok',
    DiagnosticStatus.WARN: 'warn',
    DiagnosticStatus.ERROR: 'error',
    DiagnosticStatus.STALE: 'stale',
}
_MOST = 500
"""Names that are remembered: nobody reads more, and a made-up publisher may invent them."""


class DiagnosticsBoard:
    """
    The last status of each name.

    A name such as ``/robot1/controller_manager: Hardware`` says whose it is; of any other, the
    first robot.
    """

    def __init__(self) -> None:
        self._items: dict[str, DiagnosticItem] = {}

    def take(self, message: DiagnosticArray, robots: Sequence[str]) -> list[Diagnostics]:
        """Take a message; return what there is to tell of each robot."""
        for status in message.status:
            if status.name in self._items or len(self._items) < _MOST:
                level = _LEVELS.get(status.level, 'stale')
                self._items[status.name] = DiagnosticItem(level, status.name, status.message)  # type: ignore[arg-type]
        return [Diagnostics(robot, self._of(robot, robots)) for robot in robots]

    def _of(self, robot: str, robots: Sequence[str]) -> tuple[DiagnosticItem, ...]:
        return tuple(
            item
            for name, item in sorted(self._items.items())
            if (owner(name, robots) or robots[0]) == robot
        )
