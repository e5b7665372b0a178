# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``image_geometry``: where a point in space is in a picture of a camera, and the other way round.

Coordinates are those of optical frames: x right, y down, z ahead, m; pixels count from the middle
of the first one. Lenses are those of ``plumb_bob`` and ``rational_polynomial``.
"""

# ruff: noqa: N802, N803, N806 - names of the original

import copy
import importlib
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sensor_msgs.msg import CameraInfo

Matrix = NDArray[np.float64]
Pixel = tuple[float, float]
Point = tuple[float, float, float]

_ROUNDS = 100
"""Of the iteration that takes a lens out; five are enough for those of robots."""


class PinholeCameraModel:
    """One camera."""

    def __init__(self) -> None:
        self.K = self.full_K = np.eye(3)
        self.P = self.full_P = np.eye(3, 4)
        self.R = np.eye(3)
        self.D: Matrix | None = None
        self.width = self.height = 0
        self.binning_x = self.binning_y = 1
        self.resolution = (0, 0)
        self.raw_roi: Any = None
        self.tf_frame = ''
        self.stamp: Any = None

    def fromCameraInfo(self, msg: CameraInfo) -> None:
        """Take what a message says of the camera."""
        self.full_K = np.array(msg.k, dtype=float).reshape(3, 3)
        self.full_P = np.array(msg.p, dtype=float).reshape(3, 4)
        self.R = np.array(msg.r, dtype=float).reshape(3, 3)
        self.D = np.array(msg.d, dtype=float).reshape(-1, 1) if len(msg.d) else None
        self.width, self.height = msg.width, msg.height
        self.resolution = (msg.width, msg.height)
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.raw_roi = roi = copy.copy(msg.roi)
        if not (roi.x_offset or roi.y_offset or roi.width or roi.height):
            roi.width, roi.height = msg.width, msg.height
        self.tf_frame, self.stamp = msg.header.frame_id, msg.header.stamp
        self.K, self.P = self.full_K.copy(), self.full_P.copy()
        for matrix in (self.K, self.P):
            matrix[0, 2] -= roi.x_offset
            matrix[1, 2] -= roi.y_offset
            matrix[0, [0, 2]] /= self.binning_x
            matrix[1, [1, 2]] /= self.binning_y

    from_camera_info = fromCameraInfo

    def rectifyImage(self, raw: Any, rectified: Any) -> None:
        """Write a picture without the lens; raise ModuleNotFoundError: OpenCV is not installed."""
        cv2 = importlib.import_module('cv2')
        size = (self.width, self.height)
        maps = cv2.initUndistortRectifyMap(self.K, self.D, self.R, self.P, size, cv2.CV_32FC1)
        cv2.remap(raw, *maps, cv2.INTER_CUBIC, rectified)

    def rectifyPoint(self, uv_raw: Pixel) -> Pixel:
        """Return the pixel that a pixel of the raw picture has in the rectified one."""
        x, y = self._without_lens(
            (uv_raw[0] - self.K[0, 2]) / self.K[0, 0], (uv_raw[1] - self.K[1, 2]) / self.K[1, 1]
        )
        u, v, w = self.P[:, :3] @ self.R @ (x, y, 1.0)
        return float(u / w), float(v / w)

    def project3dToPixel(self, point: Point) -> Pixel:
        """Return the rectified pixel of a point; nan: it is in the plane of the camera."""
        u, v, w = self.P @ (*point, 1.0)
        return (float(u / w), float(v / w)) if w != 0.0 else (math.nan, math.nan)

    def projectPixelTo3dRay(self, uv: Pixel) -> Point:
        """Return the unit vector from the camera through a rectified pixel."""
        ray = np.array([(uv[0] - self.cx()) / self.fx(), (uv[1] - self.cy()) / self.fy(), 1.0])
        x, y, z = ray / np.linalg.norm(ray)
        return float(x), float(y), float(z)

    project_3d_to_pixel = project3dToPixel
    project_pixel_to_3d_ray = projectPixelTo3dRay
    rectify_image = rectifyImage
    rectify_point = rectifyPoint

    def getDeltaU(self, deltaX: float, Z: float) -> float:
        """Return how many pixels a distance to the right is at a depth."""
        return self.fx() * deltaX / Z if Z else math.inf

    def getDeltaV(self, deltaY: float, Z: float) -> float:
        """Return how many pixels a distance down is at a depth."""
        return self.fy() * deltaY / Z if Z else math.inf

    def getDeltaX(self, deltaU: float, Z: float) -> float:
        """Return the distance that pixels to the right are at a depth, m."""
        return Z * deltaU / self.fx()

    def getDeltaY(self, deltaV: float, Z: float) -> float:
        """Return the distance that pixels down are at a depth, m."""
        return Z * deltaV / self.fy()

    def fullResolution(self) -> tuple[int, int]:
        """Return width and height without binning and region."""
        return self.resolution

    def intrinsicMatrix(self) -> Matrix:
        """Return K."""
        return self.K

    def distortionCoeffs(self) -> Matrix | None:
        """Return D; None: the lens is perfect."""
        return self.D

    def rotationMatrix(self) -> Matrix:
        """Return R."""
        return self.R

    def projectionMatrix(self) -> Matrix:
        """Return P."""
        return self.P

    def fullIntrinsicMatrix(self) -> Matrix:
        """Return K without binning and region."""
        return self.full_K

    def fullProjectionMatrix(self) -> Matrix:
        """Return P without binning and region."""
        return self.full_P

    def cx(self) -> float:
        """Return the middle of the rectified picture, pixels from the left."""
        return float(self.P[0, 2])

    def cy(self) -> float:
        """Return the middle of the rectified picture, pixels from above."""
        return float(self.P[1, 2])

    def fx(self) -> float:
        """Return the focal length, pixels."""
        return float(self.P[0, 0])

    def fy(self) -> float:
        """Return the focal length in vertical direction, pixels."""
        return float(self.P[1, 1])

    def Tx(self) -> float:
        """Return −fx times the distance to the left camera of a pair."""
        return float(self.P[0, 3])

    def Ty(self) -> float:
        """Return the same in vertical direction."""
        return float(self.P[1, 3])

    def fovX(self) -> float:
        """Return the horizontal field of view, rad."""
        return 2.0 * math.atan(self.width / (2.0 * self.fx()))

    def fovY(self) -> float:
        """Return the vertical field of view, rad."""
        return 2.0 * math.atan(self.height / (2.0 * self.fy()))

    def tfFrame(self) -> str:
        """Return the frame of the camera."""
        return self.tf_frame

    def _with_lens(self, x: float, y: float) -> Pixel:
        """Return where the lens puts a ray (x, y, 1): the model of OpenCV."""
        if self.D is None:
            return x, y
        k1, k2, p1, p2, k3, k4, k5, k6 = np.resize(np.append(self.D, np.zeros(8)), 8)
        r2 = x * x + y * y
        radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
        return (
            x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y,
        )

    def _without_lens(self, x: float, y: float) -> Pixel:
        """Return the ray that the lens puts there, by a fixed-point iteration."""
        a, b = x, y
        for _ in range(_ROUNDS):
            u, v = self._with_lens(a, b)
            a, b = a + x - u, b + y - v
            if math.hypot(x - u, y - v) < 1e-12:
                break
        return a, b


class StereoCameraModel:
    """Two cameras side by side, rectified: the right one has the distance in its P."""

    def __init__(self) -> None:
        self.left, self.right = PinholeCameraModel(), PinholeCameraModel()
        self.Q = np.eye(4)

    def fromCameraInfo(self, left_msg: CameraInfo, right_msg: CameraInfo) -> None:
        """Take what messages say of both."""
        self.left.fromCameraInfo(left_msg)
        self.right.fromCameraInfo(right_msg)
        baseline = -self.right.Tx() / self.right.fx()
        self.Q = np.zeros((4, 4))
        self.Q[0, 0] = self.Q[1, 1] = 1.0
        self.Q[:3, 3] = -self.right.cx(), -self.right.cy(), self.right.fx()
        self.Q[3, 2] = 1.0 / baseline

    from_camera_info = fromCameraInfo

    def tfFrame(self) -> str:
        """Return the frame of the points: that of the left camera."""
        return self.left.tfFrame()

    def project3dToPixel(self, point: Point) -> tuple[Pixel, Pixel]:
        """Return the rectified pixels of a point in both pictures."""
        return self.left.project3dToPixel(point), self.right.project3dToPixel(point)

    def projectPixelTo3d(self, left_uv: Pixel, disparity: float) -> Point:
        """Return the point of a pixel of the left picture; (0, 0, 0) if it is infinitely far."""
        x, y, z, w = self.Q @ (*left_uv, disparity, 1.0)
        return (float(x / w), float(y / w), float(z / w)) if w != 0.0 else (0.0, 0.0, 0.0)

    def getZ(self, disparity: float) -> float:
        """Return the depth of a disparity, m."""
        return -self.right.Tx() / disparity if disparity else math.inf

    def getDisparity(self, Z: float) -> float:
        """Return the disparity at a depth, pixels."""
        return -self.right.Tx() / Z if Z else math.inf
