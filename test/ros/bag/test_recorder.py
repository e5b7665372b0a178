# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The recorder in the process of the test: what it subscribes to, and what of it is written."""

from contextlib import contextmanager
from pathlib import Path
import threading
import time

import pytest
from rclpy.clock import ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    qos_profile_system_default,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.serialization import deserialize_message
from rclpy.service_introspection import ServiceIntrospectionState
from rclpy.time import Time
from rosbag2_interfaces.msg import WriteSplitEvent
from rosbag2_interfaces.srv import IsPaused, Pause, Resume, Snapshot, SplitBagfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from std_srvs.srv import SetBool
from support.ros_processes import PATIENCE

from amr_description.bag import metadata
from amr_description.bag.info_text import Contents, info_text
from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.ros import recorder
from amr_description.bag.ros.message_cache import MessageCache
from amr_description.bag.ros.recorder import adapted, Recorder, RecorderOptions
from amr_description.bag.ros.recorder_services import offer_services, split_publisher
from amr_description.bag.storage import BagMessage, OVERHEAD
from amr_description.bag.topic_filter import TopicFilter
from amr_description.cli.session import open_session
from amr_description.errors import BagError
from amr_description.ros.rclpy_internals import take_with_info

LATCHED = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
NAMED = TopicFilter(topics=['/a', '/b'])


class Host:
    """A recorder, who publishes, and the executor of both."""

    def __init__(self, session, folder: Path, options: RecorderOptions) -> None:
        self.session = session
        self.node: Node = session.node
        self.folder = folder
        split = WriterOptions(on_split=split_publisher(self.node))
        self.writer = BagWriter(folder, split)
        self.recorder = Recorder(self.node, self.writer, options)
        offer_services(self.recorder)
        self.recorder.start()

    def until(self, condition) -> None:
        assert self.session.spin(condition, PATIENCE)

    def subscribed(self, *topics: str) -> None:
        def there() -> bool:
            self.recorder.discover()
            return {*topics} <= self.recorder.topics.keys()

        self.until(there)

    def send(self, publisher, *texts: str) -> None:
        """Publish, and wait until the recorder has received it."""
        self.until(lambda: publisher.get_subscription_count() > 0)
        before = self.recorder.messages_received
        for text in texts:
            publisher.publish(String(data=text))
        self.until(lambda: self.recorder.messages_received >= before + len(texts))

    def call(self, kind, name: str):
        client = self.node.create_client(kind, f'{self.node.get_name()}/{name}')
        self.until(client.service_is_ready)
        future = client.call_async(kind.Request())
        self.until(future.done)
        return future.result()


@contextmanager
def hosted(folder: Path, use_sim_time=False, **options):
    options = RecorderOptions(**{'topics': NAMED, 'use_sim_time': use_sim_time, **options})
    with open_session(name='recorder', use_sim_time=use_sim_time) as session:
        host = Host(session, folder, options)
        try:
            yield host
        finally:
            host.recorder.end()
            host.writer.close()


def texts(folder: Path) -> list[str]:
    with BagReader(folder) as reader:
        return [deserialize_message(each.data, String).data for each in reader.messages()]


def test_topics_that_come_later_are_recorded_with_qos_and_hash(tmp_path):
    with hosted(tmp_path / 'bag') as host:
        first = host.node.create_publisher(String, 'a', LATCHED)
        first.publish(String(data='before'))
        host.subscribed('/a')
        assert not host.recorder.is_complete
        host.until(lambda: host.recorder.messages_received == 1)
        second = host.node.create_publisher(String, 'b', BEST_EFFORT)
        host.subscribed('/b')
        assert host.recorder.is_complete
        host.send(second, 'later')
    assert texts(tmp_path / 'bag') == ['before', 'later']
    with BagReader(tmp_path / 'bag') as reader:
        [of_a], [of_b] = (reader.topics[name].offered_qos_profiles for name in ('/a', '/b'))
        assert (of_a.durability, of_a.reliability) == ('transient_local', 'reliable')
        assert (of_b.durability, of_b.reliability) == ('volatile', 'best_effort')
        assert reader.topics['/a'].type_description_hash.startswith('RIHS01_df668c')
        for message in reader.messages():
            assert 0 < message.publish_time <= message.log_time


