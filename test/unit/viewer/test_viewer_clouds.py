# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Clouds for the page: their points, thinned, and their colours, whatever the layout."""

from dataclasses import dataclass

from hypothesis import given, strategies as st
import numpy as np
import pytest

from amr_description.errors import ViewerError
from amr_description.viewer.clouds import thinned
from amr_description.viewer.samples import MOST_POINTS


@dataclass
class Field:
    name: str
    offset: int
    datatype: int


XYZ = [Field(name, 4 * at, 7) for at, name in enumerate('xyz')]


def cloud(points, fields=(), columns=(), *, order='<'):
    """A cloud of points, with more columns of 4 bytes after x, y, z."""
    parts = [np.asarray(points, f'{order}f4').view('u1').reshape(-1, 12)]
    parts += [np.asarray(each).view('u1').reshape(-1, 4) for each in columns]
    data = np.hstack(parts)
    return thinned(
        len(data),
        data.shape[1],
        [*XYZ, *fields],
        data.ravel(),
        is_bigendian=order == '>',
    )


@pytest.mark.parametrize('order', '<>')
def test_points_are_those_of_the_message_without_those_that_are_none(order):
    points = [[1.0, 2.0, 3.0], [np.nan, 0.0, 0.0], [-1.0, 0.5, np.inf], [0.0, 0.0, -7.0]]
    found = cloud(points, order=order)
    assert found.points.tolist() == [points[0], points[3]]
    assert (found.count, found.colouring) == (4, 'none')
    assert found.points.dtype == np.dtype('<f4')


def test_a_large_cloud_is_thinned_evenly():
    count = 3 * MOST_POINTS + 1
    points = np.zeros((count, 3))
    points[:, 0] = np.arange(count)
    found = cloud(points)
    assert found.count == count
    assert MOST_POINTS / 2 < len(found.points) <= MOST_POINTS
    assert np.ptp(np.diff(found.points[:, 0])) == 0


@pytest.mark.parametrize(('order', 'name'), [('<', 'rgb'), ('>', 'rgb'), ('<', 'rgba')])
def test_a_packed_colour_is_red_green_blue(order, name):
    packed = np.array([0xFF102030, 0x00405060], f'{order}u4')
    found = cloud(np.zeros((2, 3)), [Field(name, 12, 7)], [packed], order=order)
    assert found.colouring == 'rgb'
    assert found.colours.tolist() == [[0x10, 0x20, 0x30], [0x40, 0x50, 0x60]]


def test_an_intensity_has_its_range_and_one_that_says_nothing_is_left_out():
    field = Field('intensity', 12, 7)
    found = cloud(np.zeros((3, 3)), [field], [np.array([1.0, 5.0, np.nan], '<f4')])
    assert (found.colouring, found.low, found.high) == ('intensity', 0.0, 5.0)
    assert found.colours.tolist() == [1.0, 5.0, 0.0]
    assert cloud(np.zeros((3, 3)), [field], [np.ones(3, '<f4')]).colouring == 'none'


def test_doubles_and_whole_numbers_are_coordinates_too():
    record = np.dtype([('x', '<f8'), ('y', '<i2'), ('z', '<f4')])
    data = np.array([(1.5, -2, 3.0)], record)
    fields = [Field('z', 10, 7), Field('x', 0, 8), Field('y', 8, 3)]
    assert thinned(1, 14, fields, data.view('u1')).points.tolist() == [[1.5, -2.0, 3.0]]


@pytest.mark.parametrize(
    ('count', 'step', 'fields', 'text'),
    [
        (3, 12, XYZ, 'a cloud of 3 points of 12 bytes does not fit its 24 bytes'),
        (2**64, 12, XYZ, 'does not fit'),
        (1, 0, XYZ, 'does not fit'),
        (2, 12, XYZ[:2], r'no x, y, z; its fields: x, y$'),
        (2, 12, [], r'its fields: none$'),
        (2, 8, XYZ, "field 'z' of a cloud, at byte 8, is outside its points of 8 bytes"),
        (2, 12, [*XYZ[:2], Field('z', 8, 99)], "field 'z' of a cloud is of no known type: 99"),
    ],
)
def test_a_cloud_that_does_not_fit_is_refused(count, step, fields, text):
    with pytest.raises(ViewerError, match=text):
        thinned(count, step, fields, np.zeros(24, 'u1'))


def test_a_cloud_without_points_is_one():
    assert thinned(0, 12, XYZ, np.zeros(0, 'u1')).points.shape == (0, 3)


FIELDS = st.builds(
    Field,
    st.sampled_from(['x', 'y', 'z', 'rgb', 'intensity']),
    st.integers(0, 20) | st.integers(0, 2**32 - 1),
    st.integers(0, 9),
)


@given(
    st.integers(0, 30), st.integers(0, 30), st.lists(FIELDS, max_size=4), st.binary(max_size=600),
    st.booleans(),
)  # fmt: skip
def test_any_cloud_is_thinned_or_refused(count, step, fields, data, is_bigendian):
    octets = np.frombuffer(data, 'u1')
    try:
        found = thinned(count, step, [*XYZ, *fields], octets, is_bigendian=is_bigendian)
    except ViewerError as error:
        assert '\n' not in str(error)
    else:
        assert np.isfinite(found.points).all()
        assert found.colouring == 'none' or len(found.colours) == len(found.points)
