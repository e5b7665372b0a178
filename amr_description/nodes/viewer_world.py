# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Markers of a world, ours (nodes/surroundings_topic.py) or a stranger's, as a page draws them."""

import math
from typing import Any

from visualization_msgs.msg import Marker, MarkerArray

from amr_description.nodes.converters import transform_of
from amr_description.viewer import protocol

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
