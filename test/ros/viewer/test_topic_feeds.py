# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Topics of any type for the page, with real publishers: whole messages, and numbers of each."""

import asyncio
import json
import struct
import time

from diagnostic_msgs.msg import DiagnosticStatus
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image, JointState, NavSatFix
from std_msgs.msg import Bool, Float64, Header, String
from support.ros_processes import PATIENCE
from support.waiting import until

from amr_description.viewer.backend import Watched
from amr_description.viewer.ros.field_feed import fields_of
from amr_description.viewer.ros.topic_feeds import TopicFeeds

RELIABLE = ReliabilityPolicy.RELIABLE
RECEIVED = 77.0
"""What the feeds are told about when something was received."""


@pytest.fixture(scope='module')
def node():
    rclpy.init(args=[])
    node = Node('topic_feeds')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def feeds(node):
    feeds = TopicFeeds(node, lambda _: RECEIVED)
    yield feeds
    feeds.watch(Watched())


@pytest.fixture
def publisher(node):
    made = []

    def publisher_of(kind, topic, qos=1000):
        made.append(node.create_publisher(kind, topic, qos))
        return made[-1]

    yield publisher_of
    for each in made:
        node.destroy_publisher(each)


def show(feeds, publisher, watched):
    """Watch, and wait until the publisher has a subscription."""
    feeds.watch(watched)
    until(lambda: publisher.get_subscription_count() or feeds.refresh())


def taken(feeds, channel, topic='/a'):
    """Wait for a sample; return its head and what follows."""
    (sample,) = until(lambda: feeds.take({(channel, topic)}))
    assert (sample.channel, sample.topic) == (channel, topic)
    return parts_of(sample.frame)


def parts_of(frame):
    end = 4 + struct.unpack_from('<H', frame, 2)[0]
    assert end % 8 == 0
    return json.loads(frame[4:end]), frame[end:]


def columns_of(head, rest):
    return np.frombuffer(rest, '<f8').reshape(1 + len(head['paths']), head['count'])


def of(*paths, topic='/a'):
    return Watched(fields={topic: frozenset(paths)})


def test_a_message_comes_whole(feeds, publisher):
    topic = publisher(JointState, '/a')
    show(feeds, topic, Watched(messages=frozenset(['/a'])))
    topic.publish(JointState(name=['<b>'], position=[0.5, float('inf')], effort=[0.0] * 100))
    head, rest = taken(feeds, 'message')
    assert (head['type'], head['message']) == ('message', 'sensor_msgs/msg/JointState')
    message = json.loads(rest)
    assert message['name'] == ['<b>']
    assert message['position'] == [0.5, {'#number': 'Infinity'}]
    assert message['effort'] == {'#length': 100, '#first': [0.0] * 64}


def test_a_large_message_is_made_small(feeds, publisher):
    topic = publisher(Image, '/a')
    show(feeds, topic, Watched(messages=frozenset(['/a'])))
    topic.publish(Image(width=640, data=bytes(640 * 480)))

    async def take():
        end = time.monotonic() + PATIENCE
        while not (found := feeds.take({('message', '/a')})):
            assert time.monotonic() < end
            await asyncio.sleep(0.001)
        return found

    (sample,) = asyncio.run(take())
    head, rest = parts_of(sample.frame)
    assert (head['size'] > 640 * 480, len(rest) < 1000) == (True, True)
    assert json.loads(rest)['data'] == {'#length': 640 * 480, '#first': [0] * 64}


def test_what_was_published_before_is_shown_where_it_is_kept(feeds, publisher):
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher(String, '/a', latched).publish(String(data='a robot'))
    feeds.watch(Watched(messages=frozenset(['/a'])))
    until(lambda: feeds._feeds or feeds.refresh())
    assert json.loads(taken(feeds, 'message')[1]) == {'data': 'a robot'}


def test_of_two_hundred_messages_in_a_burst_none_is_lost(feeds, publisher):
    topic = publisher(Float64, '/a')
    show(feeds, topic, of('data'))
    for number in range(200):
        topic.publish(Float64(data=float(number)))
    values, ends = [], 0
    while len(values) < 200:
        head, rest = taken(feeds, 'values')
        assert head['first'] == ends
        ends += head['count']
        stamps, data = columns_of(head, rest)
        assert set(stamps) == {RECEIVED}
        values += data.tolist()
    assert values == list(range(200))


def test_a_frequent_topic_that_is_kept_is_acknowledged_no_more(feeds, publisher, node):
    """And none of its messages is lost, or comes twice, when that ends."""
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    topic = publisher(Float64, '/a', latched)
    topic.publish(Float64(data=0.0))
    show(feeds, topic, of('data'))

    def is_acknowledged():
        subscriptions = node.get_subscriptions_info_by_topic('/a')
        return any(each.qos_profile.reliability == RELIABLE for each in subscriptions)

    until(lambda: topic.get_subscription_count() == 2)
    assert is_acknowledged()
    values, number = [], 0
    while len(values) <= number or number < 100:
        if len(values) > number:
            number += 1
            topic.publish(Float64(data=float(number)))
            feeds.refresh()
        else:
            values += columns_of(*taken(feeds, 'values'))[1].tolist()
    assert values == list(range(101))
    assert not is_acknowledged()


