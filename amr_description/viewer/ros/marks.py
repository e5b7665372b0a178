# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What others draw: markers, poses, polygons and points as samples for pages, checked as RViz does.

Pure, on any thread. What cannot be drawn is said in RViz's words, once for all marks that are so.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
import math
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import (
    matrix_from_quaternion,
    multiply,
    normalize,
    Quaternion,
    quaternion_from_axis_angle,
    rotate,
    Vector,
)
from amr_description.ros import readers
from amr_description.ros.readers import Header, MarkerData
from amr_description.text import shorten
from amr_description.viewer.marks import MarkBatch, MarkText
from amr_description.viewer.protocol import Marks, Origin
from amr_description.viewer.ros.navigation_samples import frame_name
from amr_description.viewer.samples import MOST_POINTS

_MOST_BATCHES = 250
_MOST_TEXTS = 100
_MOST_FAULTS = 20
"""The head of a sample has less than 64 KiB."""
_NOT_FINITE = 'Message contained invalid floating point values (nans or infs)'
_NO_FRAME = 'For frame []: Frame [] does not exist'
_NO_QUATERNION = 'Uninitialized quaternion, assuming identity.'
_TRANSPARENT = 'Marker is fully transparent (color.a is 0.0).'
_NO_SCALE = 'Scale contains 0.0 in x, y or z.'
_ROUGHLY_ONE = 0.01

_ARROW, _LINE_STRIP, _LINE_LIST, _CUBE_LIST, _SPHERE_LIST, _POINTS = 0, 4, 5, 6, 7, 8
_TEXT, _MESH, _TRIANGLES, _ARROW_STRIP = 9, 10, 11, 12
"""visualization_msgs/msg/Marker"""
_SHAPES: Mapping[int, '_Kind'] = {1: 'box', 2: 'sphere', 3: 'cylinder'}
_POINTS_OF = {_LINE_LIST: 2, _TRIANGLES: 3, _CUBE_LIST: 1, _SPHERE_LIST: 1, _POINTS: 1}
_SHAPE_LISTS: Mapping[int, '_Kind'] = {_CUBE_LIST: 'box', _SPHERE_LIST: 'sphere'}

# RViz's defaults of its displays: m, and red, green, blue.
_SHAFT, _HEAD_WIDTH = 0.77, 2.0
"""Of an arrow without points: share of its length, and of its width."""
_POSE_LENGTH, _POSE_HEAD, _POSE_WIDTH = 0.3, 0.07, 0.03
_POSE_COLOUR = (1.0, 0.1, 0.0)
_POLYGON_COLOUR = (0.1, 1.0, 0.0)
_POINT_DIAMETER, _POINT_COLOUR = 0.4, (0.8, 0.16, 0.8)

_Kind: TypeAlias = Literal[
    'box', 'sphere', 'cylinder', 'cone', 'mesh', 'lines', 'points', 'triangles'
]
Array: TypeAlias = np.ndarray
Drawn: TypeAlias = tuple[Marks, tuple[Array, ...]]
_ALONG_X: Quaternion = quaternion_from_axis_angle((0.0, 1.0, 0.0), math.pi / 2)
"""Turns z to x."""


class _Likeness(NamedTuple):
    """What the marks of a batch have in common, see MarkBatch."""

    kind: _Kind
    frame: str
    stamp: float | None
    opacity: float
    size: float = 0.0
    resource: str = ''
    address: str = ''
    is_tinted: bool = False


class MarkError(Exception):
    """Why a mark is not drawn, in RViz's words."""