def test_who_offers_less_later_is_heard(tmp_path):
    with hosted(tmp_path / 'bag') as host:
        host.node.create_publisher(String, 'a', LATCHED)
        host.subscribed('/a')
        late = host.node.create_publisher(String, 'a', BEST_EFFORT)

        def adapted_to_both() -> bool:
            host.recorder.discover()
            return len(host.recorder.topics['/a'].offered_qos_profiles) == 2

        host.until(adapted_to_both)
        host.send(late, 'heard')
    assert texts(tmp_path / 'bag') == ['heard']
    [topic] = metadata.read(tmp_path / 'bag').topics_with_message_count
    assert len(topic.topic_metadata.offered_qos_profiles) == 2


def test_what_waits_in_a_subscription_that_is_replaced_is_recorded(tmp_path, monkeypatch):
    is_held = False

    def take(subscription):
        return None if is_held else take_with_info(subscription)

    monkeypatch.setattr(recorder, 'take_with_info', take)
    with hosted(tmp_path / 'bag', topics=TopicFilter(topics=['/a'])) as host:
        first = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        host.send(first, 'taken')
        is_held = True
        first.publish(String(data='waits'))
        assert first.wait_for_all_acked(Duration(seconds=PATIENCE))
        host.node.create_publisher(String, 'a', BEST_EFFORT)

        def is_replaced() -> bool:
            host.recorder.discover()
            return len(host.recorder.topics['/a'].offered_qos_profiles) == 2

        host.until(is_replaced)
        assert not host.recorder.is_complete
        is_held = False
        host.recorder._waiter.wake()
        host.until(lambda: host.recorder.messages_received == 2)

        def is_alone() -> bool:
            host.recorder.discover()
            return host.node.count_subscribers('/a') == 1

        host.until(is_alone)  # nothing fills the former one for ever
        assert host.recorder.is_complete
    assert texts(tmp_path / 'bag') == ['taken', 'waits']


@pytest.mark.parametrize(('received', 'sent'), [(0, -1), (7, 5)])
def test_times_that_the_middleware_has_not(tmp_path, monkeypatch, received, sent):
    def take(subscription):
        taken = take_with_info(subscription)
        times = {'received_timestamp': received, 'source_timestamp': sent}
        return taken and (taken[0], times)

    monkeypatch.setattr(recorder, 'take_with_info', take)
    before = time.time_ns()
    with hosted(tmp_path / 'bag') as host:
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        host.send(publisher, 'text')
    with BagReader(tmp_path / 'bag') as reader:
        [message] = reader.messages()
    assert message.publish_time == max(0, sent)
    assert message.log_time == received or message.log_time >= before


def test_overridden_qos_is_subscribed_with(tmp_path):
    weaker = QosProfile(reliability='best_effort')
    with hosted(tmp_path / 'bag', overrides={'/a': weaker}) as host:
        host.node.create_publisher(String, 'a', LATCHED)
        host.subscribed('/a')
        [found] = host.node.get_subscriptions_info_by_topic('/a')
        assert found.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT
        assert found.qos_profile.durability is DurabilityPolicy.VOLATILE


@pytest.mark.parametrize(
    ('offered', 'reliability', 'durability'),
    [
        ([LATCHED, LATCHED], 'RELIABLE', 'TRANSIENT_LOCAL'),
        ([LATCHED, QoSProfile(depth=1)], 'RELIABLE', 'VOLATILE'),
        ([LATCHED, BEST_EFFORT], 'BEST_EFFORT', 'VOLATILE'),
        ([], 'RELIABLE', 'VOLATILE'),
    ],
)
def test_qos_is_the_strongest_that_hears_all(offered, reliability, durability):
    found = adapted(offered)
    assert (found.reliability.name, found.durability.name) == (reliability, durability)