def test_what_is_kept_of_a_topic_is_plotted_once(feeds, publisher):
    latched = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    topic = publisher(Float64, '/a', latched)
    for number in range(3):
        topic.publish(Float64(data=float(number)))
    show(feeds, topic, of('data'))
    values = []
    while len(values) < 3:
        values += columns_of(*taken(feeds, 'values'))[1].tolist()
    topic.publish(Float64(data=3.0))
    assert columns_of(*taken(feeds, 'values'))[1].tolist() == [3.0]
    assert values == [0.0, 1.0, 2.0]


def test_a_stamp_is_that_of_the_header_if_there_is_one(feeds, publisher):
    topic = publisher(JointState, '/a')
    show(feeds, topic, of('position[1]', 'velocity[0]'))
    first, second = Header(), Header()
    first.stamp.sec, first.stamp.nanosec = 3, 500_000_000
    topic.publish(JointState(header=first, position=[1.0, 2.0], velocity=[9.0]))
    topic.publish(JointState(header=second, position=[1.0]))
    rows = []
    while len(rows) < 2:
        rows += columns_of(*taken(feeds, 'values')).T.tolist()
    assert rows[0] == [3.5, 2.0, 9.0]
    assert rows[1][0] == RECEIVED
    assert np.isnan(rows[1][1:]).all()


def test_a_path_that_leads_nowhere_is_said_beside_those_that_do(feeds, publisher):
    topic = publisher(Float64, '/a')
    show(feeds, topic, of('data', 'dat', 'data.x'))
    topic.publish(Float64(data=1.5))
    head, rest = taken(feeds, 'values')
    assert head['paths'] == ['dat', 'data', 'data.x']
    assert head['faults'].keys() == {'dat', 'data.x'}
    assert 'did you mean data?' in head['faults']['dat']
    stamps, *columns = columns_of(head, rest).tolist()
    assert columns[1] == [1.5]
    assert (stamps, str(columns)) == ([RECEIVED], '[[nan], [1.5], [nan]]')


def test_states_have_the_names_of_their_values(feeds, publisher):
    topic = publisher(DiagnosticStatus, '/a')
    show(feeds, topic, of('level', 'message', 'values[0].key'))
    for level, text in ((b'\1', 'low'), (b'\0', 'full'), (b'\1', 'low')):
        topic.publish(DiagnosticStatus(level=level, message=text))
    found = []
    while len(found) < 3:
        head, rest = taken(feeds, 'values')
        found += columns_of(head, rest)[1:3].T.tolist()
    assert found == [[1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]
    assert head['names'] == {
        'level': {'0': 'OK', '1': 'WARN', '2': 'ERROR', '3': 'STALE'},
        'message': {'0': 'low', '1': 'full'},
    }
    assert np.isnan(columns_of(head, rest)[3]).all(), 'there is no such element'
    feeds.watch(of('message'))
    topic.publish(DiagnosticStatus(message='full'))
    head, rest = taken(feeds, 'values')
    assert columns_of(head, rest)[1].tolist() == [1.0], 'texts keep their numbers'


@pytest.mark.parametrize(
    ('kind', 'path', 'names'),
    [
        (Bool, 'data', {'0': 'false', '1': 'true'}),
        (Float64, 'data', {}),
        (JointState, 'header.stamp.sec', {}),
        (NavSatFix, 'status.status', {'-2', '-1', '0', '1', '2'}),
        (NavSatFix, 'position_covariance_type', {'0', '1', '2', '3'}),
    ],
)
def test_only_what_is_an_enumeration_has_names(kind, path, names):
    assert {*fields_of(kind, (path,)).names.get(path, ())} == {*names}


def test_paths_change_without_a_gap(feeds, publisher):
    topic = publisher(JointState, '/a')
    show(feeds, topic, of('position[0]'))
    topic.publish(JointState(position=[1.0]))
    head, _ = taken(feeds, 'values')
    assert head['paths'] == ['position[0]']
    feeds.watch(of('position[0]', 'position[1]'))
    topic.publish(JointState(position=[1.0, 2.0]))
    head, rest = taken(feeds, 'values')
    assert (head['first'], head['paths']) == (1, ['position[0]', 'position[1]'])
    assert columns_of(head, rest)[1:].tolist() == [[1.0], [2.0]]


@pytest.mark.parametrize('topic', ['no name', '', '/a//b', '/{x}', '~/a', 'x' * 5000])
def test_what_is_no_topic_is_not_there(feeds, topic):
    feeds.watch(Watched(messages=frozenset([topic]), fields={topic: frozenset(['data'])}))
    assert feeds.take({('message', topic)}) == []


def test_what_is_shown_no_more_is_let_go(feeds, publisher):
    topic = publisher(Float64, '/a')
    show(feeds, topic, of('data'))
    feeds.watch(Watched())
    until(lambda: topic.get_subscription_count() == 0)
