# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The images of maps, read and written with nothing but NumPy and zlib.

Read are Netpbm files, ``.pgm`` and ``.ppm`` (P2, P3, P5, P6), and ``.png`` that is not interlaced;
written are ``.pgm`` (P5) and ``.png`` (8 bits). The first bytes say what a file is, not its name.
BMP and JPEG files, which nav2_map_server reads too, are not: their message says so.
"""

from dataclasses import dataclass
import struct
from typing import TypeAlias
import zlib

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import MapDataError
from amr_description.png import png as png_of, SIGNATURE

Floats: TypeAlias = NDArray[np.float64]
Bytes: TypeAlias = NDArray[np.uint8]

MAX_PIXELS = 1 << 28
"""An image of more is refused."""

_NETPBM = {b'P2': (1, False), b'P3': (3, False), b'P5': (1, True), b'P6': (3, True)}
"""Magic number -> samples of a pixel, and whether they are bytes."""
_OTHERS = {b'BM': 'a BMP file', b'\xff\xd8': 'a JPEG file', b'GIF8': 'a GIF file'}
_READABLE = (
    'PGM (P2, P5), PPM (P3, P6) and PNG are read: convert it, as by `convert IMAGE map.png`'
)
_SAMPLES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
"""PNG's color type -> samples of a pixel."""
_DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}
_PALETTE = 3


@dataclass(frozen=True, slots=True, eq=False)
class MapImage:
    """A picture; row 0 is its top."""

    brightness: Floats
    """(height, width), 0 black to 1 white: the mean of red, green and blue."""
    alpha: Floats | None = None
    """(height, width), 0 transparent to 1 opaque; None: the file has none."""


def read_image(data: bytes) -> MapImage:
    """
    Return the image of a file.

    Args:
        data: what the file holds.

    Raises:
        MapDataError: it is of another format, or broken; the line says which, without the file.
    """
    if data.startswith(SIGNATURE):
        return _read_png(data)
    if data[:2] in _NETPBM:
        return _read_netpbm(data)
    if not data:
        raise MapDataError('it is empty')
    kind = next((name for magic, name in _OTHERS.items() if data.startswith(magic)), 'no image')
    raise MapDataError(f'it is {kind} that is read here; {_READABLE}')


def pgm(gray: Bytes) -> bytes:
    """Return (height, width) gray values, 0 to 255, as a binary PGM file."""
    height, width = gray.shape
    return b'P5\n%d %d\n255\n' % (width, height) + gray.tobytes()


def png(gray: Bytes, alpha: Bytes | None = None) -> bytes:
    """Return (height, width) gray values, 0 to 255, as a PNG file; RGBA where there is alpha."""
    return png_of(gray if alpha is None else np.stack((gray, gray, gray, alpha), axis=-1))


def _check_size(width: int, height: int) -> None:
    """Refuse what no map is. Raises MapDataError."""
    if width <= 0 or height <= 0 or width * height > MAX_PIXELS:
        raise MapDataError(
            f'its size is {width} x {height} pixels; there must be one, and at most {MAX_PIXELS}'
        )


# Netpbm: https://netpbm.sourceforge.net/doc/pgm.html