@pytest.mark.parametrize(
    ('options', 'expected'),
    [
        ({}, set()),
        ({'include_unpublished_topics': True}, {'/a'}),
        ({'include_unpublished_topics': True, 'ignore_leaf_topics': True}, {'/a'}),
    ],
)
def test_topics_without_publisher(tmp_path, options, expected):
    with hosted(tmp_path / 'bag', **options) as host:
        host.node.create_subscription(String, 'a', print, 1)
        host.until(lambda: '/a' in dict(host.node.get_topic_names_and_types()))
        assert {*host.recorder.discover()} == expected


def test_topics_without_subscription_may_be_left_out(tmp_path):
    with hosted(tmp_path / 'bag', ignore_leaf_topics=True) as host:
        host.node.create_publisher(String, 'a', 1)
        host.node.create_publisher(String, 'b', 1)
        host.node.create_subscription(String, 'b', print, 1)
        host.subscribed('/b')
        assert {*host.recorder.topics} == {'/b'}


def test_hidden_topics_are_named_once(tmp_path, capfd):
    with hosted(tmp_path / 'bag', topics=TopicFilter(topics=['/_a', '/_b', '/c'])) as host:
        for name in ('_a', '_b', 'c'):
            host.node.create_publisher(String, name, 1)
        host.subscribed('/c')
        host.recorder.discover()
        assert {*host.recorder.topics} == {'/c'}
    warning = 'Hidden topics are not recorded. Enable them with --include-hidden-topics'
    assert capfd.readouterr().err.count(warning) == 1


def test_services_pause_resume_and_split(tmp_path):
    with hosted(tmp_path / 'bag', start_paused=True) as host:
        events = []
        host.node.create_subscription(WriteSplitEvent, 'events/write_split', events.append, 1)
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        assert host.call(IsPaused, 'is_paused').paused
        host.call(Resume, 'resume')
        host.send(publisher, 'first')
        host.until(lambda: host.writer.message_count == 1)
        host.call(SplitBagfile, 'split_bagfile')
        host.send(publisher, 'second')
        host.call(Pause, 'pause')
        assert host.call(IsPaused, 'is_paused').paused
        publisher.publish(String(data='dropped'))
        host.until(lambda: events and host.recorder.messages_skipped)
    assert texts(tmp_path / 'bag') == ['first', 'second']
    assert texts(tmp_path / 'bag' / 'bag_1.mcap') == ['second']
    assert events[0].closed_file == str(tmp_path / 'bag' / 'bag_0.mcap')
    assert events[0].opened_file == str(tmp_path / 'bag' / 'bag_1.mcap')
    assert events[0].node_name == '/recorder'


def test_a_topic_is_found_while_the_disk_is_slow(tmp_path, monkeypatch):
    goes_on, in_time = threading.Event(), []
    with hosted(tmp_path / 'bag') as host:
        write = host.writer.write

        def slowly(message):
            in_time.append(goes_on.wait(PATIENCE))
            write(message)

        monkeypatch.setattr(host.writer, 'write', slowly)
        first = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        host.send(first, 'of a')
        second = host.node.create_publisher(String, 'b', 10)
        host.subscribed('/b')
        host.send(second, 'of b')
        goes_on.set()
    assert in_time == [True, True]
    assert texts(tmp_path / 'bag') == ['of a', 'of b']


def test_calls_of_a_service_are_recorded(tmp_path):
    with hosted(tmp_path / 'bag', topics=TopicFilter(services=['/add'])) as host:
        node = host.node
        service = node.create_service(SetBool, 'add', lambda _, response: response)
        service.configure_introspection(
            node.get_clock(), qos_profile_system_default, ServiceIntrospectionState.METADATA
        )
        host.subscribed('/add/_service_event')
        host.until(lambda: node.get_subscriptions_info_by_topic('/add/_service_event'))
        client = node.create_client(SetBool, 'add')
        host.until(client.service_is_ready)
        future = client.call_async(SetBool.Request())
        host.until(lambda: future.done() and host.recorder.messages_received == 2)
    contents = Contents()
    with BagReader(tmp_path / 'bag') as reader:
        for message in reader.messages():
            contents.add(message)
        assert contents.events == {'/add/_service_event': [0, 1, 1, 0]}  # as the server tells
        assert 'SetBool_Request[<=1] request' in reader.schemas['std_srvs/srv/SetBool_Event']
        assert 'Request Count: 1 | Response Count: 1' in info_text(reader.metadata, 0, contents)


