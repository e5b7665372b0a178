# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes of messages of sensors, read without rclpy: as rclpy itself wrote them."""

from array import array
from contextlib import suppress
import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from sensor_msgs.msg import CompressedImage, Range
from support.sensor_messages import classic_contacts, cloud, gz_contacts, header, image, scan

from amr_description.ros import readers

FRAMES = st.text('laserø_1', max_size=9)
WHOLE = {
    readers.SCAN: scan(),
    readers.CLOUD: cloud(),
    readers.IMAGE: image(),
    readers.COMPRESSED_IMAGE: CompressedImage(format='jpeg', data=array('B', b'abc')),
    readers.RANGE: Range(range=1.5),
    readers.CONTACTS: gz_contacts(),
    readers.CONTACTS_STATE: classic_contacts(),
}


@given(FRAMES, st.lists(st.floats(width=32), max_size=5))
def test_a_scan(frame, ranges):
    found = readers.SCAN.read(serialize_message(scan(frame, ranges)))
    assert found.header == readers.Header(3 * 10**9 + 5, frame)
    assert (found.angle_min, found.angle_increment) == (-1.0, 0.5)
    assert (found.range_min, found.range_max) == (0.25, 8.0)
    assert np.array_equal(found.ranges, np.array(ranges, 'f4'), equal_nan=True)


@given(FRAMES, st.binary(max_size=20))
def test_a_cloud_and_pictures(frame, data):
    found = readers.CLOUD.read(serialize_message(cloud(frame, data)))
    assert [(each.name, each.offset, each.datatype) for each in found.fields] == [
        ('x', 0, 7), ('y', 4, 7)
    ]  # fmt: skip
    assert (found.height, found.width, found.point_step, found.row_step) == (1, 1, 8, 8)
    assert found.data.tobytes() == data
    seen = readers.IMAGE.read(serialize_message(image(frame, data)))
    assert (seen.header.frame, seen.height, seen.width, seen.encoding, seen.step) == (
        frame, 1, 2, 'rgb8', 6
    )  # fmt: skip
    assert seen.data.tobytes() == data
    message = CompressedImage(header=header(frame), format='png', data=array('B', data))
    file = readers.COMPRESSED_IMAGE.read(serialize_message(message))
    assert (file.header.frame, file.format, file.data.tobytes()) == (frame, 'png', data)


def test_a_distance():
    message = Range(
        header=header(), radiation_type=1, field_of_view=0.5, min_range=0.25, max_range=4.0,
        range=math.inf,
    )  # fmt: skip
    found = readers.RANGE.read(serialize_message(message))
    assert found == readers.RangeData(found.header, 0.5, 0.25, 4.0, math.inf)


@pytest.mark.parametrize(
    ('row', 'message'),
    [
        (readers.CONTACTS, gz_contacts),
        (readers.CONTACTS_STATE, classic_contacts),
    ],
)
@given(FRAMES)
def test_contacts_of_both_gazebos(row, message, frame):
    found = row.read(serialize_message(message(frame)))
    assert found.header.frame == frame
    for each in found.contacts:
        assert (each.first, each.second, each.force) == ('bumper', 'a wall', 6.0)
        assert each.points.tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
        assert each.normals.tolist() == [[0.0, 0.0, 1.0]] * 2
    assert len(found.contacts) == 2


def test_contacts_without_force_or_normals_are_contacts():
    message = gz_contacts()
    for each in message.contacts:
        each.normals, each.wrenches = [], []
    (found, _) = readers.CONTACTS.read(serialize_message(message)).contacts
    assert np.isnan(found.normals).all()
    assert found.normals.shape == found.points.shape
    assert math.isnan(found.force)


@pytest.mark.parametrize('row', WHOLE, ids=lambda row: row.type)
def test_bytes_that_end_too_early_are_refused(row):
    read, data = row.reader(), serialize_message(WHOLE[row])
    read(data)
    unread = {readers.SCAN: 16, readers.CONTACTS: 80}  # behind the last part that is read
    for end in range(len(data) - unread.get(row, 8)):
        with pytest.raises(ValueError, match='end within|no plain CDR|codec|cannot have'):
            read(data[:end])


@pytest.mark.parametrize('row', WHOLE, ids=lambda row: row.type)
@given(st.integers(0, 400), st.binary(min_size=1, max_size=4))
def test_any_bytes_are_a_message_or_a_value_error(row, at, noise):
    read, data = row.reader(), serialize_message(WHOLE[row])
    at = min(at, len(data))
    with suppress(ValueError):
        read(data[:at] + noise + data[at + len(noise) :])
