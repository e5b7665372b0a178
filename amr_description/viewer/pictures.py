# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures of cameras, made small enough to be sent to a page: JPEG of a bounded size.

The layouts of pixels are those of ``sensor_msgs/image_encodings.hpp``. What a message says of
itself is not believed: a size that does not fit its bytes is a ViewerError.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from amr_description.errors import ViewerError
from amr_description.text import quote

MOST_PIXELS = 640
"""Columns, and rows, of a picture that is sent; larger ones lose every other pixel, or more."""
MOST_BYTES = 400_000
"""Of a compressed picture that is sent as it came."""
_LARGEST = 16384
"""Columns or rows of a picture that is read at all."""
_QUALITY = 80
_FAR = 40
"""Grey of the farthest point of a depth picture; 0 is where there is none, 255 the nearest."""

Pixels: TypeAlias = np.ndarray
"""uint8, of the shape (rows, columns) or (rows, columns, 3 or 4)."""
PictureFormat: TypeAlias = Literal['image/jpeg', 'image/png']

_COLOURS = {
    'rgb8': (3, 'RGB'),
    'bgr8': (3, 'BGR'),
    'rgba8': (4, 'RGBA'),
    'bgra8': (4, 'BGRA'),
    '8UC3': (3, 'BGR'),
    '8UC4': (4, 'BGRA'),
    'mono8': (1, 'GRAY'),
    '8UC1': (1, 'GRAY'),
}
"""Encoding -> channels, and what simplejpeg calls them."""
_DEPTHS = {'32FC1': ('f4', 1.0), '16UC1': ('u2', 1e-3), 'mono16': ('u2', 1.0)}
"""Encoding -> type of a pixel, and its unit: m (REP 118); of mono16 there is none."""


@dataclass(frozen=True, slots=True)
class SmallPicture:
    """
    A picture for a page.

    Attributes:
        format: of ``data``.
        data: The file.
        low: What the lightest grey means, m, for a picture of depths; None: no such picture.
        high: What the darkest grey means, m.
        width: Columns of the picture as it came.
        height: Its rows.
    """

    format: PictureFormat
    data: bytes
    width: int
    height: int
    low: float | None = None
    high: float | None = None


def picture_of_pixels(
    encoding: str, width: int, height: int, step: int, data: np.ndarray, *, is_bigendian: bool
) -> SmallPicture:
    """
    Return a picture of raw pixels.

    Args:
        encoding: Of the pixels: rgb8, 32FC1 …
        width: Columns.
        height: Rows.
        step: Bytes of a row, with what fills it up.
        data: The bytes.
        is_bigendian: Of pixels of several bytes.

    Raises:
        ViewerError: The encoding is not known, or the bytes do not fit the size.
    """
    if encoding in _DEPTHS:
        kind, unit = _DEPTHS[encoding]
        dtype = np.dtype(('>' if is_bigendian else '<') + kind)
        values = _grid(width, height, step, data, dtype.itemsize).view(dtype)[..., 0]
        grey, low, high = _grey_of(values, unit, is_depth=encoding != 'mono16')
        return SmallPicture('image/jpeg', _jpeg(grey, 'GRAY'), width, height, low, high)
    if encoding not in _COLOURS:
        known = ', '.join([*_COLOURS, *_DEPTHS])
        raise ViewerError(f'pixels of encoding {quote(encoding)} are not shown; known: {known}')
    channels, space = _COLOURS[encoding]
    pixels = _grid(width, height, step, data, channels)
    return SmallPicture('image/jpeg', _jpeg(pixels, space), width, height)


def picture_of_file(data: bytes) -> SmallPicture:
    """
    Return a picture of a compressed one, as it came if it is small enough. Raises ViewerError.
    """
    import simplejpeg

    if data.startswith(b'\x89PNG\r\n\x1a\n') and len(data) > 24:
        width, height = (int.from_bytes(data[at : at + 4], 'big') for at in (16, 20))
        if len(data) > MOST_BYTES or max(width, height) > _LARGEST:
            raise ViewerError(
                f'a PNG of {width} x {height} pixels, {len(data)} bytes, is too large for the '
                f'page: {MOST_BYTES} bytes at most'
            )
        return SmallPicture('image/png', data, width, height)
    if not data.startswith(b'\xff\xd8'):
        raise ViewerError(f'{len(data)} bytes are neither JPEG nor PNG: {data[:8].hex(" ")}')
    try:
        height, width, *_ = simplejpeg.decode_jpeg_header(data)
        if max(width, height) > _LARGEST:
            raise ViewerError(f'a JPEG of {width} x {height} pixels is too large for the page')
        if len(data) > MOST_BYTES or max(width, height) > 2 * MOST_PIXELS:
            # No smaller than that: decoded at an eighth, a quarter or a half of its size.
            pixels = simplejpeg.decode_jpeg(
                data, min_height=1, min_width=min(width, MOST_PIXELS), min_factor=1
            )
            data = _jpeg(pixels, 'RGB')
    except ValueError as error:
        raise ViewerError(f'a JPEG cannot be read: {error}') from None
    return SmallPicture('image/jpeg', data, width, height)


def _grid(width: int, height: int, step: int, data: np.ndarray, size: int) -> Pixels:
    """Return the pixels as an array (rows, columns, bytes of a pixel), thinned. Checks all."""
    if not (0 < width <= _LARGEST and 0 < height <= _LARGEST):
        raise ViewerError(
            f'a picture of {width} x {height} pixels is not shown; 1 to {_LARGEST} each way are'
        )
    if step < width * size or len(data) < step * (height - 1) + width * size:
        raise ViewerError(
            f'a picture of {width} x {height} pixels of {size} bytes, {step} bytes a row, does '
            f'not fit its {len(data)} bytes'
        )
    rows = np.lib.stride_tricks.as_strided(
        data, (height, width, size), (step, size, 1), writeable=False
    )
    thin = -(-max(width, height) // MOST_PIXELS)
    return np.ascontiguousarray(rows[::thin, ::thin])


def _grey_of(
    values: np.ndarray, unit: float, *, is_depth: bool
) -> tuple[Pixels, float | None, float | None]:
    """Return greys, and what the lightest and the darkest mean, m; depths: near is light."""
    values = values.astype('f4') * np.float32(unit)
    is_known = np.isfinite(values)
    if is_depth:
        is_known &= values > 0  # 16UC1: 0 is none (REP 118)
    known = values[is_known]
    if not len(known):
        return np.zeros(values.shape, 'u1'), None, None
    low, high = float(known.min()), float(known.max())
    share = (np.where(is_known, values, low) - low) / max(high - low, 1e-6)
    greys = 255 - (255 - _FAR) * share if is_depth else 255 * share
    grey = np.where(is_known, greys, 0).astype('u1')
    return (grey, low, high) if is_depth else (grey, None, None)


def _jpeg(pixels: Pixels, space: str) -> bytes:
    import simplejpeg

    grid = pixels[..., None] if pixels.ndim == 2 else pixels  # noqa: PLR2004
    thin = -(-max(grid.shape[:2]) // MOST_PIXELS)
    grid = np.ascontiguousarray(grid[::thin, ::thin])
    subsampling = 'Gray' if space == 'GRAY' else '420'
    return simplejpeg.encode_jpeg(grid, _QUALITY, space, subsampling)