def test_snapshot_writes_what_is_in_memory_and_no_more(tmp_path):
    with hosted(tmp_path / 'bag', snapshot_mode=True, max_cache_size=40) as host:
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        host.send(publisher, *(f'text {n} of some length' for n in range(5)))
        assert host.call(Snapshot, 'snapshot').success
        host.send(publisher, 'after')
    assert texts(tmp_path / 'bag') == ['text 4 of some length']


def test_simulated_times_and_a_new_file_when_they_jump_back(tmp_path):
    with hosted(tmp_path / 'bag', use_sim_time=True) as host:
        clock = host.node.create_publisher(Clock, '/clock', 10)
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        host.until(lambda: publisher.get_subscription_count() and clock.get_subscription_count())
        publisher.publish(String(data='before there was a time'))
        host.until(lambda: host.recorder.messages_skipped == 1)
        for seconds in (5, 7, 2):
            time = Time(seconds=seconds, clock_type=ClockType.ROS_TIME)
            clock.publish(Clock(clock=time.to_msg()))
            host.until(lambda time=time: host.node.get_clock().now() == time)
            host.send(publisher, f'at {seconds}')
    with BagReader(tmp_path / 'bag') as reader:
        times = [each.log_time // 10**9 for each in reader.messages()]
        assert times == [5, 7, 2]  # run after run
    assert texts(tmp_path / 'bag' / 'bag_0.mcap') == ['at 5', 'at 7']
    assert texts(tmp_path / 'bag' / 'bag_1.mcap') == ['at 2']


@pytest.mark.parametrize('cache', [0, 1000])
def test_disk_that_is_full_ends_the_recording(tmp_path, monkeypatch, cache):
    def no_room(*_):
        raise BagError('cannot write: No space left on device')

    with hosted(tmp_path / 'bag', max_cache_size=cache) as host:
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        monkeypatch.setattr(host.writer, 'write', no_room)
        host.send(publisher, 'text')
        host.until(lambda: host.recorder.error)


@pytest.mark.parametrize('method', ['_take', '_write'])
def test_a_fault_of_the_program_ends_the_recording(tmp_path, monkeypatch, capsys, method):
    def fails(*_):
        raise RuntimeError('of the program')

    monkeypatch.setattr(Recorder, method, fails)
    with hosted(tmp_path / 'bag') as host:
        publisher = host.node.create_publisher(String, 'a', 10)
        host.subscribed('/a')
        publisher.publish(String(data='text'))
        host.until(lambda: host.recorder.error)
        assert str(host.recorder.error) == 'the recorder failed: RuntimeError: of the program'
    assert 'Traceback' in capsys.readouterr().err


def test_types_that_are_not_here_are_said_once(tmp_path):
    with hosted(tmp_path / 'bag') as host:
        host.recorder._subscribe('/a', 'no_msgs/msg/Such', [])
        assert '/a' not in host.recorder.topics
        assert '/a' in host.recorder._refused


def test_cache_loses_what_has_no_room_and_counts_it():
    cache = MessageCache(25 + 2 * OVERHEAD)  # room for two
    for n in range(4):
        cache.add(BagMessage('/a', b'x' * 10, n, n))
    assert [each.log_time for each in cache.take()] == [0, 1]
    assert cache.lost == {'/a': 2}
    cache.add(BagMessage('/a', b'x' * 1000, 9, 9))  # one that is larger than all
    assert len(cache.take()) == 1


def test_cache_that_keeps_the_latest():
    cache = MessageCache(25 + 2 * OVERHEAD, keep_latest=True)
    for n in range(4):
        cache.add(BagMessage('/a', b'x' * 10, n, n))
    assert [each.log_time for each in cache.take()] == [2, 3]
    assert cache.lost == {}
    cache.close()
    assert cache.wait() is None
