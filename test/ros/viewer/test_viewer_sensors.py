# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sensors for the page: heard while they are shown, sampled when a page can take one."""

import json
import struct

from hypothesis import given, strategies as st
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from support.sensor_messages import classic_contacts, cloud, gz_contacts, header, image, scan

from amr_description.clock import NANOSECONDS
from amr_description.ros.message_types import type_name
from amr_description.ros.polled_topic import NumberedMessage
from amr_description.sensor_msgs_py.point_cloud2 import create_cloud_xyz32
from amr_description.viewer.backend import Watched
from amr_description.viewer.graph import SENSORS
from amr_description.viewer.protocol import SensorInfo
from amr_description.viewer.ros import sensors, topic_feeds
from amr_description.viewer.ros.sensor_samples import CONVERTERS, MOST_RAYS, sample_of
from amr_description.viewer.ros.topic_feeds import TopicFeeds
from amr_description.viewer.ros.topic_rate import Rate

SCAN = SensorInfo('/scan', '/', 'scan', 'sensor_msgs/msg/LaserScan')
CAMERA = SensorInfo('/image', '/', 'picture', 'sensor_msgs/msg/Image')
MS = NANOSECONDS // 1000


class Topic:
    """Instead of a PolledTopic."""

    def __init__(self, _node, _type, name, _read):
        self.name = name
        self.is_open = True
        self.messages = []
        self.taken = 0

    def publish(self, message):
        data = serialize_message(message)
        self.messages = [NumberedMessage(data, 0, self.taken + 1)]

    def take_numbered(self):
        self.taken += 1
        return self.messages.pop() if self.messages else None

    def destroy(self):
        self.is_open = False


@pytest.fixture
def opened(monkeypatch):
    """All topics that were subscribed to."""
    topics = []

    def subscribe(*arguments):
        topics.append(Topic(*arguments))
        return topics[-1]

    monkeypatch.setattr(sensors, 'PolledTopic', subscribe)
    return topics


@pytest.fixture
def feeds():
    return TopicFeeds(None, float)


def head_of(frame):
    size = struct.unpack_from('<H', frame, 2)[0]
    return json.loads(frame[4 : 4 + size])


def rest_of(frame):
    return frame[4 + struct.unpack_from('<H', frame, 2)[0] :]


def test_what_is_not_shown_or_not_there_is_not_heard(feeds, opened):
    feeds.watch(Watched(sensors=frozenset({'/scan', '/gone'})))
    assert opened == []
    feeds.find([SCAN, CAMERA])
    assert [each.name for each in opened] == ['/scan']
    feeds.watch(Watched(sensors=frozenset()))
    assert [each.is_open for each in opened] == [False]
    assert feeds.take({('sensor', '/scan')}) == []


def test_a_topic_that_goes_is_let_go_and_one_of_another_type_is_heard_anew(feeds, opened):
    feeds.watch(Watched(sensors=frozenset({'/scan'})))
    feeds.find([SCAN])
    feeds.find([SCAN, CAMERA])
    feeds.find([SensorInfo('/scan', '/', 'range', 'sensor_msgs/msg/Range')])
    feeds.find([])
    assert [each.is_open for each in opened] == [False, False]


def test_no_message_is_taken_for_pages_that_cannot_take_it(feeds, opened):
    feeds.watch(Watched(sensors=frozenset({'/scan'})))
    feeds.find([SCAN])
    opened[0].publish(scan())
    assert feeds.take(set()) == []
    assert opened[0].taken == 0
    (sample,) = feeds.take({('sensor', '/scan')})
    assert sample.topic == '/scan'
    assert head_of(sample.frame)['type'] == 'scan'


def test_samples_come_at_a_bounded_rate(opened):
    feed = sensors.SensorFeed(None, SCAN)
    (topic,) = opened
    sent = []
    for tick in range(240):  # of 240 a second
        topic.publish(scan())
        sent.append(feed.take(100.0 + tick / 240, is_wanted=True))
    assert 29 <= sum(each is not None for each in sent) <= 32


def test_what_is_shown_whole_comes_less_often(feeds, opened, monkeypatch):
    feeds.watch(Watched(sensors=frozenset({'/scan'}), whole=frozenset({'/scan'})))
    feeds.find([SCAN])
    (topic,) = opened
    sent = 0
    for tick in range(240):
        monkeypatch.setattr(topic_feeds.time, 'monotonic', lambda tick=tick: 100.0 + tick / 240)
        topic.publish(scan())
        sent += len(feeds.take({('sensor', '/scan')}))
    assert 2 <= sent <= 3


@pytest.mark.parametrize(('is_whole', 'expected'), [(False, 15_000), (True, 30_000)])
def test_a_cloud_is_sent_in_part_or_whole(is_whole, expected):
    points = create_cloud_xyz32(header(), np.ones((30_000, 3)))
    data, kind = serialize_message(points), 'sensor_msgs/msg/PointCloud2'
    frame = sample_of(kind, data, '/points', None, is_whole=is_whole)
    assert head_of(frame)['count'] == 30_000
    assert len(rest_of(frame)) == 12 * expected


