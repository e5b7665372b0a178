# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Latitude and longitude ↔ metres; where a fix of a satellite receiver is in the world of a robot.

The ellipsoid is that of WGS 84. Metres are those of a grid: x east, y north, z up. UTM by the
series of Krüger to the fourth order, which is right to less than a micrometre in a zone: C. F. F.
Karney, Transverse Mercator with an accuracy of a few nanometers, Journal of Geodesy 85 (2011).
The rules are those of ``navsat_transform_node`` of robot_localization 3.8 (Jazzy).
"""

import cmath
from dataclasses import dataclass
import math
from typing import Protocol

from amr_description.errors import ParameterError
from amr_description.model.frames import (
    Quaternion,
    quaternion_from_rpy,
    quaternion_from_yaw,
    rotate,
    rpy_from_quaternion,
    Transform,
    Vector,
    yaw_of,
)

_RADIUS = 6378137.0  # m, at the equator
_FLATTENING = 1 / 298.257223563
_SQUARED = _FLATTENING * (2.0 - _FLATTENING)
_ECCENTRICITY = math.sqrt(_SQUARED)
_SCALE = 0.9996
_EAST, _SOUTH = 500_000.0, 10_000_000.0  # m, false
_N = _FLATTENING / (2.0 - _FLATTENING)
_RECTIFYING = _RADIUS / (1.0 + _N) * (1.0 + _N**2 / 4 + _N**4 / 64)
_FORWARD = (
    _N / 2 - 2 * _N**2 / 3 + 5 * _N**3 / 16 + 41 * _N**4 / 180,
    13 * _N**2 / 48 - 3 * _N**3 / 5 + 557 * _N**4 / 1440,
    61 * _N**3 / 240 - 103 * _N**4 / 140,
    49561 * _N**4 / 161280,
)
_BACK = (
    _N / 2 - 2 * _N**2 / 3 + 37 * _N**3 / 96 - _N**4 / 360,
    _N**2 / 48 + _N**3 / 15 - 437 * _N**4 / 1440,
    17 * _N**3 / 480 - 37 * _N**4 / 840,
    4397 * _N**4 / 161280,
)
_NORTHMOST, _SOUTHMOST = 84.0, -80.0
_STEPS = 8
"""Of Newton's method, most; four are enough."""


@dataclass(frozen=True, slots=True)
class GeoPoint:
    """Degrees, north and east are positive; m above the ellipsoid."""

    latitude: float
    longitude: float
    altitude: float = 0.0


class Grid(Protocol):
    """Metres around somewhere."""

    def forward(self, point: GeoPoint) -> Vector:
        """Return east, north and up, m."""
        ...

    def back(self, place: Vector) -> GeoPoint:
        """Return the point of a place."""
        ...

    def convergence(self, point: GeoPoint) -> float:
        """Return the bearing of the grid's north there, rad, clockwise from true north."""
        ...


