# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The surfaces of simple shapes as a camera sees them from outside, and where its rays meet them.

A box shows at most three of its sides, a cylinder its side and one end. Each surface returns the
depth of every ray of an area that meets it, NaN or less than 0 of the others; formulas of analytic
geometry, with the ray ``origin + depth · direction`` in the axes of the shape.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.sim.cameras.screen import Area, Screen

_Type = mujoco.mjtGeom
SIMPLE = frozenset(
    int(each)
    for each in (
        _Type.mjGEOM_PLANE, _Type.mjGEOM_SPHERE, _Type.mjGEOM_CAPSULE, _Type.mjGEOM_ELLIPSOID,
        _Type.mjGEOM_CYLINDER, _Type.mjGEOM_BOX,
    )
)  # fmt: skip
"""The types of geoms that have surfaces here."""


@dataclass(frozen=True, slots=True)
class Sight:
    """
    How a camera sees the axes of a shape.

    Attributes:
        origin: (3,): the camera, in these axes, m.
        turn: (3, 3): from the sensor's axes to these.
    """

    origin: np.ndarray
    turn: np.ndarray


class Surface(ABC):
    """One surface of a shape."""

    @abstractmethod
    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""

    @abstractmethod
    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points (n, 3) of it, outward, of any length: (n, 3) or (3,)."""

    def corners(self) -> np.ndarray | None:
        """Return corners (n, 3) between which it lies; None: those of the whole shape."""
        return None


@dataclass(frozen=True, slots=True)
class Flat(Surface):
    """
    A rectangle or a disc across an axis of the shape, or all of a plane.

    ``size``: half the sides along the two other axes, in their order, or inf; of a disc twice its
    radius.
    """

    axis: int
    place: float
    sign: float
    size: tuple[float, float]
    is_disc: bool = False

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        away = self.place - float(sight.origin[self.axis])
        depth = away / screen.linear(sight.turn[self.axis], area)
        outside = np.zeros(depth.shape, bool)
        radius2 = np.zeros(1)
        for axis, size in zip(_OTHERS[self.axis], self.size, strict=True):
            if np.isinf(size):
                continue
            along = screen.linear(sight.turn[axis], area)
            along *= depth
            along += float(sight.origin[axis])
            if self.is_disc:
                radius2 = radius2 + along * along
            else:
                outside |= np.abs(along, out=along) > size
        if self.is_disc:
            outside = radius2 > self.size[0] ** 2
        depth[outside] = -1.0
        return np.asarray(depth)

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normal, (3,)."""
        del points
        normal = np.zeros(3)
        normal[self.axis] = self.sign
        return normal

    def corners(self) -> np.ndarray | None:
        """Return its corners; None: it has none."""
        if np.isinf(self.size).any():
            return None
        corners = np.empty((4, 3))
        corners[:, self.axis] = self.place
        first, second = _OTHERS[self.axis]
        corners[:, first] = np.multiply((-1, -1, 1, 1), self.size[0])
        corners[:, second] = np.multiply((-1, 1, -1, 1), self.size[1])
        return corners


@dataclass(frozen=True, slots=True)
class Round(Surface):
    """
    An ellipsoid, or the part of one from a height on: x²/a² + y²/b² + (z - middle)²/c² = 1.

    ``end``: its sign says on which side of ``middle`` it is; 0: it is whole.
    """

    size: tuple[float, float, float]
    middle: float = 0.0
    end: float = 0.0

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        place = (sight.origin - (0.0, 0.0, self.middle)) / self.size
        c = float(place @ place) - 1.0
        rows = sight.turn / np.array(self.size)[:, np.newaxis]
        x, y, z = (screen.linear(row, area) for row in rows)
        depth = _nearer_root(x * x + y * y + z * z, screen.linear(place @ rows, area), c)
        if self.end:
            height = screen.linear(sight.turn[2], area) * depth + sight.origin[2]
            depth[(height - self.middle) * self.end < 0.0] = -1.0
        return depth

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points, (n, 3)."""
        return np.asarray((points - (0.0, 0.0, self.middle)) / np.square(self.size))


@dataclass(frozen=True, slots=True)
class Tube(Surface):
    """The side of a cylinder along z."""

    radius: float
    half_length: float

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        place, rows = sight.origin[:2], sight.turn[:2]
        c = float(place @ place) - self.radius**2
        x, y = (screen.linear(row, area) for row in rows)
        depth = _nearer_root(x * x + y * y, screen.linear(place @ rows, area), c)
        height = screen.linear(sight.turn[2], area) * depth + sight.origin[2]
        depth[np.abs(height) > self.half_length] = -1.0
        return depth

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points, (n, 3)."""
        return np.asarray(points * (1.0, 1.0, 0.0))


def visible_surfaces(kind: int, size: np.ndarray, origin: np.ndarray) -> Iterator[Surface]:
    """
    Yield the surfaces of a shape that are seen from a point, from outside only.

    Args:
        kind: A type of geoms, one of :data:`SIMPLE`.
        size: (3,), as of ``mjModel.geom_size``.
        origin: (3,), in the shape's axes.
    """
    a, b, c = size.tolist()
    x, y, z = origin.tolist()
    match _Type(kind):
        case _Type.mjGEOM_PLANE if z > 0.0:
            yield Flat(2, 0.0, 1.0, (a or np.inf, b or np.inf))
        case _Type.mjGEOM_BOX:
            for axis, (place, half) in enumerate(zip((x, y, z), (a, b, c), strict=True)):
                if abs(place) > half:
                    sign = 1.0 if place > 0.0 else -1.0
                    first, second = _OTHERS[axis]
                    yield Flat(axis, sign * half, sign, (float(size[first]), float(size[second])))
        case _Type.mjGEOM_SPHERE if x * x + y * y + z * z > a * a:
            yield Round((a, a, a))
        case _Type.mjGEOM_ELLIPSOID if (x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 > 1.0:
            yield Round((a, b, c))
        case _Type.mjGEOM_CYLINDER:
            if x * x + y * y > a * a:
                yield Tube(a, b)
            if abs(z) > b:
                sign = 1.0 if z > 0.0 else -1.0
                yield Flat(2, sign * b, sign, (a, a), is_disc=True)
        case _Type.mjGEOM_CAPSULE:
            if x * x + y * y > a * a:
                yield Tube(a, b)
            for sign in (-1.0, 1.0):
                if x * x + y * y + (z - sign * b) ** 2 > a * a:
                    yield Round((a, a, a), sign * b, sign)
        case _:
            return


_OTHERS = ((1, 2), (0, 2), (0, 1))


def _nearer_root(a: np.ndarray, b: np.ndarray, c: float) -> np.ndarray:
    """Return the smaller solution t of a t² + 2 b t + c = 0; NaN: there is none."""
    root = b * b
    root -= a * c
    np.sqrt(root, out=root)
    root += b
    # c / (-b + root) would be more exact far away, but costs as much again.
    np.divide(root, a, out=root)
    return np.negative(root, out=root)