def test_a_message_package_that_is_not_there_is_said_once(feeds):
    feeds.watch(Watched(sensors=frozenset({'/b'})))
    feeds.find([SensorInfo('/b', '/', 'contacts', 'no_such_msgs/msg/Contacts')])
    (sample,) = feeds.take({('sensor', '/b')})
    assert head_of(sample.frame)['type'] == 'unreadable'
    assert "there is no package 'no_such_msgs'" in head_of(sample.frame)['text']
    assert feeds.take({('sensor', '/b')}) == []


@pytest.mark.parametrize('is_numbered', [True, False])
def test_the_rate_is_that_of_the_topic(is_numbered):
    """As far as messages are numbered, whichever of them were taken."""
    every = 4 if is_numbered else 1
    rate = Rate()
    assert rate.value is None
    for number in range(0, 200, every):
        rate.add(NumberedMessage(b'', number * 20 * MS, number + 1 if is_numbered else None))
    assert rate.value == pytest.approx(50.0)
    for number in range(1, 100):  # another publisher, which begins anew
        rate.add(NumberedMessage(b'', (4000 + 100 * number) * MS, number if is_numbered else None))
    assert rate.value == pytest.approx(10.0)


def test_messages_without_numbers_are_counted_as_they_are_taken():
    rate = Rate()
    for poll in range(1, 6):
        rate.add(NumberedMessage(b'', 500 * poll * MS, None), count=20)
    assert rate.value == pytest.approx(40.0)


def test_every_type_that_is_found_has_a_converter():
    assert CONVERTERS.keys() == SENSORS.keys()


@pytest.mark.parametrize(
    ('message', 'kind'),
    [(scan(), 'scan'), (gz_contacts(), 'contacts'), (classic_contacts(), 'contacts')],
)
def test_a_sample_says_where_it_is_from(message, kind):
    head = head_of(sample_of(type_name(type(message)), serialize_message(message), '/a', 9.5))
    frame = 'world' if 'ros_gz' in type_name(type(message)) else 'laser'
    assert head['type'] == kind
    assert head['origin'] == {'topic': '/a', 'frame': frame, 'stamp': 3.000000005, 'rate': 9.5}


def test_the_ranges_of_a_scan_are_what_was_published():
    ranges = [1.0, np.inf, np.nan, 3.5]
    frame = sample_of(SCAN.message, serialize_message(scan(ranges=ranges)), '/scan', None)
    found = np.frombuffer(rest_of(frame), '<f4')
    assert np.array_equal(found, np.array(ranges, 'f4'), equal_nan=True)


def test_a_scan_of_a_million_rays_is_thinned_in_its_angles():
    frame = sample_of(SCAN.message, serialize_message(scan(ranges=range(100_001))), '/scan', None)
    found = np.frombuffer(rest_of(frame), '<f4')
    head = head_of(frame)
    assert len(found) <= MOST_RAYS
    assert head['count'] == 100_001
    assert np.allclose(found * 0.5, np.arange(len(found)) * head['angle_increment'])


def test_the_places_of_contacts_follow():
    frame = sample_of(
        'ros_gz_interfaces/msg/Contacts', serialize_message(gz_contacts()), '/b', None
    )
    (first, _) = head_of(frame)['contacts']
    assert first == {'first': 'bumper', 'second': 'a wall', 'points': 2, 'force': 6.0}
    found = np.frombuffer(rest_of(frame), '<f4').reshape(-1, 6)
    assert found[:2].tolist() == [[1, 2, 3, 0, 0, 1], [4, 5, 6, 0, 0, 1]]
    assert len(found) == 4


def test_what_cannot_be_shown_says_why_in_one_line():
    message = image()
    message.encoding = 'bayer\n'
    head = head_of(sample_of(CAMERA.message, serialize_message(message), '/image', None))
    assert (head['type'], '\n' in head['text']) == ('unreadable', False)
    assert 'are not shown; known: rgb8' in head['text']
    message = scan()
    message.angle_increment = float('nan')
    head = head_of(sample_of(SCAN.message, serialize_message(message), '/scan', None))
    assert (head['type'], head['text']) == (
        'unreadable',
        'a scan begins at -1.0 rad, every nan rad',
    )


WHOLE = [scan(), image(), cloud(), gz_contacts(), classic_contacts()]


@pytest.mark.parametrize('message', WHOLE, ids=lambda each: type(each).__name__)
@given(st.integers(0, 400), st.binary(min_size=1, max_size=6))
def test_any_bytes_become_a_sample(message, at, noise):
    data = serialize_message(message)
    at = min(at, len(data))
    frame = sample_of(type_name(type(message)), data[:at] + noise + data[at + len(noise) :], '', 1)
    assert frame[0] == 2
    head = head_of(frame)
    assert head['type'] in ('scan', 'picture', 'cloud', 'contacts', 'unreadable')
    assert not head.get('text', '').startswith('the viewer failed')
