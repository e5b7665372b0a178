# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures for the page: what was red is red, near is light, and nothing else gets through."""

from hypothesis import given, strategies as st
import numpy as np
import pytest
import simplejpeg

from amr_description.errors import ViewerError
from amr_description.viewer.pictures import (
    MOST_BYTES,
    MOST_PIXELS,
    picture_of_file,
    picture_of_pixels,
)

RED, GREY = (250, 20, 20), (120, 120, 120)
ORDERS = {
    'rgb8': (0, 1, 2), 'bgr8': (2, 1, 0), 'rgba8': (0, 1, 2, 0), 'bgra8': (2, 1, 0, 0),
    '8UC3': (2, 1, 0), '8UC4': (2, 1, 0, 0), 'mono8': (0,), '8UC1': (0,),
}  # fmt: skip


def picture(array, encoding, *, filling=0, is_bigendian=False):
    """A picture of an array (rows, columns, …); ``filling``: bytes after each row."""
    height, width = array.shape[:2]
    rows = array.reshape(height, -1).view('u1')
    data = np.pad(rows, ((0, 0), (0, filling))).ravel()
    step = rows.shape[1] + filling
    return picture_of_pixels(encoding, width, height, step, data, is_bigendian=is_bigendian)


def pixels(small):
    return simplejpeg.decode_jpeg(small.data, 'RGB').astype(int)


@pytest.mark.parametrize('filling', [0, 5])
@pytest.mark.parametrize('encoding', ORDERS)
def test_the_left_is_red_and_the_right_is_grey(encoding, filling):
    colours = np.full((32, 64, 3), GREY, 'u1')
    colours[:, :32] = RED
    if len(ORDERS[encoding]) == 1:
        colours[:, :32] = RED[:1] * 3
    found = picture(
        np.ascontiguousarray(colours[..., ORDERS[encoding]]), encoding, filling=filling
    )
    assert (found.width, found.height, found.format) == (64, 32, 'image/jpeg')
    seen = pixels(found)
    for at in (4, 60):
        assert np.abs(seen[16, at] - colours[16, at]).max() < 12


@pytest.mark.parametrize(
    ('kind', 'encoding', 'unit'), [('f4', '32FC1', 1.0), ('u2', '16UC1', 1e3)]
)
@pytest.mark.parametrize('order', ['<', '>'])
def test_the_nearest_is_the_lightest_and_what_is_not_known_is_black(kind, encoding, unit, order):
    depths = np.full((32, 96), 4.0)
    depths[:, :32] = 1.5
    values = (depths * unit).astype(f'{order}{kind}')
    values[:, 64:] = 0 if kind == 'u2' else np.nan
    found = picture(values[..., None], encoding, is_bigendian=order == '>')
    assert (found.low, found.high) == pytest.approx((1.5, 4.0))
    near, far, none = (pixels(found)[16, at, 0] for at in (8, 48, 88))
    assert near > 245
    assert 30 < far < 50
    assert none < 8


@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf, 2.0])
def test_a_depth_picture_of_one_value_has_no_range_or_that_one(value):
    found = picture(np.full((8, 8, 1), value, 'f4'), '32FC1')
    assert (found.low, found.high) == ((2.0, 2.0) if value == 2.0 else (None, None))


@pytest.mark.parametrize('shape', [(481, 641), (2000, 20), (20, 3000)])
def test_a_large_picture_is_sent_small(shape):
    found = picture(np.zeros((*shape, 3), 'u1'), 'rgb8')
    assert (found.height, found.width) == shape
    assert max(pixels(found).shape) <= MOST_PIXELS


@pytest.mark.parametrize(
    ('encoding', 'width', 'height', 'step', 'text'),
    [
        ('bayer_rggb8', 4, 4, 4, r'encoding "bayer_rggb8" are not shown; known: rgb8, bgr8'),
        ('rgb8', 0, 4, 0, 'of 0 x 4 pixels is not shown'),
        ('rgb8', 4, 10**9, 12, 'is not shown'),
        ('rgb8', 4, 4, 11, 'does not fit its 48 bytes'),
        ('rgb8', 5, 4, 15, 'does not fit its 48 bytes'),
        ('32FC1', 4, 4, 2**32 - 1, 'does not fit its 48 bytes'),
    ],
)
def test_a_size_that_does_not_fit_is_refused(encoding, width, height, step, text):
    with pytest.raises(ViewerError, match=text):
        picture_of_pixels(encoding, width, height, step, np.zeros(48, 'u1'), is_bigendian=False)


SIZES = st.integers(0, 40) | st.integers(0, 2**32 - 1)


@given(
    st.sampled_from([*ORDERS, '32FC1', '16UC1', 'mono16', 'x']),
    SIZES, SIZES, SIZES, st.binary(max_size=4000), st.booleans(),
)  # fmt: skip
def test_any_picture_is_small_or_refused(encoding, width, height, step, data, is_bigendian):
    octets = np.frombuffer(data, 'u1')
    try:
        found = picture_of_pixels(encoding, width, height, step, octets, is_bigendian=is_bigendian)
    except ViewerError as error:
        assert '\n' not in str(error)
    else:
        assert max(pixels(found).shape) <= MOST_PIXELS


def jpeg(height, width, quality=85):
    noise = np.random.default_rng(0).integers(0, 255, (height, width, 3), 'u1')
    return simplejpeg.encode_jpeg(noise, quality)


def test_a_small_file_is_sent_as_it_came():
    data = jpeg(48, 64)
    found = picture_of_file(data)
    assert (found.data, found.width, found.height) == (data, 64, 48)
    png = b'\x89PNG\r\n\x1a\n' + bytes(8) + b'\0\0\0\x40\0\0\0\x30' + bytes(9)
    found = picture_of_file(png)
    assert (found.format, found.data, found.width, found.height) == ('image/png', png, 64, 48)


@pytest.mark.parametrize('shape', [(960, 1280), (40, 1400)])
def test_a_large_jpeg_is_made_small(shape):
    found = picture_of_file(jpeg(*shape, quality=95))
    assert (found.height, found.width) == shape
    assert max(pixels(found).shape) <= MOST_PIXELS


@pytest.mark.parametrize(
    ('data', 'text'),
    [
        (b'', '0 bytes are neither JPEG nor PNG'),
        (b'RVL\0' * 9, 'are neither JPEG nor PNG: 52 56 4c 00'),
        (jpeg(8, 8)[:40], 'a JPEG cannot be read'),
        (b'\x89PNG\r\n\x1a\n' + bytes(MOST_BYTES), 'is too large for the page'),
    ],
)
def test_a_file_of_another_kind_is_refused(data, text):
    with pytest.raises(ViewerError, match=text):
        picture_of_file(data)


@given(st.integers(0, 600), st.binary(min_size=1, max_size=8))
def test_a_broken_jpeg_is_refused_or_sent(at, noise):
    data = JPEG[:at] + noise + JPEG[at + len(noise) :]
    try:
        assert picture_of_file(data).data
    except ViewerError as error:
        assert '\n' not in str(error)


JPEG = jpeg(16, 16)
