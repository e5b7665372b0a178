# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What messages are made of pictures: noise, other encodings, JPEGs, clouds of points."""

import numpy as np

from amr_description.model.gazebo.tags import Noise
from amr_description.model.sensors import Camera
from amr_description.sim.cameras.lens import pixel_directions
from amr_description.sim.cameras.renderer import RenderedPicture

_LUMA = np.array([299, 587, 114], np.uint32)
"""Thousandths of red, green and blue in a grey, as ITU-R BT.601 says."""
_JPEG_QUALITY = 95
"""That of compressed_image_transport."""
_COLOR_COLUMN = 4
"""Of a point with a colour, in numbers of 32 bits."""


def with_noise(
    picture: RenderedPicture, noise: Noise, generator: np.random.Generator
) -> RenderedPicture:
    """
    Return a picture with Gaussian noise: one number for each pixel, as Gazebo adds it.

    Args:
        picture: Without noise; it may be changed.
        noise: Of colours, 0 to 1; of depth, m, where there are no colours.
        generator: Of this measurement.
    """
    if noise.stddev <= 0.0 and noise.mean == 0.0:
        return picture
    color, depth = picture.color, picture.depth
    if color is not None:
        change = _normal(generator, color.shape[:2], noise) * np.float32(255.0)
        values = color + np.rint(change)[..., np.newaxis]
        color = np.clip(values, 0.0, 255.0, out=values).astype(np.uint8)
    elif depth is not None:
        depth = depth + _normal(generator, depth.shape, noise)
    return RenderedPicture(color, depth)


def encoded(color: np.ndarray, encoding: str) -> np.ndarray:
    """Return pixels (height, width, 3), rgb8, as ``rgb8``, ``bgr8`` or ``mono8``."""
    if encoding == 'bgr8':
        return np.ascontiguousarray(color[..., ::-1])
    if encoding == 'mono8':
        return ((color @ _LUMA + np.uint32(500)) // np.uint32(1000)).astype(np.uint8)
    return color


def jpeg(pixels: np.ndarray, encoding: str) -> bytes:
    """Return pixels of an encoding as a JPEG."""
    import simplejpeg  # noqa: PLC0415 - 10 ms that only pay who looks at it

    if encoding == 'mono8':
        pixels, colors = pixels[..., np.newaxis], 'GRAY'
    else:
        colors = encoding.removesuffix('8').upper()
    data: bytes = simplejpeg.encode_jpeg(
        pixels, quality=_JPEG_QUALITY, colorspace=colors, colorsubsampling='420'
    )
    return data


class PointMaker:
    """Makes the points of a cloud of depths."""

    def __init__(self, camera: Camera, *, with_color: bool) -> None:
        """``with_color``: whether each has a colour."""
        seen = pixel_directions(camera)
        ahead = np.ones((*seen.shape[:2], 1))
        if camera.points_are_optical:
            directions = np.concatenate((seen, ahead), axis=-1)
        else:
            directions = np.concatenate((ahead, -seen), axis=-1)
        self._directions = directions.astype(np.float32)
        self._columns = 6 if with_color else 4

    def points(self, depth: np.ndarray, color: np.ndarray | None) -> np.ndarray:
        """
        Return points, (height, width, columns), float32: x, y, z and the bits of a colour.

        What has no finite depth is NaN.

        Args:
            depth: (height, width), m.
            color: (height, width, 3), uint8; None: they have none.
        """
        finite = np.where(np.isfinite(depth), depth, np.float32(np.nan))
        points = np.zeros((*depth.shape, self._columns), np.float32)
        np.multiply(self._directions, finite[..., np.newaxis], out=points[..., :3])
        if color is not None:
            packed = points.view(np.uint8).reshape(*depth.shape, -1, 4)
            # Little endian 0x00RRGGBB.
            packed[..., _COLOR_COLUMN, :3] = color[..., ::-1]
        return points


def _normal(generator: np.random.Generator, shape: tuple[int, ...], noise: Noise) -> np.ndarray:
    values = generator.standard_normal(shape, np.float32)
    values *= np.float32(noise.stddev)
    values += np.float32(noise.mean)
    return values
