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

from amr_description.ros import cdr_sensors

FRAMES = st.text('laserø_1', max_size=9)
WHOLE = {
    cdr_sensors.read_scan: scan(),
    cdr_sensors.read_cloud: cloud(),
    cdr_sensors.read_image: image(),
    cdr_sensors.read_compressed_image: CompressedImage(format='jpeg', data=array('B', b'abc')),
    cdr_sensors.read_range: Range(range=1.5),
    cdr_sensors.read_contacts: gz_contacts(),
    cdr_sensors.read_contacts_state: classic_contacts(),
}


@given(FRAMES, st.lists(st.floats(width=32), max_size=5))
def test_a_scan(frame, ranges):
    found = cdr_sensors.read_scan(serialize_message(scan(frame, ranges)))
    assert found.header == cdr_sensors.Header(3 * 10**9 + 5, frame)
    assert (found.angle_min, found.angle_increment) == (-1.0, 0.5)
    assert (found.range_min, found.range_max) == (0.25, 8.0)
    assert np.array_equal(found.ranges, np.array(ranges, 'f4'), equal_nan=True)


@given(FRAMES, st.binary(max_size=20))
def test_a_cloud_and_pictures(frame, data):
    found = cdr_sensors.read_cloud(serialize_message(cloud(frame, data)))
    assert [(each.name, each.offset, each.datatype) for each in found.fields] == [
        ('x', 0, 7), ('y', 4, 7)
    ]  # fmt: skip
    assert (found.height, found.width, found.point_step, found.row_step) == (1, 1, 8, 8)
    assert found.data.tobytes() == data
    seen = cdr_sensors.read_image(serialize_message(image(frame, data)))
    assert (seen.header.frame, seen.height, seen.width, seen.encoding, seen.step) == (
        frame, 1, 2, 'rgb8', 6
    )  # fmt: skip
    assert seen.data.tobytes() == data
    message = CompressedImage(header=header(frame), format='png', data=array('B', data))
    file = cdr_sensors.read_compressed_image(serialize_message(message))
    assert (file.header.frame, file.format, file.data.tobytes()) == (frame, 'png', data)


def test_a_distance():
    message = Range(
        header=header(), radiation_type=1, field_of_view=0.5, min_range=0.25, max_range=4.0,
        range=math.inf,
    )  # fmt: skip
    found = cdr_sensors.read_range(serialize_message(message))
    assert found == cdr_sensors.RangeData(found.header, 0.5, 0.25, 4.0, math.inf)


@pytest.mark.parametrize(
    ('read', 'message'),
    [
        (cdr_sensors.read_contacts, gz_contacts),
        (cdr_sensors.read_contacts_state, classic_contacts),
    ],
)
@given(FRAMES)
def test_contacts_of_both_gazebos(read, message, frame):
    found = read(serialize_message(message(frame)))
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
    (found, _) = cdr_sensors.read_contacts(serialize_message(message)).contacts
    assert np.isnan(found.normals).all()
    assert found.normals.shape == found.points.shape
    assert math.isnan(found.force)


@pytest.mark.parametrize('read', WHOLE, ids=lambda read: read.__name__)
def test_bytes_that_end_too_early_are_refused(read):
    data = serialize_message(WHOLE[read])
    read(data)
    last = len(data) - 8  # what follows the last field that is read, and padding
    for end in range(last if read is not cdr_sensors.read_scan else last - 8):
        with pytest.raises(ValueError, match='end within|no plain CDR|codec'):
            read(data[:end])


@pytest.mark.parametrize('read', WHOLE, ids=lambda read: read.__name__)
@given(st.integers(0, 400), st.binary(min_size=1, max_size=4))
def test_any_bytes_are_a_message_or_a_value_error(read, at, noise):
    data = serialize_message(WHOLE[read])
    at = min(at, len(data))
    with suppress(ValueError):
        read(data[:at] + noise + data[at + len(noise) :])
