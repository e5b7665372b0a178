# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Join still WebP pictures, as a browser makes them, into one that moves.

The container is that of https://developers.google.com/speed/webp/docs/riff_container: chunks of a
name, a length and data; a frame holds the chunks of its picture.
"""

import struct


def animation(pictures, milliseconds):
    """
    Return an animated WebP that goes round for ever.

    :param pictures: The bytes of still WebP files, all of one size.
    :param milliseconds: How long each is shown.
    """
    sizes = {size_of(picture) for picture in pictures}
    assert len(sizes) == 1, f'pictures of one size are joined, not of {sizes}'
    ((width, height),) = sizes
    canvas = _u24(width - 1) + _u24(height - 1)
    is_animated = struct.pack('<I', 0x02)
    parts = [
        _chunk(b'VP8X', is_animated + canvas),
        _chunk(b'ANIM', struct.pack('<IH', 0xFFFFFFFF, 0)),  # a white ground, without end
    ]
    for picture in pictures:
        head = _u24(0) + _u24(0) + canvas + _u24(milliseconds) + b'\x02'  # drawn, not blended
        image = [(name, data) for name, data in chunks(picture) if name in (b'VP8 ', b'VP8L')]
        parts.append(_chunk(b'ANMF', head + b''.join(_chunk(*each) for each in image)))
    return _chunk(b'RIFF', b'WEBP' + b''.join(parts))


def chunks(file):
    """The name and the data of each chunk of a WebP file."""
    assert file[:4] == b'RIFF' and file[8:12] == b'WEBP', 'no WebP'
    at = 12
    while at < len(file):
        name, length = struct.unpack_from('<4sI', file, at)
        yield name, file[at + 8 : at + 8 + length]
        at += 8 + length + length % 2


def size_of(picture):
    """Width and height of a WebP file, pixels."""
    for name, data in chunks(picture):
        if name == b'VP8X':
            width, height = (int.from_bytes(data[at : at + 3], 'little') for at in (4, 7))
            return width + 1, height + 1
        if name == b'VP8 ':  # after the frame tag and the start code
            width, height = struct.unpack_from('<HH', data, 6)
            return width & 0x3FFF, height & 0x3FFF
        if name == b'VP8L':
            bits = int.from_bytes(data[1:5], 'little')
            return (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    raise AssertionError('a WebP without a picture')


def _chunk(name, data):
    return struct.pack('<4sI', name, len(data)) + data + b'\0' * (len(data) % 2)


def _u24(value):
    return value.to_bytes(3, 'little')
