# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf_transformations``: rotations and homogeneous matrices, as far as nodes of robots use it.

Quaternions are x y z w, angles rad, matrices 4 x 4. ``axes`` names a convention of Euler angles by
four letters: about static axes (``s``) or those that turn along (``r``), and which three, in their
order; ``sxyz`` are roll, pitch and yaw. (Shoemake, Graphics Gems IV, III.5.)
"""

from collections.abc import Sequence
import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
Numbers: TypeAlias = Sequence[float] | Array

_EPSILON = 4.0 * float(np.finfo(float).eps)
_PARALLEL = 0.9995
"""Cosine between quaternions from which on their angle is too small to divide by its sine."""


def _convention(axes: str) -> tuple[bool, tuple[int, int, int]]:
    """Return whether axes turn along, and which they are. Raises ValueError."""
    if (
        len(axes) != 4
        or axes[0] not in 'sr'
        or not set(axes[1:]) <= set('xyz')
        or axes[1] == axes[2]
        or axes[2] == axes[3]
    ):
        raise ValueError(f"axes is {axes!r}; four letters are needed, such as 'sxyz' or 'rzyx'")
    first, second, third = ('xyz'.index(each) for each in axes[1:])
    return axes[0] == 'r', (first, second, third)


def _about(axis: int, angle: float) -> Array:
    """Return the quaternion of a rotation about a coordinate axis."""
    result = np.zeros(4)
    result[axis], result[3] = math.sin(0.5 * angle), math.cos(0.5 * angle)
    return result


def identity_matrix() -> Array:
    """Return the transform that changes nothing."""
    return np.identity(4)


def translation_matrix(direction: Numbers) -> Array:
    """Return a translation, m."""
    matrix = np.identity(4)
    matrix[:3, 3] = direction[:3]
    return matrix


def translation_from_matrix(matrix: Array) -> Array:
    """Return the translation of a transform, m."""
    return np.array(matrix, copy=True)[:3, 3].astype(float)


def concatenate_matrices(*matrices: Array) -> Array:
    """Return the product of transforms: the last one comes first."""
    result = np.identity(4)
    for matrix in matrices:
        result = result @ matrix
    return result


def inverse_matrix(matrix: Array) -> Array:
    """Return the inverse of a square matrix."""
    return np.linalg.inv(matrix)


def vector_norm(data: Numbers, axis: int | None = None) -> Any:
    """Return the length of a vector, or of those along an axis."""
    return np.linalg.norm(np.asarray(data, dtype=float), axis=axis)


def unit_vector(data: Numbers) -> Array:
    """Return a vector of length 1 in the same direction."""
    vector = np.array(data, dtype=float)
    return vector / np.linalg.norm(vector)


def rotation_matrix(angle: float, direction: Numbers) -> Array:
    """Return a rotation about an axis through the origin."""
    return quaternion_matrix(quaternion_about_axis(angle, direction))


def quaternion_about_axis(angle: float, axis: Numbers) -> Array:
    """Return the quaternion of a rotation about an axis."""
    result = np.empty(4)
    result[:3] = unit_vector(axis[:3]) * math.sin(0.5 * angle)
    result[3] = math.cos(0.5 * angle)
    return result


def quaternion_matrix(quaternion: Numbers) -> Array:
    """Return the rotation of a quaternion, which need not have length 1."""
    q = np.array(quaternion, dtype=float)
    matrix = np.identity(4)
    squared = float(q @ q)
    if squared < _EPSILON:
        return matrix
    x, y, z, w = q * math.sqrt(2.0 / squared)
    matrix[:3, :3] = [
        [1.0 - y * y - z * z, x * y - z * w, x * z + y * w],
        [x * y + z * w, 1.0 - x * x - z * z, y * z - x * w],
        [x * z - y * w, y * z + x * w, 1.0 - x * x - y * y],
    ]
    return matrix


def quaternion_from_matrix(matrix: Array) -> Array:
    """Return the quaternion of the rotation of a transform, its w not below 0."""
    m = np.array(matrix, dtype=float)[:3, :3]
    # The largest of the four squares is divided by, so that no digits are lost.
    squares = np.array(
        [
            1.0 + m[0, 0] - m[1, 1] - m[2, 2],
            1.0 - m[0, 0] + m[1, 1] - m[2, 2],
            1.0 - m[0, 0] - m[1, 1] + m[2, 2],
            1.0 + m[0, 0] + m[1, 1] + m[2, 2],
        ]
    )
    products = np.array(
        [
            [squares[0], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[0, 1] + m[1, 0], squares[1], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], squares[2], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]],
        ]
    )
    row = products[int(squares.argmax())]
    result: Array = row / np.linalg.norm(row)
    return -result if result[3] < 0.0 else result


def quaternion_multiply(quaternion1: Numbers, quaternion0: Numbers) -> Array:
    """Return the rotation ``quaternion0``, and then ``quaternion1``."""
    x0, y0, z0, w0 = quaternion0
    x1, y1, z1, w1 = quaternion1
    return np.array(
        [
            x1 * w0 + y1 * z0 - z1 * y0 + w1 * x0,
            -x1 * z0 + y1 * w0 + z1 * x0 + w1 * y0,
            x1 * y0 - y1 * x0 + z1 * w0 + w1 * z0,
            -x1 * x0 - y1 * y0 - z1 * z0 + w1 * w0,
        ],
        dtype=float,
    )


def quaternion_conjugate(quaternion: Numbers) -> Array:
    """Return the quaternion with x, y and z turned round."""
    return np.array(quaternion, dtype=float) * (-1.0, -1.0, -1.0, 1.0)


def quaternion_inverse(quaternion: Numbers) -> Array:
    """Return the rotation back."""
    conjugate = quaternion_conjugate(quaternion)
    return conjugate / float(conjugate @ conjugate)


def quaternion_slerp(
    quat0: Numbers, quat1: Numbers, fraction: float, spin: int = 0, shortestpath: bool = True
) -> Array:
    """Return a rotation between two, at a share of the way from the first to the second."""
    begin, end = unit_vector(quat0), unit_vector(quat1)
    cosine = float(begin @ end)
    if shortestpath and cosine < 0.0:
        end, cosine = -end, -cosine
    angle = math.acos(min(1.0, max(-1.0, cosine))) + spin * math.pi
    if abs(cosine) > _PARALLEL and not spin:
        return unit_vector(begin + fraction * (end - begin))
    sine = math.sin(angle)
    return (math.sin((1.0 - fraction) * angle) * begin + math.sin(fraction * angle) * end) / sine


def random_quaternion(rand: Numbers | None = None) -> Array:
    """Return a rotation drawn evenly; ``rand``: three numbers from 0 to 1, else drawn here."""
    a, b, c = np.random.default_rng().random(3) if rand is None else rand
    near, far = math.sqrt(1.0 - a), math.sqrt(a)
    return np.array(
        [
            near * math.sin(math.tau * b),
            near * math.cos(math.tau * b),
            far * math.sin(math.tau * c),
            far * math.cos(math.tau * c),
        ]
    )


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = 'sxyz') -> Array:
    """Return the quaternion of Euler angles."""
    turns_along, order = _convention(axes)
    first, second, third = (
        _about(axis, angle) for axis, angle in zip(order, (ai, aj, ak), strict=True)
    )
    if turns_along:
        first, third = third, first
    return quaternion_multiply(third, quaternion_multiply(second, first))


def euler_matrix(ai: float, aj: float, ak: float, axes: str = 'sxyz') -> Array:
    """Return the rotation of Euler angles."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_quaternion(quaternion: Numbers, axes: str = 'sxyz') -> tuple[float, float, float]:
    """Return the Euler angles of a quaternion."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def euler_from_matrix(matrix: Array, axes: str = 'sxyz') -> tuple[float, float, float]:
    """Return the Euler angles of a rotation; where they are not unique, the last one is 0."""
    turns_along, order = _convention(axes)
    i, j, k = order[::-1] if turns_along else order
    m = np.array(matrix, dtype=float)[:3, :3]
    repeats = i == k
    if repeats:
        k = 3 - i - j
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    if repeats:
        reach = math.hypot(m[i, j], m[i, k])
        middle = math.atan2(reach, m[i, i])
        if reach > _EPSILON:
            first = math.atan2(m[i, j], sign * m[i, k])
            last = math.atan2(m[j, i], -sign * m[k, i])
        else:
            first, last = math.atan2(-sign * m[j, k], m[j, j]), 0.0
    else:
        reach = math.hypot(m[i, i], m[j, i])
        middle = math.atan2(-sign * m[k, i], reach)
        if reach > _EPSILON:
            first = math.atan2(sign * m[k, j], m[k, k])
            last = math.atan2(sign * m[j, i], m[i, i])
        else:
            first, last = math.atan2(-sign * m[j, k], m[j, j]), 0.0
    return (last, middle, first) if turns_along else (first, middle, last)


def is_same_transform(matrix0: Array, matrix1: Array) -> bool:
    """Return whether two transforms are the same, but for rounding."""
    return bool(np.allclose(matrix0, matrix1))
