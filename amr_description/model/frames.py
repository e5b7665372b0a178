# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rigid transforms (SE(3)), quaternions, and the conversions between their conventions.

Quaternions are ``(x, y, z, w)`` as in every ROS message; MuJoCo's ``(w, x, y, z)`` exists only in
:func:`wxyz_from_xyzw` and :func:`xyzw_from_wxyz`. Lengths are metres, angles radians, frames
right-handed.

A transform is named after what it does to coordinates: ``transform_child_to_parent.apply(p)``
takes a point given in ``child`` and returns it in ``parent``. It is the pose of ``child`` in
``parent``, what TF sends with ``header.frame_id = parent`` and ``child_frame_id = child``.
Transforms compose as their names suggest::

    transform_c_to_a = transform_b_to_a @ transform_c_to_b

Plain floats are several times faster than numpy at these sizes, and the control loop calls this.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import TypeAlias

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
Matrix3: TypeAlias = tuple[Vector, Vector, Vector]

IDENTITY_QUATERNION: Quaternion = (0.0, 0.0, 0.0, 1.0)

# Below this cosine of the pitch, roll and yaw are about one axis and only their sum is known.
_GIMBAL_LOCK_COSINE = 1e-9
# rad: below it two rotations are equal; slerp would divide by 0.
_NO_ANGLE = 1e-15


def wxyz_from_xyzw(rotation: Quaternion) -> Quaternion:
    """Reorder a quaternion from ROS to MuJoCo."""
    x, y, z, w = rotation
    return (w, x, y, z)


def xyzw_from_wxyz(rotation: Sequence[float]) -> Quaternion:
    """Reorder a quaternion from MuJoCo to ROS."""
    w, x, y, z = rotation
    return (float(x), float(y), float(z), float(w))


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the Hamilton product: rotate by ``b`` first, then by ``a``."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(rotation: Quaternion) -> Quaternion:
    """Return the inverse rotation of a unit quaternion."""
    x, y, z, w = rotation
    return (-x, -y, -z, w)


def rotate(rotation: Quaternion, vector: Vector) -> Vector:
    """Rotate ``vector`` by a unit quaternion: v + 2w(u × v) + 2u × (u × v), with u = (x, y, z)."""
    x, y, z, w = rotation
    vx, vy, vz = vector
    tx = 2.0 * (y * vz - z * vy)
    ty = 2.0 * (z * vx - x * vz)
    tz = 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return the cross product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return R = Rz(yaw)·Ry(pitch)·Rx(roll): rotations about the fixed axes x, y, z in turn."""
    sr, cr = math.sin(roll / 2.0), math.cos(roll / 2.0)
    sp, cp = math.sin(pitch / 2.0), math.cos(pitch / 2.0)
    sy, cy = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy_from_quaternion(rotation: Quaternion) -> Vector:
    """
    Return (roll, pitch, yaw) of a unit quaternion, pitch within ±π/2.

    At a pitch of ±π/2 only the sum of roll and yaw is defined; the roll is then 0.
    """
    (r00, r01, _), (r10, r11, _), (r20, r21, r22) = matrix_from_quaternion(rotation)
    pitch_cosine = math.hypot(r21, r22)
    pitch = math.atan2(-r20, pitch_cosine)
    if pitch_cosine < _GIMBAL_LOCK_COSINE:
        return (0.0, pitch, math.atan2(-r01, r11))
    return (math.atan2(r21, r22), pitch, math.atan2(r10, r00))


def quaternion_from_yaw(yaw: float) -> Quaternion:
    """Return the rotation by ``yaw`` about z."""
    return (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0))


def yaw_of(rotation: Quaternion) -> float:
    """Return the yaw of R = Rz(yaw)·Ry(pitch)·Rx(roll), in (-π, π], for any quaternion length."""
    x, y, z, w = rotation
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def quaternion_from_axis_angle(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation by ``angle`` about ``axis`` of any length; none for a zero axis."""
    length = math.hypot(*axis)
    if length == 0.0:
        return IDENTITY_QUATERNION
    scale = math.sin(angle / 2.0) / length
    return (axis[0] * scale, axis[1] * scale, axis[2] * scale, math.cos(angle / 2.0))


def matrix_from_quaternion(rotation: Quaternion) -> Matrix3:
    """Return the rows of the rotation matrix of a unit quaternion."""
    x, y, z, w = rotation
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )


def normalize(rotation: Quaternion) -> Quaternion:
    """Return a quaternion scaled to length 1. Raises ZeroDivisionError for all zeros."""
    x, y, z, w = rotation
    length = math.hypot(x, y, z, w)
    return (x / length, y / length, z / length, w / length)


