# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The filters of message_filters: caches and synchronizers, and their subscriber over real DDS."""

from builtin_interfaces.msg import Time as Stamp
from geometry_msgs.msg import PointStamped
from hypothesis import given, strategies as st
import pytest
import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from std_msgs.msg import Header, String

from amr_description.message_filters import (
    ApproximateTimeSynchronizer,
    Cache,
    SimpleFilter,
    Subscriber,
    TimeSynchronizer,
)
from amr_description.ros.service_calls import wait_until

PATIENCE = 30.0  # s
MS = 1_000_000  # ns


def message(ms, x=0.0):
    """A message with a stamp in milliseconds."""
    made = PointStamped(header=Header(stamp=Stamp(sec=ms // 1000, nanosec=ms % 1000 * MS)))
    made.point.x = float(x)
    return made


def stamp_of(made):
    return made.header.stamp.sec * 1000 + made.header.stamp.nanosec // MS


def at(ms):
    return Time.from_msg(message(ms).header.stamp)


class Heard(list):
    """What a filter gives: the stamps of each set, in milliseconds."""

    def __init__(self, source):
        super().__init__()
        source.registerCallback(lambda *each: self.append(tuple(map(stamp_of, each))))


def inputs(count):
    return [SimpleFilter() for _ in range(count)]


def test_callbacks_get_the_output_and_what_they_were_registered_with():
    source, heard = SimpleFilter(), []
    assert source.registerCallback(lambda *each: heard.append(each), 'mine') == 0
    assert source.registerCallback(lambda *each: heard.append(each)) == 1
    source.signalMessage(1, 2)
    assert heard == [(1, 2, 'mine'), (1, 2)]


@pytest.fixture
def node():
    rclpy.init(args=[])
    made = rclpy.create_node('filters')
    yield made
    rclpy.try_shutdown()


def test_a_subscriber_is_a_subscription_and_a_filter(node):
    subscriber = Subscriber(node, String, 'words')
    assert (subscriber.getTopic(), subscriber.topic_name) == ('words', '/words')
    assert subscriber.qos_profile.depth == 10
    heard = []
    subscriber.registerCallback(heard.append)
    publisher = node.create_publisher(String, 'words', 10)
    assert wait_until(node, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE)
    publisher.publish(String(data='hello'))
    assert wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == [String(data='hello')]


def test_a_subscriber_takes_what_create_subscription_takes(node):
    qos = QoSProfile(depth=3, reliability=ReliabilityPolicy.BEST_EFFORT)
    subscriber = Subscriber(node, String, 'words', qos_profile=qos, raw=True)
    assert (subscriber.qos_profile.depth, subscriber.raw) == (3, True)
    assert subscriber.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    with pytest.raises(AttributeError, match='nothing_of_the_kind'):
        _ = subscriber.nothing_of_the_kind


def test_a_cache_keeps_the_last_and_hands_all_on():
    source = SimpleFilter()
    cache = Cache(source, cache_size=3)
    heard = Heard(cache)
    assert cache.getLast() is cache.getLastestTime() is cache.getOldestTime() is None
    for ms in (10, 20, 30, 40):
        source.signalMessage(message(ms))
    assert heard == [(10,), (20,), (30,), (40,)]
    assert [stamp_of(each) for each in cache.getInterval(at(0), at(100))] == [20, 30, 40]
    assert [stamp_of(each) for each in cache.getInterval(at(20), at(30))] == [20, 30]
    assert (cache.getOldestTime(), cache.getLastestTime()) == (at(20), at(40))
    assert stamp_of(cache.getLast()) == 40


@pytest.mark.parametrize(
    ('asked', 'before', 'after'), [(15, None, 20), (20, 20, 20), (25, 20, 30), (41, 40, None)]
)
def test_a_cache_is_asked_by_time(asked, before, after):
    source = SimpleFilter()
    cache = Cache(source, 3)
    for ms in (20, 30, 40):
        source.signalMessage(message(ms))
    for found, wanted in (
        (cache.getElemBeforeTime(at(asked)), before),
        (cache.getElemAfterTime(at(asked)), after),
    ):
        assert (found and stamp_of(found)) == wanted


def test_a_cache_refuses_an_interval_that_ends_before_it_begins():
    with pytest.raises(AssertionError, match='is after to_stamp'):
        Cache(SimpleFilter()).getInterval(at(2), at(1))


def synchronizer_of(source, **options):
    return ApproximateTimeSynchronizer([source], queue_size=1, slop=1.0, **options)


@pytest.mark.parametrize('make', [Cache, synchronizer_of])
def test_a_message_without_stamp_is_dropped_unless_it_may_come(make, capfd):
    source, heard = SimpleFilter(), []
    make(source).registerCallback(heard.append)
    source.signalMessage(String(data='no header'))
    assert heard == []
    assert 'String has no header.stamp: the message is dropped' in capfd.readouterr().err
    make(source, allow_headerless=True).registerCallback(heard.append)
    source.signalMessage(String(data='no header'))
    assert heard == [String(data='no header')]


@pytest.mark.parametrize('kind', [TimeSynchronizer, ApproximateTimeSynchronizer])
def test_a_message_with_a_negative_stamp_is_dropped_with_a_warning(kind, capfd):
    (source,) = inputs(1)
    got = []
    more = {'slop': 0.1} if kind is ApproximateTimeSynchronizer else {}
    kind([source], 5, **more).registerCallback(got.append)
    bad = message(0)
    bad.header.stamp.sec = -1
    source.signalMessage(bad)
    source.signalMessage(message(1))
    assert got == [message(1)]
    assert 'PointStamped has the stamp -1 s: the message is dropped' in capfd.readouterr().err


def test_exact_sets_come_in_the_order_of_the_filters_and_each_once():
    left, right = inputs(2)
    heard = []
    TimeSynchronizer([left, right], 10).registerCallback(
        lambda a, b: heard.append((a.point.x, b.point.x))
    )
    right.signalMessage(message(10, 2))
    right.signalMessage(message(20, 4))
    left.signalMessage(message(20, 3))
    left.signalMessage(message(15, 9))
    left.signalMessage(message(10, 1))
    left.signalMessage(message(10, 1))
    assert heard == [(3, 4), (1, 2)]


def test_exact_sets_of_messages_that_were_dropped_do_not_come():
    left, right = inputs(2)
    heard = Heard(TimeSynchronizer([left, right], queue_size=2))
    for ms in (10, 20, 30):
        left.signalMessage(message(ms))
    for ms in (10, 20, 30):
        right.signalMessage(message(ms))
    assert heard == [(20, 20), (30, 30)]


def test_the_closest_messages_make_a_set():
    left, right = inputs(2)
    heard = Heard(ApproximateTimeSynchronizer([left, right], 10, slop=0.05))
    for ms in (100, 130, 160):
        right.signalMessage(message(ms))
    left.signalMessage(message(135))
    assert heard == [(135, 130)]
    left.signalMessage(message(135))
    assert heard[1:] == [(135, 160)]


@pytest.mark.parametrize(('apart', 'sets'), [(49, 1), (50, 0), (51, 0)])
def test_stamps_of_a_set_differ_by_less_than_the_slop(apart, sets):
    left, right = inputs(2)
    heard = Heard(ApproximateTimeSynchronizer([left, right], 10, 0.05))
    left.signalMessage(message(100))
    right.signalMessage(message(100 + apart))
    assert len(heard) == sets


def test_all_stamps_of_a_set_are_close_to_each_other_not_to_the_last_alone():
    first, second, third = inputs(3)
    heard = Heard(ApproximateTimeSynchronizer([first, second, third], 10, 0.05))
    first.signalMessage(message(100))
    second.signalMessage(message(160))
    third.signalMessage(message(130))
    assert heard == []
    second.signalMessage(message(140))
    assert heard == [(100, 140, 130)]


@pytest.mark.parametrize(
    ('kind', 'more'), [(TimeSynchronizer, {}), (ApproximateTimeSynchronizer, {'slop': 1})]
)
def test_a_callback_that_raises_or_feeds_the_synchronizer_does_not_lock_it(kind, more):
    left, right = inputs(2)
    synchronizer = kind([left, right], queue_size=10, **more)
    heard = Heard(synchronizer)

    def feed(message_of_left, _):
        if stamp_of(message_of_left) == 1000:
            left.signalMessage(message(9000))
            right.signalMessage(message(9000))
            raise ValueError('of the callback')

    synchronizer.registerCallback(feed)
    left.signalMessage(message(1000))
    with pytest.raises(ValueError, match='of the callback'):
        right.signalMessage(message(1000))
    assert heard == [(1000, 1000), (9000, 9000)]
    left.signalMessage(message(5000))
    right.signalMessage(message(5000))
    assert heard[2:] == [(5000, 5000)]


@given(
    st.lists(st.tuples(st.integers(0, 2), st.integers(0, 300)), max_size=40),
    st.integers(1, 60),
    st.integers(1, 8),
)
def test_every_set_is_close_and_every_message_in_one_set_at_most(arrivals, slop, queue_size):
    sources = inputs(3)
    synchronizer = ApproximateTimeSynchronizer(sources, queue_size, slop / 1000)
    sets = []
    synchronizer.registerCallback(lambda *each: sets.append(each))
    for index, ms in arrivals:
        sources[index].signalMessage(message(ms))
        assert all(len(queue) <= queue_size for queue in synchronizer.queues)
    for each in sets:
        stamps = list(map(stamp_of, each))
        assert max(stamps) - min(stamps) < slop
    used = [id(each) for one in sets for each in one]
    assert len(used) == len(set(used))


@given(st.lists(st.tuples(st.integers(0, 1), st.integers(0, 9)), max_size=40))
def test_with_room_for_all_exact_sets_are_the_stamps_that_both_had(arrivals):
    sources = inputs(2)
    heard = Heard(TimeSynchronizer(sources, 100))
    waiting = (set(), set())
    wanted = []
    for index, ms in arrivals:
        sources[index].signalMessage(message(ms))
        waiting[index].add(ms)
        if ms in waiting[1 - index]:
            wanted.append((ms, ms))
            waiting[0].remove(ms), waiting[1].remove(ms)
    assert heard == wanted