def size_of(marker: MarkerData) -> int:
    """Return of how many shapes, lines and points a marker is."""
    count = len(marker.points)
    if marker.type in (_LINE_STRIP, _ARROW_STRIP):
        return max(1, count - 1)
    return max(1, count // _POINTS_OF[marker.type]) if marker.type in _POINTS_OF else 1


@dataclass(frozen=True, slots=True)
class _Stand:
    """Where a mark is, and how it is turned and coloured."""

    frame: str
    stamp: float | None
    position: Vector
    rotation: Quaternion
    color: tuple[float, ...]

    def key(self, kind: _Kind, opacity: float, size: float = 0.0) -> _Likeness:
        return _Likeness(kind, self.frame, self.stamp, opacity, size)

    def apply(self, points: Array) -> Array:
        """Return points of the mark in its frame, m, shape (n, 3)."""
        matrix = np.array(matrix_from_quaternion(self.rotation))
        moved: Array = points @ matrix.T + np.array(self.position)
        return moved


class MarkDrawing:
    """
    Batches of marks.

    ``total``: of all shapes, lines and points that there are; ``singles``: of these, markers of
    one, which are left out only where they alone are too many.
    """

    def __init__(self, total: int, singles: int = 0) -> None:
        self._total = total
        room = max(MOST_POINTS - singles, MOST_POINTS // 10)
        self._thin = max(1, -(-(total - singles) // room))
        self._thin_singles = max(1, -(-singles // MOST_POINTS))
        self._batches: dict[_Likeness, list[Array]] = {}
        self._texts: list[MarkText] = []
        self._faults: dict[str, list[str]] = {}
        self._shown = 0
        self._singles = 0

    def tell(self, text: str, name: str) -> None:
        """Say what is wrong with a mark, by its name."""
        self._faults.setdefault(text, []).append(name)

    def add_marker(self, marker: MarkerData, mesh: Callable[[MarkerData], str]) -> None:
        """Draw a marker, or say why not; ``mesh`` returns the address of its mesh."""
        name = f'{marker.ns}/{marker.id}'
        try:
            place = self._place_of(marker, name)
            if size_of(marker) == 1 and not self._is_next():
                return
            if marker.type == _MESH:
                self._add_mesh(marker, place, mesh)
            else:
                self._add(marker, place, name)
        except MarkError as fault:
            self.tell(str(fault), name)

    def _is_next(self) -> bool:
        """Whether one of those that are one thing each is drawn, where there are very many."""
        self._singles += 1
        return (self._singles - 1) % self._thin_singles == 0

    def _place_of(self, marker: MarkerData, name: str) -> _Stand:
        parts = (marker.pose, marker.scale, marker.color, marker.points, marker.colors)
        if not all(_is_finite(each) for each in parts):
            raise MarkError(_NOT_FINITE)
        place = self.place(marker.header, marker.pose, name, color=marker.color)
        return replace(place, stamp=None) if marker.frame_locked else place

    def place(
        self, header: Header, pose: Sequence[float], name: str, *, color: Sequence[float]
    ) -> _Stand:
        """Return where a pose is. May raise."""
        if not header.frame:
            raise MarkError(_NO_FRAME)
        x, y, z, *turn = pose
        qx, qy, qz, qw = turn
        norm = math.sqrt(sum(each * each for each in turn))
        if norm == 0.0:
            self.tell(_NO_QUATERNION, name)
            qw = 1.0
        elif abs(norm - 1.0) > _ROUGHLY_ONE:
            self.tell('Unnormalized quaternion in marker message.', name)
        rotation = normalize((qx, qy, qz, qw))
        stamp = header.stamp / NANOSECONDS
        clipped = tuple(min(max(float(each), 0.0), 1.0) for each in color)
        return _Stand(frame_name(header.frame), stamp, (x, y, z), rotation, clipped)

    def _add(self, marker: MarkerData, place: _Stand, name: str) -> None:
        kind = marker.type
        if kind == _TEXT:
            self._add_text(marker, place)
        elif kind in (_ARROW, _ARROW_STRIP):
            self._add_arrows(marker, place)
        elif kind in _SHAPES:
            _check_scale(marker)
            self._add_shapes(_SHAPES[kind], place, np.zeros((1, 3)), marker.scale, _one(place))
        elif kind in (_LINE_STRIP, _LINE_LIST, *_SHAPE_LISTS, _POINTS, _TRIANGLES):
            self._add_list(marker, place, name)
        else:
            raise MarkError(f'Unknown marker type: {kind}')

    def _add_list(self, marker: MarkerData, place: _Stand, name: str) -> None:
        kind, points = marker.type, marker.points
        if not len(points):
            raise MarkError('Points array is empty.')
        colors, opacity = self._colors(marker, place, name)
        places = place.apply(points)
        if kind in _SHAPE_LISTS:
            _check_scale(marker)
            chosen = self.thinned(len(points))
            colors = colors[chosen]
            self._add_shapes(
                _SHAPE_LISTS[kind], place, points[chosen], marker.scale, (colors, opacity)
            )
        elif kind == _POINTS:
            if 0.0 in marker.scale[:2]:
                raise MarkError('Width and/or height of POINTS is 0.0 (scale.x, scale.y).')
            chosen = self.thinned(len(points))
            rows = np.hstack([places[chosen], colors[chosen]])
            self._put(place.key('points', opacity, abs(marker.scale[0])), rows)
        elif kind == _TRIANGLES:
            self._add_triangles(marker, place, (places, colors, opacity))
        else:
            self._add_lines(marker, place, (places, colors, opacity))

    def _add_triangles(
        self, marker: MarkerData, place: _Stand, corners: tuple[Array, Array, float]
    ) -> None:
        points, colors, opacity = corners
        if len(points) % 3:
            raise MarkError('Number of points should be a multiple of 3 for TRIANGLE_LIST marker.')
        if 0.0 in marker.scale:
            raise MarkError(_NO_SCALE)
        points = place.apply(marker.points * np.array(marker.scale))
        rows = np.hstack([points, colors]).reshape(-1, 18)
        chosen = rows[self.thinned(len(rows))].reshape(-1, 6)
        self._put(place.key('triangles', opacity), chosen, 3)

    def _add_lines(
        self, marker: MarkerData, place: _Stand, ends: tuple[Array, Array, float]
    ) -> None:
        points, colors, opacity = ends
        if marker.scale[0] == 0.0:
            raise MarkError('Width LINE_LIST or LINE_STRIP is 0.0 (scale.x).')
        if marker.type == _LINE_LIST:
            if len(points) % 2:
                raise MarkError('Number of points should be a multiple of 2 for LINE_LIST marker.')
            chosen = self.thinned(len(points) // 2)
            begin, end = 2 * chosen, 2 * chosen + 1
        else:
            if len(points) < 2:  # noqa: PLR2004
                raise MarkError('At least two points are required for a LINE_STRIP marker.')
            chosen = self.thinned(len(points) - 1)
            begin, end = chosen, np.append(chosen[1:], len(points) - 1)
        rows = np.hstack([points[begin], points[end], colors[begin], colors[end]])
        self._put(place.key('lines', opacity, abs(marker.scale[0])), rows)

    def _add_arrows(self, marker: MarkerData, place: _Stand) -> None:
        count = len(marker.points)
        if marker.type == _ARROW and count not in (0, 2):
            raise MarkError('Number of points for an ARROW marker should be either 0 or 2.')
        if marker.type == _ARROW_STRIP and count < 2:  # noqa: PLR2004
            raise MarkError('At least two points are required for an ARROW_STRIP marker.')
        x, y, z = marker.scale
        _, opacity = _one(place)
        if opacity == 0.0:
            raise MarkError(_TRANSPARENT)
        if not count:
            _check_scale(marker)
            sizes = (x * _SHAFT, y, x * (1.0 - _SHAFT), y * _HEAD_WIDTH)
            self._arrow(place, (place.position, place.rotation), sizes, z / y)
            return
        chosen = self.thinned(count - 1)
        for begin, end in zip(chosen, np.append(chosen[1:], count - 1), strict=True):
            first, second = marker.points[begin], marker.points[end]
            length = float(np.linalg.norm(second - first))
            if length == 0.0:
                continue
            head = min(z if z else (1.0 - _SHAFT) * length, length)
            turn = multiply(place.rotation, _from_x((second - first) / length))
            at = tuple(place.apply(first[None])[0].tolist())
            self._arrow(place, (at, turn), (length - head, x, head, y), 1.0)

    def _arrow(
        self,
        place: _Stand,
        pose: tuple[Vector, Quaternion],
        sizes: tuple[float, float, float, float],
        flat: float,
    ) -> None:
        """
        Draw an arrow along x.

        ``sizes``: length and width of the shaft, then of the head, m; ``flat``: its height to its
        width.
        """
        (at, turn), (shaft, width, head, head_width) = pose, sizes
        turned = multiply(turn, _ALONG_X)
        along = np.array(rotate(turn, (1.0, 0.0, 0.0)))
        middle, end = np.array(at) + along * shaft / 2, np.array(at) + along * shaft
        opacity = place.color[3]
        colour = place.color[:3]
        for kind, point, scale in (
            ('cylinder', middle, (flat * width, width, shaft)),
            ('cone', end, (flat * head_width, head_width, head)),
        ):
            row = np.array([[*point, *turned, *scale, *colour]])
            self._put(place.key(kind, opacity), row, int(kind == 'cone'))  # type: ignore[arg-type]

    def _add_shapes(
        self,
        kind: _Kind,
        place: _Stand,
        points: Array,
        scale: Sequence[float],
        colouring: tuple[Array, float],
    ) -> None:
        """Draw a shape at each of some points of a mark."""
        colors, opacity = colouring
        if opacity == 0.0:
            raise MarkError(_TRANSPARENT)
        self.put_shapes(place.key(kind, opacity), place, points, (scale, colors))

    def put_shapes(
        self, key: _Likeness, place: _Stand, points: Array, looks: tuple[Sequence[float], Array]
    ) -> None:
        """Draw shapes of one size and turn; ``looks``: their scale, and the colour of each."""
        scale, colors = looks
        same = np.array([*place.rotation, *scale])
        rows = np.hstack([place.apply(points), np.tile(same, (len(points), 1)), colors])
        self._put(key, rows)

    def _add_mesh(
        self, marker: MarkerData, place: _Stand, find: Callable[[MarkerData], str]
    ) -> None:
        if not marker.mesh_resource:
            raise MarkError('Empty mesh_resource path.')
        _check_scale(marker)
        *colour, opacity = place.color
        own = marker.mesh_use_embedded_materials
        if not own and opacity == 0.0:
            raise MarkError(_TRANSPARENT)
        key = place.key('mesh', 1.0 if own and opacity == 0.0 else opacity)._replace(
            resource=shorten(marker.mesh_resource), address=find(marker), is_tinted=not own
        )
        self.put_shapes(key, place, np.zeros((1, 3)), (marker.scale, np.array([colour])))

    def _add_text(self, marker: MarkerData, place: _Stand) -> None:
        if not marker.text:
            raise MarkError('Text is empty.')
        if marker.scale[2] == 0.0:
            raise MarkError('Scale contains 0.0 in z.')
        if place.color[3] == 0.0:
            raise MarkError(_TRANSPARENT)
        self._shown += 1
        self._texts.append(
            MarkText(
                shorten(marker.text),
                place.frame,
                place.stamp,
                place.position,
                abs(marker.scale[2]),
                place.color,  # type: ignore[arg-type]
            )
        )

    def _colors(self, marker: MarkerData, place: _Stand, name: str) -> tuple[Array, float]:
        """Return the colour of each point, shape (n, 3), and the opacity of all."""
        count, given = len(marker.points), np.clip(marker.colors, 0.0, 1.0)
        if len(given) == count // 3 and marker.type == _TRIANGLES and count:
            given = np.repeat(given, 3, axis=0)
        if len(given) == count:
            opacity = round(float(given[:, 3].mean()), 3)
            colors: Array = given[:, :3]
        else:
            if len(given):
                self.tell('Number of colors does not match number of points.', name)
            colors, opacity = _one(place)
            colors = np.tile(colors, (count, 1))
        if opacity == 0.0:
            raise MarkError(_TRANSPARENT)
        return colors, opacity

    def thinned(self, count: int) -> Array:
        """Return which of so many elements are drawn."""
        return np.arange(0, count, self._thin)

    def put_lines(
        self, key: _Likeness, ends: Array, colour: Sequence[float], each: int = 1
    ) -> None:
        """Draw lines of one colour, ``each`` of which are one mark; ``ends``: shape (n, 6)."""
        self._put(key, np.hstack([ends, np.tile([*colour, *colour], (len(ends), 1))]), each)

    def _put(self, key: _Likeness, rows: Array, each: int = 1) -> None:
        """Draw rows, so many of which are one shape, line or point; 0: none is."""
        if not len(rows):
            return
        floats = rows.astype('<f4')
        if not np.isfinite(floats).all():  # as numbers of a graphics card
            raise MarkError(_NOT_FINITE)
        self._batches.setdefault(key, []).append(floats)
        self._shown += len(rows) // each if each else 0

    def finish(self, origin: Origin) -> Drawn:
        """Return the sample."""
        batches = [(key, np.concatenate(rows)) for key, rows in self._batches.items()]
        if len(batches) > _MOST_BATCHES:
            self.tell(f'of {len(batches)} frames, times and looks {_MOST_BATCHES} are drawn', '')
        if len(self._texts) > _MOST_TEXTS:
            self.tell(f'of {len(self._texts)} texts {_MOST_TEXTS} are drawn', '')
        batches = batches[:_MOST_BATCHES]
        frames = [each.frame for each, _ in batches] + [each.frame for each in self._texts]
        head = Marks(
            replace(origin, frame=frames[0] if frames else ''),
            self._total,
            self._shown,
            tuple(
                MarkBatch(
                    kind=key.kind,
                    frame=key.frame,
                    stamp=key.stamp,
                    count=len(rows),
                    opacity=key.opacity,
                    size=key.size,
                    resource=key.resource,
                    address=key.address,
                    is_tinted=key.is_tinted,
                )
                for key, rows in batches
            ),
            tuple(self._texts[:_MOST_TEXTS]),
            tuple(_line(*each) for each in self._faults.items())[:_MOST_FAULTS],
        )
        return head, tuple(rows for _, rows in batches)


def _line(text: str, names: Sequence[str]) -> str:
    more = f' and {len(names) - 1} more' if len(names) > 1 else ''
    return f'{shorten(names[0])}{more}: {text}' if names[0] else text


def _one(place: _Stand) -> tuple[Array, float]:
    """Return the colour of a mark of one colour, and its opacity."""
    return np.array([place.color[:3]]), round(place.color[3], 3)


def _check_scale(marker: MarkerData) -> None:
    if 0.0 in marker.scale:
        raise MarkError(_NO_SCALE)


def _is_finite(values: Sequence[float] | Array) -> bool:
    return bool(np.isfinite(np.asarray(values, float)).all())


def _from_x(direction: Array) -> Quaternion:
    """Return what turns x to a direction, a unit vector."""
    x, y, z = (float(each) for each in direction)
    if x < -1.0 + 1e-9:  # noqa: PLR2004
        return (0.0, 0.0, 1.0, 0.0)
    return normalize((0.0, -z, y, 1.0 + x))


def poses_sample(data: bytes, origin: Origin) -> Drawn:
    """Draw flat arrows, as RViz does at first. Raises ValueError: it ends too early."""
    found = readers.POSES.read(data)
    poses = found.poses
    drawing = MarkDrawing(len(poses))
    try:
        place = _origin_of(drawing, found.header, poses)
        norms = np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
        if (norms == 0.0).any():
            drawing.tell(_NO_QUATERNION, '')
        # The direction and the left of each pose, by the columns of its matrix.
        x, y, z, w = np.where(
            norms == 0.0, [[0, 0, 0, 1]], poses[:, 3:] / np.where(norms, norms, 1)
        ).T
        ahead = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], 1)
        left = np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], 1)
        tail = poses[:, :3]
        tip = tail + _POSE_LENGTH * ahead
        back = tip - _POSE_HEAD * ahead
        ends = [(tail, tip), (back + _POSE_WIDTH * left, tip), (back - _POSE_WIDTH * left, tip)]
        chosen = drawing.thinned(len(poses))
        rows = np.concatenate([np.hstack([one[chosen], other[chosen]]) for one, other in ends])
        drawing.put_lines(place.key('lines', 1.0), rows, _POSE_COLOUR, len(ends))
    except MarkError as fault:
        drawing.tell(str(fault), '')
    return _finished(drawing, origin, found.header)


def polygon_sample(data: bytes, origin: Origin) -> Drawn:
    """Draw the outline. Raises ValueError: it ends too early."""
    found = readers.POLYGON.read(data)
    points = found.points.astype(float)
    drawing = MarkDrawing(len(points))
    try:
        place = _origin_of(drawing, found.header, points)
        ends = np.hstack([points, np.roll(points, -1, axis=0)])
        chosen = ends[drawing.thinned(len(ends))]
        drawing.put_lines(place.key('lines', 1.0), chosen, _POLYGON_COLOUR)
    except MarkError as fault:
        drawing.tell(str(fault), '')
    return _finished(drawing, origin, found.header)


def point_sample(data: bytes, origin: Origin) -> Drawn:
    """Draw a ball. Raises ValueError: it ends too early."""
    found = readers.POINT.read(data)
    drawing = MarkDrawing(1)
    try:
        place = _origin_of(drawing, found.header, found.points)
        looks = (_POINT_DIAMETER,) * 3, np.array([_POINT_COLOUR])
        drawing.put_shapes(place.key('sphere', 1.0), place, found.points, looks)
    except MarkError as fault:
        drawing.tell(str(fault), '')
    return _finished(drawing, origin, found.header)


def _origin_of(drawing: MarkDrawing, header: Header, values: Array) -> _Stand:
    if not np.isfinite(values).all():
        raise MarkError(_NOT_FINITE)
    return drawing.place(header, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), '', color=(1.0,) * 4)


def _finished(drawing: MarkDrawing, origin: Origin, header: Header) -> Drawn:
    return drawing.finish(replace(origin, stamp=header.stamp / NANOSECONDS))
