# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The geometry of a camera: where a point is in the picture, and where a pixel looks.

Points are in the optical frame: x to the right, y down, z forward (REP 103). Normalized
coordinates are x/z and y/z. Pixels are numbered as in ROS and OpenCV: u to the right, v down,
(0, 0) is the centre of the first one.

The lens distorts by Brown's model, with the coefficients and the order of OpenCV and of
``sensor_msgs/msg/CameraInfo`` (https://docs.opencv.org/4.x/d9/d0c/group__calib3d.html)::

    x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)
    y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y
"""

import math

import numpy as np

from amr_description.model.sensors import Camera, Distortion, Intrinsics

_ITERATIONS = 20
_TOLERANCE = 1e-10
"""Of normalized coordinates; a pixel is a thousandth and more."""
_NONE = 1e-9
"""A coefficient that moves nothing."""


def intrinsics_of(camera: Camera) -> Intrinsics:
    """Return the matrix K of a camera: the given one, or that of its field of view."""
    if camera.intrinsics is not None:
        return camera.intrinsics
    focal_length = camera.width / (2.0 * math.tan(camera.horizontal_fov / 2.0))
    return Intrinsics(focal_length, focal_length, camera.width / 2.0, camera.height / 2.0)


def distort(points: np.ndarray, lens: Distortion) -> np.ndarray:
    """
    Return where the lens shows points.

    Args:
        points: (…, 2): normalized coordinates of what is seen.
        lens: Its coefficients.
    """
    x, y = points[..., 0], points[..., 1]
    r2 = x * x + y * y
    radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))
    xy = 2.0 * x * y
    return np.stack(
        (
            x * radial + lens.p1 * xy + lens.p2 * (r2 + 2.0 * x * x),
            y * radial + lens.p1 * (r2 + 2.0 * y * y) + lens.p2 * xy,
        ),
        axis=-1,
    )


def undistort(points: np.ndarray, lens: Distortion) -> np.ndarray:
    """
    Return what the lens shows at points: the inverse of :func:`distort`.

    By Newton's method from the point itself. What lies beyond the circle at which the model folds
    back has no inverse, and is NaN.

    Args:
        points: (…, 2): normalized coordinates in the picture.
        lens: Its coefficients.
    """
    if lens.is_none:
        return points.copy()
    flat = points.reshape(-1, 2)
    found = flat.copy()
    with np.errstate(all='ignore'):
        rest = np.arange(len(flat))
        for _ in range(_ITERATIONS):
            at = found[rest]
            error = distort(at, lens) - flat[rest]
            is_open = np.abs(error).max(axis=-1) > _TOLERANCE
            if not is_open.any():
                break
            rest, at, error = rest[is_open], at[is_open], error[is_open]
            found[rest] = at - _solve(_jacobian(at, lens), error)
        seen: np.ndarray = found.reshape(points.shape)
        jacobian = _jacobian(seen, lens)
        error = np.abs(distort(seen, lens) - points).max(axis=-1)
        # Beyond the fold the determinant changes its sign: another solution, which is not seen.
        is_wrong = ~(error < 1e-6) | (_determinant(jacobian) <= 0.0) | _is_folded(seen, lens)
    seen[is_wrong] = np.nan
    return seen


def pixel_directions(camera: Camera) -> np.ndarray:
    """
    Return where each pixel looks: (height, width, 2), normalized coordinates.

    NaN: the lens shows nothing there.
    """
    k = intrinsics_of(camera)
    u = (np.arange(camera.width) - k.cx) / k.fx
    v = (np.arange(camera.height) - k.cy) / k.fy
    grid = np.stack(np.broadcast_arrays(u, v[:, np.newaxis]), axis=-1)
    return undistort(grid, camera.distortion)


def project(points: np.ndarray, camera: Camera) -> np.ndarray:
    """
    Return the pixels at which a camera sees points.

    Args:
        points: (…, 3), in the optical frame, m; z > 0.
        camera: The camera.

    Returns:
        (…, 2): u, v.
    """
    k = intrinsics_of(camera)
    shown = distort(points[..., :2] / points[..., 2:], camera.distortion)
    return shown * (k.fx, k.fy) + (k.cx, k.cy)


def _jacobian(points: np.ndarray, lens: Distortion) -> tuple[np.ndarray, ...]:
    """Return the derivatives of :func:`distort`: d x'/dx, d x'/dy = d y'/dx, d y'/dy."""
    x, y = points[..., 0], points[..., 1]
    r2 = x * x + y * y
    radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))
    slope = 2.0 * (lens.k1 + r2 * (2.0 * lens.k2 + 3.0 * r2 * lens.k3))
    return (
        radial + x * x * slope + 2.0 * lens.p1 * y + 6.0 * lens.p2 * x,
        x * y * slope + 2.0 * (lens.p1 * x + lens.p2 * y),
        radial + y * y * slope + 6.0 * lens.p1 * y + 2.0 * lens.p2 * x,
    )


def _determinant(jacobian: tuple[np.ndarray, ...]) -> np.ndarray:
    a, b, d = jacobian
    return np.asarray(a * d - b * b)


def _solve(jacobian: tuple[np.ndarray, ...], error: np.ndarray) -> np.ndarray:
    a, b, d = jacobian
    x, y = error[..., 0], error[..., 1]
    return np.stack((d * x - b * y, a * y - b * x), axis=-1) / _determinant(jacobian)[..., None]


def _is_folded(points: np.ndarray, lens: Distortion) -> np.ndarray:
    """Whether the radial part has passed its maximum on the way to points."""
    # d(r (1 + k1 r² + k2 r⁴ + k3 r⁶))/dr = 1 + 3 k1 s + 5 k2 s² + 7 k3 s³, s = r².
    slope = np.array([7.0 * lens.k3, 5.0 * lens.k2, 3.0 * lens.k1, 1.0])
    slope[np.abs(slope) < _NONE] = 0.0
    roots = np.roots(slope)
    real = roots[np.abs(roots.imag) < 1e-9 * np.abs(roots)].real
    first = min((root for root in real.tolist() if root > 0.0), default=math.inf)
    return np.asarray((points * points).sum(axis=-1) > first)
