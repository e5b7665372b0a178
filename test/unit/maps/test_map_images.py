# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The images of maps: what is read, and what is not."""

import struct
import zlib

import numpy as np
import pytest

from amr_description.errors import MapDataError
from amr_description.maps.images import pgm, png, read_image

GRAY = np.array([[0, 1, 205], [254, 255, 100]], np.uint8)


@pytest.mark.parametrize(
    'data',
    [
        pgm(GRAY),
        b'P5 # GIMP\n# two comments\n3\t2\n# and another\n255\n' + GRAY.tobytes(),
        b'P2\n3 2\n255\n0 1 205 # the end of a row\n254\n255 100\n',
        b'P5\n3 2\n65535\n' + (GRAY.astype('>u2') * 257).astype('>u2').tobytes(),
        b'P3\n3 2\n255\n' + b'\n'.join(b'%d %d %d' % (v, v, v) for v in GRAY.ravel().tolist()),
        b'P6\n3 2\n255\n' + np.repeat(GRAY.ravel(), 3).tobytes(),
        png(GRAY),
    ],
    ids=['pgm', 'comments', 'P2', '16 bits', 'P3', 'P6', 'png'],
)
def test_every_form_of_an_image_is_the_same_image(data):
    image = read_image(data)
    assert image.brightness * 255 == pytest.approx(GRAY)
    assert image.alpha is None


def test_a_color_is_as_bright_as_the_mean_of_its_parts():
    image = read_image(b'P3 1 1 255 30 60 90')
    assert image.brightness[0, 0] == pytest.approx(60 / 255)


def test_alpha_is_written_and_read():
    alpha = np.array([[0, 255, 128], [255, 255, 255]], np.uint8)
    image = read_image(png(GRAY, alpha))
    assert image.brightness * 255 == pytest.approx(GRAY)
    assert image.alpha * 255 == pytest.approx(alpha)


def made_png(depth, color, rows, size, *more):
    """A PNG of rows that are filtered already; more: further chunks."""

    def chunk(name, body):
        return struct.pack('>I', len(body)) + name + body + bytes(4)

    head = struct.pack('>IIBBBBB', *size, depth, color, 0, 0, 0)
    parts = [(b'IHDR', head), *more, (b'IDAT', zlib.compress(rows)), (b'IEND', b'')]
    return b'\x89PNG\r\n\x1a\n' + b''.join(chunk(*part) for part in parts)


def filtered(kind, raw, step):
    """Filter rows by the definitions of the specification, byte by byte."""
    found = b''
    above = bytes(len(raw[0]))
    for row in raw:
        found += bytes([kind])
        for at, value in enumerate(row):
            left = row[at - step] if at >= step else 0
            corner = above[at - step] if at >= step else 0
            guess = left + above[at] - corner
            paeth = min((left, above[at], corner), key=lambda each: abs(guess - each))
            taken = (0, left, above[at], (left + above[at]) // 2, paeth)[kind]
            found += bytes([(value - taken) % 256])
        above = row
    return found


@pytest.mark.parametrize('kind', range(5))
def test_all_filters_of_png_are_undone(kind):
    random = np.random.default_rng(kind)
    pixels = random.integers(0, 256, (9, 7, 3), np.uint8)
    rows = filtered(kind, [row.tobytes() for row in pixels], 3)
    image = read_image(made_png(8, 2, rows, (7, 9)))
    assert image.brightness * 255 == pytest.approx(pixels.mean(axis=-1))


def test_png_of_few_bits_of_a_palette_and_of_sixteen_bits():
    bits = read_image(made_png(1, 0, b'\x00\xa8\x00\x48', (5, 2)))
    assert bits.brightness.tolist() == [[1, 0, 1, 0, 1], [0, 1, 0, 0, 1]]
    deep = read_image(made_png(16, 0, b'\x00' + struct.pack('>2H', 0, 65535), (2, 1)))
    assert deep.brightness.tolist() == [[0, 1]]
    palette = (b'PLTE', bytes([0, 0, 0, 255, 255, 255])), (b'tRNS', b'\xff\x00')
    colors = read_image(made_png(2, 3, b'\x00\x10', (2, 1), *palette))
    assert colors.brightness.tolist() == [[0, 1]]
    assert colors.alpha.tolist() == [[1, 0]]
    keyed = read_image(made_png(8, 0, b'\x00\x05\x06', (2, 1), (b'tRNS', b'\x00\x05')))
    assert keyed.alpha.tolist() == [[0, 1]]


@pytest.mark.parametrize(
    ('data', 'words'),
    [
        (b'', 'it is empty'),
        (b'BM123', 'a BMP file.*PGM'),
        (b'\xff\xd8\xff\xe0', 'a JPEG file'),
        (b'hello', 'no image'),
        (b'P5\n3 2\n255\n' + bytes(5), 'ends after 5 of 6 values'),
        (b'P5\n3 x\n255\n', 'no width, height'),
        (b'P5\n0 2\n255\n', 'its size is 0 x 2'),
        (b'P5\n99999999 99999999\n255\n', 'its size'),
        (b'P5\n3 2\n70000\n' + bytes(12), 'greatest value is 70000'),
        (b'P2\n2 1\n255\n7 x', 'no number'),
        (b'P2\n2 1\n255\n7', 'ends after 1 of 2'),
        (b'P5 # no end', 'no width'),
        (png(GRAY)[:20], 'head is cut off'),
        (png(GRAY)[:45], 'cut off|unpacked'),
        (made_png(8, 0, b'\x05abc', (3, 1)), 'unknown filter 5'),
        (made_png(8, 3, b'\x00\x01', (1, 1), (b'PLTE', b'abc')), 'palette lacks'),
        (made_png(4, 2, b'', (1, 1)), 'no color type 2 of 4 bits'),
        (made_png(8, 0, b'\x00a', (3, 1)), 'ends after 2 of 4'),
        (made_png(8, 0, b'', (1, 1)).replace(b'\x08\x00\x00\x00\x00', b'\x08\x00\x00\x00\x01', 1),
         'interlaced'),
    ],
)  # fmt: skip
def test_what_is_no_image_is_said_in_a_line(data, words):
    with pytest.raises(MapDataError, match=words) as error:
        read_image(data)
    assert '\n' not in str(error.value)


@pytest.mark.parametrize('head', ['P5 20 10 255', 'P6 20 10 65535', 'P4 20 10', 'P5 2 1 25'])
@pytest.mark.parametrize('cut', range(4))
def test_an_image_that_ends_in_its_head_is_said_in_a_line(head, cut):
    with pytest.raises(MapDataError, match=r'^[^\n]+$'):
        read_image(head[: len(head) - cut].encode())