def _read_netpbm(data: bytes) -> MapImage:
    samples, is_binary = _NETPBM[data[:2]]
    (width, height, white), start = _netpbm_head(data)
    _check_size(width, height)
    if not 0 < white < 65536:
        raise MapDataError(f'its greatest value is {white}; it must be 1 to 65535')
    count = width * height * samples
    if is_binary:
        kind = np.dtype(np.uint8 if white < 256 else '>u2')
        has = min(count, max(0, len(data) - start) // kind.itemsize)
        pixels = data[start : start + has * kind.itemsize]
        values = np.frombuffer(pixels, kind).astype(np.int64)
    else:
        try:
            text = b'\n'.join(line.partition(b'#')[0] for line in data[start:].split(b'\n'))
            values = np.array(text.split()[:count], np.int64)
        except (ValueError, OverflowError):
            raise MapDataError('one of its pixels is no number') from None
    if len(values) < count:
        raise MapDataError(
            f'it ends after {len(values)} of {count} values: it is cut off, save it again'
        )
    scaled = np.clip(values / white, 0.0, 1.0).reshape(height, width, samples)
    return MapImage(scaled.mean(axis=-1))


def _netpbm_head(data: bytes) -> tuple[list[int], int]:
    """Return width, height and greatest value, and where the pixels begin."""
    numbers: list[int] = []
    at = 2
    while len(numbers) < 3:
        while data[at : at + 1].isspace():
            at += 1
        if data[at : at + 1] == b'#':
            end = data.find(b'\n', at)
            at = len(data) if end < 0 else end
            continue
        end = at
        while data[end : end + 1].isdigit():
            end += 1
        if end == at or end - at > 9:
            raise MapDataError('its head has no width, height and greatest value')
        numbers.append(int(data[at:end]))
        at = end
    return numbers, at + 1  # one white space, then the pixels


# PNG: https://www.w3.org/TR/png/


@dataclass(frozen=True, slots=True)
class _Head:
    width: int
    height: int
    depth: int
    color: int

    @property
    def samples(self) -> int:
        return _SAMPLES[self.color]


def _read_png(data: bytes) -> MapImage:
    head, chunks = _png_parts(data)
    values = _png_samples(head, chunks.get(b'IDAT', b''))
    transparent = chunks.get(b'tRNS')
    if head.color == _PALETTE:
        return _with_palette(values[:, :, 0], chunks.get(b'PLTE', b''), transparent)
    white = (1 << head.depth) - 1
    colors = values[:, :, : 3 if head.color in (2, 6) else 1]
    alpha = None
    if head.color in (4, 6):
        alpha = values[:, :, -1] / white
    elif transparent is not None and len(transparent) == 2 * head.samples:
        unseen = np.frombuffer(transparent, '>u2')
        alpha = (colors != unseen).any(axis=-1).astype(np.float64)
    return MapImage((colors / white).mean(axis=-1), alpha)


def _with_palette(indices: NDArray[np.uint16], palette: bytes, alphas: bytes | None) -> MapImage:
    colors = np.frombuffer(palette, np.uint8, len(palette) // 3 * 3).reshape(-1, 3)
    if not len(colors) or int(indices.max()) >= len(colors):
        raise MapDataError('its palette lacks a color that a pixel has')
    brightness = (colors / 255.0).mean(axis=-1)[indices]
    if alphas is None:
        return MapImage(brightness)
    opacity = np.ones(256)
    opacity[: len(alphas)] = np.frombuffer(alphas[:256], np.uint8) / 255.0
    return MapImage(brightness, opacity[indices])


def _png_parts(data: bytes) -> tuple[_Head, dict[bytes, bytes]]:
    """Return the head, and what the chunks hold, by name; several of a name together."""
    chunks: dict[bytes, list[bytes]] = {}
    at = len(SIGNATURE)
    while at + 8 <= len(data) and b'IEND' not in chunks:
        (length,) = struct.unpack_from('>I', data, at)
        chunks.setdefault(data[at + 4 : at + 8], []).append(data[at + 8 : at + 8 + length])
        at += 12 + length
    parts = {name: b''.join(bodies) for name, bodies in chunks.items()}
    if len(parts.get(b'IHDR', b'')) != 13:
        raise MapDataError('its head is cut off: save it again')
    width, height, depth, color, _, _, interlaced = struct.unpack('>IIBBBBB', parts[b'IHDR'])
    _check_size(width, height)
    if depth not in _DEPTHS.get(color, ()):
        raise MapDataError(f'PNG knows no color type {color} of {depth} bits')
    if interlaced:
        raise MapDataError('it is an interlaced PNG, which is not read: save it without')
    return _Head(width, height, depth, color), parts


def _png_samples(head: _Head, packed: bytes) -> NDArray[np.uint16]:
    """Return all samples, (height, width, samples)."""
    bits = head.samples * head.depth
    stride = (head.width * bits + 7) // 8
    size = head.height * (stride + 1)
    try:
        data = zlib.decompressobj().decompress(packed, size)
    except zlib.error as error:
        raise MapDataError(f'its pixels cannot be unpacked: {error}') from error
    if len(data) < size:
        raise MapDataError(f'it ends after {len(data)} of {size} bytes: it is cut off')
    rows = _unfiltered(np.frombuffer(data, np.uint8).reshape(head.height, -1), max(1, bits // 8))
    if head.depth == 16:
        values = rows.view('>u2').astype(np.uint16)
    elif head.depth == 8:
        values = rows.astype(np.uint16)
    else:
        single = np.unpackbits(rows, axis=1).reshape(head.height, -1, head.depth)
        weights = (1 << np.arange(head.depth - 1, -1, -1)).astype(np.uint16)
        values = (single @ weights).astype(np.uint16)[:, : head.width]
    return values.reshape(head.height, head.width, head.samples)


def _unfiltered(filtered: Bytes, step: int) -> Bytes:
    """
    Undo the filters of PNG's rows (section 9 of the specification).

    Args:
        filtered: (height, 1 + bytes): the kind of filter, and the row.
        step: bytes from a sample to the one on its left.
    """
    rows = np.empty((filtered.shape[0], filtered.shape[1] - 1), np.uint8)
    above = np.zeros(rows.shape[1], np.uint8)
    for row, (kind, *_) in enumerate(filtered[:, :1].tolist()):
        line = filtered[row, 1:]
        match kind:
            case 0:
                above = line
            case 1:
                above = _summed(line, step)
            case 2:
                above = line + above
            case 3:
                above = _averaged(line, above, step)
            case 4:
                above = _paeth(line, above, step)
            case _:
                raise MapDataError(f'row {row} has the unknown filter {kind}')
        rows[row] = above
    return rows


def _summed(line: Bytes, step: int) -> Bytes:
    padded = np.concatenate((line, np.zeros(-len(line) % step, np.uint8)))
    sums = np.cumsum(padded.reshape(-1, step), axis=0, dtype=np.uint8)
    return sums.reshape(-1)[: len(line)]


def _averaged(line: Bytes, above: Bytes, step: int) -> Bytes:
    values, up = line.tolist(), above.tolist()
    for at, value in enumerate(values):
        left = values[at - step] if at >= step else 0
        values[at] = (value + (left + up[at]) // 2) & 255
    return np.array(values, np.uint8)


def _paeth(line: Bytes, above: Bytes, step: int) -> Bytes:
    values, up = line.tolist(), above.tolist()
    for at, value in enumerate(values):
        left = values[at - step] if at >= step else 0
        corner = up[at - step] if at >= step else 0
        guess = left + up[at] - corner
        by_left, by_up, by_corner = abs(guess - left), abs(guess - up[at]), abs(guess - corner)
        if by_left <= by_up and by_left <= by_corner:
            nearest = left
        else:
            nearest = up[at] if by_up <= by_corner else corner
        values[at] = (value + nearest) & 255
    return np.array(values, np.uint8)
