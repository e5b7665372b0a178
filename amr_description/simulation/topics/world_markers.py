# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The static geometry of the world on ``~/world``, for RViz and the browser page.

``visualization_msgs/msg/MarkerArray``, reliable, transient local, depth 1, in the frame ``world``.
``ns`` of a marker is the kind of the shape, ``text`` its name. Shapes without a marker type:

=========  =====================================================================================
plane      a thin CUBE whose upper face is the plane, 100 m wide where it is infinite
capsule    a CYLINDER and two SPHEREs
mesh,      a TRIANGLE_LIST
field
=========  =====================================================================================

The first marker is a DELETEALL, so that a world replaces the one before.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from amr_description.cdr.serialized import serialized
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import PlainMessage
from amr_description.model.frames import rotate
from amr_description.sim.engine import Engine
from amr_description.sim.static_geometry import ShapeKind, visible_shapes, VisibleShape
from amr_description.simulation.topics.names import WORLD_FRAME

TOPIC, TYPE = '~/world', 'visualization_msgs/msg/MarkerArray'
INFINITE_WIDTH = 100.0
"""m; the drawn width of an infinite plane."""
_THICKNESS = 0.002
"""m, of a plane."""
_MARKER = 'visualization_msgs/msg/Marker'
_DELETEALL = 3
_TYPES = {
    ShapeKind.BOX: 1,
    ShapeKind.PLANE: 1,
    ShapeKind.SPHERE: 2,
    ShapeKind.CYLINDER: 3,
    ShapeKind.TRIANGLES: 11,
}


def world_markers(engine: Engine) -> bytes:
    """Return the serialized message for the geometry of a world without robots."""
    return serialized(layout_of(TYPE), markers(visible_shapes(engine.spec)))


def markers(shapes: Sequence[VisibleShape]) -> PlainMessage:
    """Return the message for these shapes."""
    message, first = PlainMessage(TYPE), PlainMessage(_MARKER)
    first.action = _DELETEALL
    message.markers = [first]
    message.markers += [_marker(part) for shape in shapes for part in _parts(shape)]
    for number, marker in enumerate(message.markers):
        marker.id = number
        marker.header.frame_id = WORLD_FRAME
    return message


def _parts(shape: VisibleShape) -> Iterator[VisibleShape]:
    """Yield shapes that have a marker type and together make up ``shape``."""
    if shape.kind is not ShapeKind.CAPSULE:
        yield shape
        return
    width, _, length = shape.size
    half = (length - width) / 2
    yield replace(shape, kind=ShapeKind.CYLINDER, size=(width, width, length - width))
    for end in (half, -half):
        yield replace(
            shape,
            kind=ShapeKind.SPHERE,
            size=(width, width, width),
            position=_along_z(shape, end),
        )


def _marker(shape: VisibleShape) -> PlainMessage:
    marker = PlainMessage(_MARKER)
    marker.ns, marker.text, marker.type = shape.kind.value, shape.name, _TYPES[shape.kind]
    position, (x, y, z) = shape.position, shape.size
    if shape.kind is ShapeKind.PLANE:
        position = _along_z(shape, -_THICKNESS / 2)
        x, y, z = x or INFINITE_WIDTH, y or INFINITE_WIDTH, _THICKNESS
    elif shape.kind is ShapeKind.TRIANGLES:
        x = y = z = 1.0
        marker.points = [_point(*point) for point in shape.points]
    marker.scale.x, marker.scale.y, marker.scale.z = x, y, z
    pose = marker.pose
    pose.position.x, pose.position.y, pose.position.z = position
    q = pose.orientation
    q.x, q.y, q.z, q.w = shape.rotation
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = shape.color
    return marker


def _point(x: float, y: float, z: float) -> PlainMessage:
    point = PlainMessage('geometry_msgs/msg/Point')
    point.x, point.y, point.z = x, y, z
    return point


def _along_z(shape: VisibleShape, distance: float) -> tuple[float, float, float]:
    """Return a point on the shape's own z axis, in the world."""
    x, y, z = shape.position
    dx, dy, dz = rotate(shape.rotation, (0.0, 0.0, distance))
    return (x + dx, y + dy, z + dz)
