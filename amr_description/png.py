# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""PNG files, written with nothing but NumPy and zlib: https://www.w3.org/TR/png/."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

SIGNATURE = b'\x89PNG\r\n\x1a\n'
_KINDS = {1: 0, 3: 2, 4: 6}
"""Samples of a pixel -> PNG's color type."""


def png(pixels: NDArray[np.uint8]) -> bytes:
    """Return a file of (height, width) grey values, (…, 3) RGB or (…, 4) RGBA, 0 to 255."""
    height, width = pixels.shape[:2]
    rows = pixels.reshape(height, -1)
    unfiltered = np.concatenate((np.zeros((height, 1), np.uint8), rows), axis=1)
    kind = _KINDS[rows.shape[1] // width]
    head = struct.pack('>IIBBBBB', width, height, 8, kind, 0, 0, 0)
    parts = ((b'IHDR', head), (b'IDAT', zlib.compress(unfiltered.tobytes())), (b'IEND', b''))
    return SIGNATURE + b''.join(_chunk(name, body) for name, body in parts)


def _chunk(name: bytes, body: bytes) -> bytes:
    check = zlib.crc32(name + body)
    return struct.pack('>I', len(body)) + name + body + struct.pack('>I', check)
