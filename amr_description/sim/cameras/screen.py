# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The rays of a camera as a grid, and which of them may meet what lies in a box.

In the sensor's axes (x forward, y to the left, z up) the ray of a pixel is (1, -x, -y), with the
normalized coordinates x, y of the optical frame: the distance along it is the depth. Without a
distortion x depends on the column alone and y on the row alone, so that what is linear in the
direction is a sum of a row and a column: one operation for each pixel.
"""

from typing import NamedTuple, Self

import numpy as np

from amr_description.model.sensors import Camera
from amr_description.sim.cameras.lens import intrinsics_of, pixel_directions

_BEHIND = 1e-4
"""m in front of the camera; what is not as far has no place in the picture."""


class Area(NamedTuple):
    """A rectangle of pixels."""

    rows: slice
    columns: slice


class Screen:
    """Rays from one point; those of a camera: :meth:`of`."""

    def __init__(self, x: np.ndarray, y: np.ndarray, spread: float) -> None:
        """
        Make a grid.

        Args:
            x: Normalized coordinates of the columns (1, width), or of all rays (height, width).
            y: Likewise of the rows, (height, 1), or of all rays. NaN: nothing is seen there.
            spread: How wide a pixel is at a depth of 1.
        """
        self.shape = np.broadcast_shapes(x.shape, y.shape)
        self.everywhere = Area(slice(0, self.shape[0]), slice(0, self.shape[1]))
        is_blind = np.isnan(x + y)
        self.is_blind = is_blind if is_blind.any() else None
        """(height, width): the lens shows nothing there; None: it does everywhere."""
        self.spread = spread
        """How wide a pixel is at a depth of 1."""
        self._is_separable = x.shape != self.shape
        self._x, self._y = x, y
        self._left, self._right = np.nanmin(x, axis=0), np.nanmax(x, axis=0)
        self._top, self._bottom = np.nanmin(y, axis=1), np.nanmax(y, axis=1)
        self.longest = float(np.sqrt(1.0 + np.nanmax(x * x + y * y)))
        """The length of the longest ray."""

    @classmethod
    def of(cls, camera: Camera) -> Self:
        """Return the rays of a camera."""
        seen = pixel_directions(camera)
        x, y = seen[..., 0], seen[..., 1]
        spread = 1.0 / intrinsics_of(camera).fx
        if camera.distortion.is_none:
            return cls(x[:1], y[:, :1], spread)
        return cls(x, y, spread)

    def linear(self, factors: np.ndarray, area: Area) -> np.ndarray:
        """Return the product of each ray (1, -x, -y) and (3,) factors: (rows, columns)."""
        x, y = self._coordinates(area)
        forward, left, up = factors.tolist()
        return np.asarray((forward - x * left) - y * up)

    def rays(self, area: Area) -> np.ndarray:
        """Return the rays of an area: (rows, columns, 3)."""
        x, y = np.broadcast_arrays(*self._coordinates(area))
        return np.stack((np.ones(x.shape), -x, -y), axis=-1)

    def area_of(self, corners: np.ndarray) -> Area | None:
        """
        Return the pixels that may show the convex hull of corners.

        Args:
            corners: (n, 3), in the sensor's axes.

        Returns:
            None: it is not in view.
        """
        ahead = corners[:, 0]
        if ahead.max() <= _BEHIND:
            return None
        if ahead.min() <= _BEHIND:
            corners = _cut(corners)
            ahead = corners[:, 0]
        x, y = -corners[:, 1] / ahead, -corners[:, 2] / ahead
        columns = np.flatnonzero((self._right >= x.min()) & (self._left <= x.max()))
        rows = np.flatnonzero((self._bottom >= y.min()) & (self._top <= y.max()))
        if not (len(columns) and len(rows)):
            return None
        return Area(
            slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)
        )

    def _coordinates(self, area: Area) -> tuple[np.ndarray, np.ndarray]:
        if self._is_separable:
            return self._x[:, area.columns], self._y[area.rows]
        return self._x[area], self._y[area]


def _cut(corners: np.ndarray) -> np.ndarray:
    """Return corners (n, 3) of what is ahead of the camera of the convex hull of corners."""
    is_ahead = corners[:, 0] > _BEHIND
    ahead, behind = corners[is_ahead], corners[~is_ahead]
    # Where the lines between one ahead and one behind pass the plane.
    share = (_BEHIND - behind[:, 0]) / (ahead[:, np.newaxis, 0] - behind[:, 0])
    between = behind + share[..., np.newaxis] * (ahead[:, np.newaxis] - behind)
    between[..., 0] = _BEHIND
    return np.concatenate((ahead, between.reshape(-1, 3)))