@dataclass(frozen=True, slots=True)
class Utm:
    """A zone of UTM; points beside it are in its metres, too."""

    zone: int
    is_north: bool

    @classmethod
    def of(cls, point: GeoPoint) -> 'Utm':
        """Return the zone that a point is in. Raises ParameterError: it is near a pole."""
        latitude = point.latitude
        if not _SOUTHMOST <= latitude < _NORTHMOST:
            raise ParameterError(
                f'latitude {latitude:g} has no zone of UTM, which goes from -80 to 84 degrees: '
                'set use_local_cartesian: true'
            )
        longitude = (point.longitude + 180.0) % 360.0 - 180.0
        zone = int((longitude + 180.0) // 6.0) + 1
        if 56.0 <= latitude < 64.0 and 3.0 <= longitude < 6.0:
            zone = 32  # south of Norway
        elif latitude >= 72.0 and 0.0 <= longitude < 42.0:
            zone = 2 * int((longitude + 183.0) // 12.0) + 1  # Svalbard
        return cls(zone, latitude >= 0.0)

    def forward(self, point: GeoPoint) -> Vector:
        along, _ = self._series(point)
        return (
            _EAST + _SCALE * _RECTIFYING * along.imag,
            (0.0 if self.is_north else _SOUTH) + _SCALE * _RECTIFYING * along.real,
            point.altitude,
        )

    def back(self, place: Vector) -> GeoPoint:
        north = place[1] - (0.0 if self.is_north else _SOUTH)
        along = complex(north, place[0] - _EAST) / (_SCALE * _RECTIFYING)
        sphere = along - sum(
            factor * cmath.sin(2 * j * along) for j, factor in enumerate(_BACK, start=1)
        )
        longitude = math.atan2(math.sinh(sphere.imag), math.cos(sphere.real))
        conformal = math.sin(sphere.real) / math.hypot(
            math.sinh(sphere.imag), math.cos(sphere.real)
        )
        return GeoPoint(
            math.degrees(math.atan(_tangent_of_conformal(conformal))),
            math.remainder(math.degrees(longitude) + self._meridian, 360.0),
            place[2],
        )

    def convergence(self, point: GeoPoint) -> float:
        along, stretch = self._series(point)
        conformal = _conformal(math.tan(math.radians(point.latitude)))
        turn = math.tan(math.radians(self._east_of_meridian(point)))
        on_sphere = math.atan(conformal / math.hypot(1.0, conformal) * turn)
        return on_sphere - cmath.phase(stretch)

    @property
    def _meridian(self) -> float:
        """Degrees."""
        return 6.0 * self.zone - 183.0

    def _east_of_meridian(self, point: GeoPoint) -> float:
        return (point.longitude - self._meridian + 180.0) % 360.0 - 180.0

    def _series(self, point: GeoPoint) -> tuple[complex, complex]:
        """Return north + i · east over the rectifying radius, and its derivative."""
        conformal = _conformal(math.tan(math.radians(point.latitude)))
        east = math.radians(self._east_of_meridian(point))
        sphere = complex(
            math.atan2(conformal, math.cos(east)),
            math.asinh(math.sin(east) / math.hypot(conformal, math.cos(east))),
        )
        terms = [(2 * j, factor) for j, factor in enumerate(_FORWARD, start=1)]
        along = sphere + sum(factor * cmath.sin(j * sphere) for j, factor in terms)
        return along, 1.0 + sum(j * factor * cmath.cos(j * sphere) for j, factor in terms)


def _conformal(tangent: float) -> float:
    """Return the tangent of the conformal latitude for that of the latitude."""
    secant = math.hypot(1.0, tangent)
    sigma = math.sinh(_ECCENTRICITY * math.atanh(_ECCENTRICITY * tangent / secant))
    return tangent * math.hypot(1.0, sigma) - sigma * secant


def _tangent_of_conformal(conformal: float) -> float:
    """Return the tangent of the latitude for that of the conformal latitude, by Newton."""
    tangent = conformal / (1.0 - _SQUARED)
    for _ in range(_STEPS):
        found = _conformal(tangent)
        step = (conformal - found) / math.hypot(1.0, found)
        step *= (1.0 + (1.0 - _SQUARED) * tangent**2) / (1.0 - _SQUARED)
        step /= math.hypot(1.0, tangent)
        tangent += step
        if abs(step) <= 1e-15 * max(1.0, abs(tangent)):
            break
    return tangent


@dataclass(frozen=True, slots=True)
class LocalCartesian:
    """The plane that touches the ellipsoid at a point, x east and y north there."""

    origin: GeoPoint

    def forward(self, point: GeoPoint) -> Vector:
        here, there = _from_the_centre(self.origin), _from_the_centre(point)
        x, y, z = (b - a for a, b in zip(here, there, strict=True))
        axes = self._axes
        return (_dot(axes[0], x, y, z), _dot(axes[1], x, y, z), _dot(axes[2], x, y, z))

    def back(self, place: Vector) -> GeoPoint:
        x, y, z = (
            start + sum(each * axis[i] for each, axis in zip(place, self._axes, strict=True))
            for i, start in enumerate(_from_the_centre(self.origin))
        )
        from_axis = math.hypot(x, y)
        latitude = math.atan2(z, from_axis * (1.0 - _SQUARED))
        for _ in range(_STEPS):  # each is 150 times as near
            normal = _normal(latitude)
            latitude = math.atan2(z + _SQUARED * normal * math.sin(latitude), from_axis)
        normal = _normal(latitude)
        altitude = (
            from_axis * math.cos(latitude)
            + z * math.sin(latitude)
            - normal * (1.0 - _SQUARED * math.sin(latitude) ** 2)
        )
        return GeoPoint(math.degrees(latitude), math.degrees(math.atan2(y, x)), altitude)

    def convergence(self, point: GeoPoint) -> float:  # noqa: ARG002
        return 0.0

    @property
    def _axes(self) -> tuple[Vector, Vector, Vector]:
        """East, north and up, from the centre of the earth."""
        latitude, longitude = map(math.radians, (self.origin.latitude, self.origin.longitude))
        up = (
            math.cos(latitude) * math.cos(longitude),
            math.cos(latitude) * math.sin(longitude),
            math.sin(latitude),
        )
        north = (
            -math.sin(latitude) * math.cos(longitude),
            -math.sin(latitude) * math.sin(longitude),
            math.cos(latitude),
        )
        return (-math.sin(longitude), math.cos(longitude), 0.0), north, up


def _dot(axis: Vector, x: float, y: float, z: float) -> float:
    return axis[0] * x + axis[1] * y + axis[2] * z


def _normal(latitude: float) -> float:
    """Return the radius of curvature across the meridian, m."""
    return _RADIUS / math.sqrt(1.0 - _SQUARED * math.sin(latitude) ** 2)


def _from_the_centre(point: GeoPoint) -> Vector:
    latitude, longitude = math.radians(point.latitude), math.radians(point.longitude)
    normal = _normal(latitude)
    from_axis = (normal + point.altitude) * math.cos(latitude)
    return (
        from_axis * math.cos(longitude),
        from_axis * math.sin(longitude),
        (normal * (1.0 - _SQUARED) + point.altitude) * math.sin(latitude),
    )


@dataclass(frozen=True, slots=True)
class Datum:
    """An instant at which the robot is known both by its odometry and on the earth."""

    point: GeoPoint
    attitude: Quaternion
    """Of the robot; its yaw is 0 in the east, where an IMU has no other error."""
    world_pose: Transform = Transform()
    """Of the robot, by its odometry."""
    receiver: Vector = (0.0, 0.0, 0.0)
    """Of the point, in the robot, m."""


def heading_of(datum: Datum, grid: Grid, offset: float) -> float:
    """Return the yaw of the robot in a grid, rad; ``offset``: declination and others."""
    return rpy_from_quaternion(datum.attitude)[2] + offset + grid.convergence(datum.point)


def world_from_grid(datum: Datum, grid: Grid, heading: float) -> Transform:
    """
    Return where a grid is in the world of the odometry.

    Both are level: ``world_pose``, seen from above, times the inverse of the pose in the grid.
    """
    roll, pitch, _ = rpy_from_quaternion(datum.attitude)
    lever = rotate(quaternion_from_rpy(roll, pitch, heading), datum.receiver)
    x, y, z = (a - b for a, b in zip(grid.forward(datum.point), lever, strict=True))
    level = Transform(
        datum.world_pose.translation, quaternion_from_yaw(yaw_of(datum.world_pose.rotation))
    )
    return level @ Transform((x, y, z), quaternion_from_yaw(heading)).inverse()


def without_mounting(attitude: Quaternion, mounting: Quaternion) -> Quaternion:
    """Return the attitude of a robot by that of an IMU, whose own is ``mounting`` in the robot."""
    before, after = rpy_from_quaternion(attitude), rpy_from_quaternion(mounting)
    roll, pitch, yaw = (math.remainder(before[i] - after[i], 2.0 * math.pi) for i in range(3))
    # Of an IMU that looks aside, what it pitches by is what the robot rolls by.
    turn = quaternion_from_yaw(after[2])
    return quaternion_from_rpy(*rotate(turn, (roll, pitch, yaw)))
