# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The markers of a world, and /diagnostics, converted to messages for pages.

The markers may be those of simulation/topics/world_markers.py, or of another simulator.
"""

from collections.abc import Sequence
import math
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from visualization_msgs.msg import Marker, MarkerArray

from amr_description.ros.messages import transform_of
from amr_description.viewer import marks
from amr_description.viewer.graph import robot_of
from amr_description.viewer.protocol import DiagnosticItem, Diagnostics

_ENDLESS = 100.0
"""m: a plane as wide as that is drawn without an end."""
_MOST_STATUSES = 500
"""Names that are kept: nobody reads more, and a faulty publisher could invent new ones."""
_KINDS = {
    Marker.CUBE: 'box',
    Marker.SPHERE: 'sphere',
    Marker.CYLINDER: 'cylinder',
    Marker.TRIANGLE_LIST: 'triangles',
}
_LEVELS = {
    DiagnosticStatus.OK: 'ok',
    DiagnosticStatus.WARN: 'warn',
    DiagnosticStatus.ERROR: 'error',
    DiagnosticStatus.STALE: 'stale',
}


def shapes_of(message: MarkerArray) -> tuple[marks.Shape, ...]:
    """Return the shapes that a page draws; markers with NaN or infinity are left out."""
    shapes = (
        _shape(marker)
        for marker in message.markers
        if marker.action == Marker.ADD and marker.type in _KINDS
    )
    return tuple(shape for shape in shapes if _is_finite(shape))


def _is_finite(shape: marks.Shape) -> bool:
    numbers = (shape.size, shape.position, shape.orientation, shape.colour, shape.points)
    return all(math.isfinite(number) for each in numbers for number in each)


def _shape(marker: Any) -> marks.Shape:
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
    return marks.Shape(
        name=marker.text or f'{marker.ns}/{marker.id}',
        kind=kind,  # type: ignore[arg-type]
        size=size,
        position=position,
        orientation=pose.rotation,
        colour=(color.r, color.g, color.b, color.a),
        points=points,
    )


class LatestDiagnostics:
    """
    The latest status of each name.

    The name, such as ``/robot1/controller_manager: Hardware``, tells the robot; statuses with
    other names are shown with the first robot.
    """

    def __init__(self) -> None:
        self._items: dict[str, DiagnosticItem] = {}

    def update(self, message: DiagnosticArray, robots: Sequence[str]) -> list[Diagnostics]:
        """Take in a message; return the statuses of each robot; ``robots`` are the ids."""
        for status in message.status:
            if status.name in self._items or len(self._items) < _MOST_STATUSES:
                level = _LEVELS.get(status.level, 'stale')
                self._items[status.name] = DiagnosticItem(level, status.name, status.message)  # type: ignore[arg-type]
        return [Diagnostics(robot, self._of(robot, robots)) for robot in robots]

    def _of(self, robot: str, robots: Sequence[str]) -> tuple[DiagnosticItem, ...]:
        return tuple(
            item
            for name, item in sorted(self._items.items())
            if (robot_of(name, robots) or robots[0]) == robot
        )