def slerp(start: Quaternion, end: Quaternion, ratio: float) -> Quaternion:
    """
    Return the rotation at ``ratio`` (0 … 1) of the shorter arc, for a constant angular speed.

    K. Shoemake, Animating rotation with quaternion curves, 1985. The angle is computed from the
    sum and the difference of the two, which unlike the arc cosine is exact near 0.
    """
    cosine = sum(a * b for a, b in zip(start, end, strict=True))
    sign = math.copysign(1.0, cosine)  # end and -end are the same rotation: take the closer one
    apart = math.hypot(*(sign * b - a for a, b in zip(start, end, strict=True)))
    together = math.hypot(*(sign * b + a for a, b in zip(start, end, strict=True)))
    angle = 2.0 * math.atan2(apart, together)
    if angle < _NO_ANGLE:
        return start
    of_start = math.sin((1.0 - ratio) * angle) / math.sin(angle)
    of_end = sign * math.sin(ratio * angle) / math.sin(angle)
    x, y, z, w = (of_start * a + of_end * b for a, b in zip(start, end, strict=True))
    return normalize((x, y, z, w))


def quaternion_from_matrix(matrix: Sequence[Sequence[float]]) -> Quaternion:
    """
    Return the unit quaternion, w ≥ 0, of a rotation matrix (the upper left 3×3 of ``matrix``).

    Shepperd's method divides by the largest of the four components, which keeps all digits.
    """
    m = [[float(matrix[row][column]) for column in range(3)] for row in range(3)]
    trace = m[0][0] + m[1][1] + m[2][2]
    largest = max(range(3), key=lambda axis: m[axis][axis])
    if trace >= m[largest][largest]:
        parts = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1.0 + trace]
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        parts = [0.0, 0.0, 0.0, m[k][j] - m[j][k]]
        parts[i] = 1.0 + m[i][i] - m[j][j] - m[k][k]
        parts[j] = m[i][j] + m[j][i]
        parts[k] = m[i][k] + m[k][i]
    length = math.copysign(math.hypot(*parts), parts[3])
    x, y, z, w = (part / length for part in parts)
    return (x, y, z, w)


@dataclass(frozen=True, slots=True)
class Transform:
    """A rigid transform: ``apply(p) = rotation · p + translation``; names as in the module."""

    translation: Vector = (0.0, 0.0, 0.0)
    rotation: Quaternion = IDENTITY_QUATERNION

    @classmethod
    def from_xyz_rpy(cls, xyz: Vector, rpy: Vector) -> 'Transform':
        """Return the transform of ``<origin xyz="…" rpy="…"/>`` in URDF (m, rad)."""
        return cls(xyz, quaternion_from_rpy(*rpy))

    @classmethod
    def from_axis_angle(cls, axis: Vector, angle: float) -> 'Transform':
        """Return the rotation by ``angle`` about ``axis`` through the origin."""
        return cls(rotation=quaternion_from_axis_angle(axis, angle))

    @classmethod
    def from_matrix(cls, matrix: Sequence[Sequence[float]]) -> 'Transform':
        """Return the transform of a homogeneous 4×4 matrix (nested sequences or numpy)."""
        x, y, z = (float(matrix[row][3]) for row in range(3))
        return cls((x, y, z), quaternion_from_matrix(matrix))

    def to_matrix(self) -> tuple[tuple[float, float, float, float], ...]:
        """Return the rows of the homogeneous 4×4 matrix."""
        rows = zip(matrix_from_quaternion(self.rotation), self.translation, strict=True)
        return (*((a, b, c, offset) for (a, b, c), offset in rows), (0.0, 0.0, 0.0, 1.0))

    def compose(self, other: 'Transform') -> 'Transform':
        """Return the transform that applies ``other`` first; also written ``self @ other``."""
        return Transform(self.apply(other.translation), multiply(self.rotation, other.rotation))

    __matmul__ = compose

    def inverse(self) -> 'Transform':
        """Return the inverse transform."""
        back = conjugate(self.rotation)
        x, y, z = rotate(back, self.translation)
        return Transform((-x, -y, -z), back)

    def interpolate(self, other: 'Transform', ratio: float) -> 'Transform':
        """Return the transform at ``ratio`` (0 … 1): linear translation, slerp of rotation."""
        (ax, ay, az), (bx, by, bz) = self.translation, other.translation
        keep = 1.0 - ratio
        translation = (keep * ax + ratio * bx, keep * ay + ratio * by, keep * az + ratio * bz)
        return Transform(translation, slerp(self.rotation, other.rotation, ratio))

    def apply(self, point: Vector) -> Vector:
        """Return ``point`` in the target frame; a direction needs :func:`rotate` instead."""
        x, y, z = rotate(self.rotation, point)
        tx, ty, tz = self.translation
        return (x + tx, y + ty, z + tz)
