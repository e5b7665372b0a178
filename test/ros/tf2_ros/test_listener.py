# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The interface of tf2_ros: a buffer for many threads, a listener, broadcasters; over real DDS."""

import asyncio
from contextlib import ExitStack
import threading
from types import SimpleNamespace

from builtin_interfaces.msg import Time as TimeMessage
import pytest
import rclpy
from rclpy.clock import ROSClock
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.serialization import serialize_message
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph

from amr_description import tf2_ros
from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
)
from amr_description.model.frames import Transform
from amr_description.ros.service_calls import ask_until_answered, wait_until
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from amr_description.tf2_ros.buffer import Buffer, stamped_transform, transform_message
from amr_description.tf2_ros.listener import publishers_of, TransformListener
from amr_description.tf2_ros.time_cache import StampedTransform

PATIENCE = Duration(seconds=30)


def message(parent, child, x=1.0, time=0):
    return transform_message(StampedTransform(parent, child, time, Transform((x, 0.0, 0.0))))


@pytest.fixture
def context():
    rclpy.init(args=[])
    yield
    rclpy.try_shutdown()


@pytest.fixture
def own(context):
    """Has a node destroyed after the test: the next one would find it in the graph."""
    with ExitStack() as stack:

        def owned(node):
            stack.callback(node.destroy_node)
            return node

        yield owned


@pytest.fixture
def buffer():
    made = Buffer()
    made.set_transform_static(message('base', 'laser', 0.5), 'me')
    made.set_transform(message('odom', 'base', 1.0, 10), 'me')
    made.set_transform(message('odom', 'base', 3.0, 20), 'me')
    return made


def test_messages_survive_the_way_there_and_back():
    stamped = StampedTransform(
        'a', 'b', -1_500_000_000, Transform((1.0, 2.0, 3.0), (0, 0, 0.6, 0.8))
    )
    assert stamped_transform(transform_message(stamped)) == stamped


@pytest.mark.parametrize('time', [Time(nanoseconds=15), TimeMessage(nanosec=15)])
def test_a_lookup_takes_times_of_either_kind(buffer, time):
    found = buffer.lookup_transform('odom', 'laser', time)
    assert found.transform.translation.x == 2.5
    assert (found.header.frame_id, found.child_frame_id) == ('odom', 'laser')
    assert found.header.stamp == TimeMessage(nanosec=15)


def test_lookups_that_fail_are_transform_exceptions(buffer):
    assert buffer.can_transform('odom', 'laser', Time())
    with pytest.raises(LookupException, match='"map" passed to lookupTransform argument target'):
        buffer.lookup_transform('map', 'laser', Time())
    buffer.set_transform_static(message('map', 'cup'), 'me')
    with pytest.raises(ConnectivityException, match="'map' with cup"):
        buffer.lookup_transform('map', 'laser', Time())
    with pytest.raises(TransformException, match='extrapolation into the future'):
        buffer.lookup_transform('odom', 'laser', Time(nanoseconds=21))


def test_can_transform_returns_the_reason(buffer):
    assert buffer.can_transform('odom', 'base', Time(), return_debug_tuple=True) == (True, '')
    can, why = buffer.can_transform('map', 'base', Time(), return_debug_tuple=True)
    assert not can
    assert why.startswith('Invalid frame ID "map" passed to canTransform argument target_frame - ')


def test_the_full_interface_goes_through_a_fixed_frame(buffer):
    way = ('base', Time(nanoseconds=20), 'laser', Time(nanoseconds=10), 'odom')
    assert buffer.lookup_transform_full(*way).transform.translation.x == -1.5
    assert buffer.can_transform_full(*way)
    can, why = buffer.can_transform_full(
        *way[:3], Time(nanoseconds=9), 'odom', return_debug_tuple=True
    )
    assert (can, 'into the past' in why) == (False, True)


def test_all_frames_are_described_as_by_tf2(buffer):
    assert buffer.chain('odom', 'laser') == ['odom', 'base', 'laser']
    assert buffer.get_latest_common_time('odom', 'laser') == Time(nanoseconds=20)
    assert (
        buffer.all_frames_as_string()
        == ('Frame laser exists with parent base.\nFrame base exists with parent odom.\n')
        or 'Frame base exists with parent odom.\n' in buffer.all_frames_as_string()
    )
    assert "broadcaster: 'me'" in buffer.all_frames_as_yaml()


def test_a_wait_ends_the_moment_the_transform_comes(context, buffer, monkeypatch):
    """It is woken, rather than to look now and then."""
    monkeypatch.setattr('amr_description.tf2_ros.buffer._SLICE', 3600.0)
    found = []

    def wait():
        way = ('odom', 'laser', Time(nanoseconds=30))
        found.append(buffer.lookup_transform(*way, Duration(seconds=3600)))

    waiter = threading.Thread(target=wait, daemon=True)
    waiter.start()
    assert not buffer.can_transform('odom', 'laser', Time(nanoseconds=30))
    buffer.set_transform(message('odom', 'base', 5.0, 30), 'me')
    waiter.join(timeout=30.0)
    assert [one.transform.translation.x for one in found] == [5.5]


def test_a_wait_ends_with_its_time_out(context, buffer):
    with pytest.raises(ExtrapolationException, match='into the future'):
        buffer.lookup_transform('odom', 'base', Time(nanoseconds=99), Duration(nanoseconds=1000))
    assert not buffer.can_transform('odom', 'cup', Time(), Duration(nanoseconds=1000))


def test_a_wait_ends_with_ros(buffer):
    """Without it no transform will come: rclpy is not initialised here."""
    assert not buffer.can_transform('odom', 'cup', Time(), PATIENCE)


def test_a_transform_can_be_awaited(buffer):
    assert buffer.wait_for_transform_async('odom', 'base', Time()).done()
    future = buffer.wait_for_transform_async('odom', 'cup', Time())
    assert not future.done()
    buffer.set_transform(message('base', 'cup', 2.0, 20), 'me')
    assert future.result().transform.translation.x == 5.0

    async def ask():
        return await buffer.lookup_transform_async('odom', 'cup', Time())

    assert asyncio.run(ask()).transform.translation.x == 5.0


class FakeLogger:
    def __init__(self):
        self.said = []

    def warning(self, text):
        self.said.append(text)


def test_a_warning_is_logged_once_and_names_the_nodes(buffer):
    buffer._logger = FakeLogger()
    buffer.publishers = lambda: {'/tf': ['/ekf', '/wheels'], '/tf_static': []}
    for _ in range(3):
        buffer.set_transform(message('odom', 'odom'), 'me')
        buffer.set_transform_static(message('map', 'laser'), 'me')
    assert len(buffer._logger.said) == 2
    assert buffer._logger.said[0].startswith('TF_SELF_TRANSFORM: Ignoring transform')
    assert buffer._logger.said[1].startswith(
        'TF_TWO_PARENTS: frame "laser" is published as static'
    )
    assert buffer._logger.said[1].endswith('. /tf is published by /ekf, /wheels')


def test_time_that_goes_back_clears_what_moves(context):
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(nanoseconds=100, clock_type=clock.clock_type))
    buffer = Buffer(clock=clock)
    buffer._logger = FakeLogger()
    buffer.set_transform_static(message('base', 'laser', 0.5), 'me')
    buffer.set_transform(message('odom', 'base', 1.0, 100), 'me')
    clock.set_ros_time_override(Time(nanoseconds=110, clock_type=clock.clock_type))
    assert buffer.can_transform('odom', 'laser', Time())
    clock.set_ros_time_override(Time(nanoseconds=5, clock_type=clock.clock_type))
    assert buffer._logger.said == ['Detected jump back in time. Clearing tf buffer.']
    assert not buffer.can_transform('odom', 'laser', Time())
    assert buffer.can_transform('base', 'laser', Time())


def test_what_was_on_its_way_when_time_went_back_keeps_nothing_out(context):
    """Taken for the newest, it would make what follows too old for the cache of 10 s."""
    second = 1_000_000_000
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(nanoseconds=60 * second, clock_type=clock.clock_type))
    buffer = Buffer(clock=clock)
    buffer._logger = FakeLogger()
    buffer.set_transform(message('odom', 'base', 1.0, 60 * second), 'me')
    clock.set_ros_time_override(Time(nanoseconds=0, clock_type=clock.clock_type))
    buffer.set_transform(message('odom', 'base', 1.0, 60 * second - second // 100), 'me')
    buffer.set_transform(message('base', 'wheel', 2.0, second // 50), 'me')
    buffer.set_transform(message('odom', 'base', 1.0, 60 * second), 'me')
    buffer.set_transform(message('odom', 'base', 0.0, second // 50), 'me')
    found = buffer.lookup_transform('odom', 'base', Time()).transform.translation.x
    assert found == 0.0
    assert buffer._logger.said == ['Detected jump back in time. Clearing tf buffer.']


def test_a_listener_receives_moving_and_earlier_static_transforms(own):
    talker, hearer = own(Node('talker')), own(Node('hearer'))
    static, moving = StaticTransformBroadcaster(talker), TransformBroadcaster(talker)
    static.sendTransform(message('base', 'laser', 0.5))
    static.sendTransform([message('base', 'camera', 0.7), message('base', 'lidar', 0.8)])
    static.sendTransform(message('base', 'laser', 0.6))
    buffer = Buffer(node=hearer)
    listener = TransformListener(buffer, hearer)

    def heard(frame):
        moving.sendTransform(message('odom', 'base', 1.0, 10))
        return buffer.can_transform('odom', frame, Time()) or None

    assert wait_until(
        hearer, lambda: heard('laser') and heard('camera') and heard('lidar'), timeout=20.0
    )
    found = buffer.lookup_transform('odom', 'laser', Time())
    assert found.transform.translation.x == pytest.approx(1.6)
    assert listener.publishers() == {'/tf': ['/talker'], '/tf_static': ['/talker']}
    assert (moving.pub_tf.qos_profile.depth, static.pub_tf.qos_profile.depth) == (100, 1)
    for topic, durability in (
        ('/tf', DurabilityPolicy.VOLATILE),
        ('/tf_static', DurabilityPolicy.TRANSIENT_LOCAL),
    ):
        (info,) = talker.get_publishers_info_by_topic(topic)
        assert info.qos_profile.durability == durability
        assert info.qos_profile.reliability == ReliabilityPolicy.RELIABLE
    for subscription in listener._subscriptions:
        assert subscription.qos_profile.depth == 100
        assert subscription.qos_profile.reliability == ReliabilityPolicy.RELIABLE
    client = hearer.create_client(FrameGraph, 'tf2_frames')
    answer = ask_until_answered(hearer, client, FrameGraph.Request())
    assert "laser: \n  parent: 'base'\n  broadcaster: 'default_authority'" in answer.frame_yaml
    listener.unregister()
    assert publishers_of(hearer, '/nothing') == []


class OwnListener(TransformListener):
    """As a program of users may have it."""

    def callback(self, data):
        self.messages = data
        super().callback(data)


class OwnBuffer(Buffer):
    def set_transform(self, transform, authority):
        self.messages = transform
        super().set_transform(transform, authority)


@pytest.mark.parametrize('kind', ['listener', 'buffer', 'stranger'])
def test_methods_of_its_own_get_messages(own, kind):
    """Others are fed with bytes."""
    talker, hearer = own(Node('talker')), own(Node('hearer'))
    moving = TransformBroadcaster(talker)
    buffer = OwnBuffer() if kind == 'buffer' else Buffer()
    got = []
    if kind == 'stranger':
        buffer = SimpleNamespace(
            set_transform=lambda transform, authority: got.append((transform, authority))
        )
    listener = (OwnListener if kind == 'listener' else TransformListener)(buffer, hearer)

    def message_heard():
        moving.sendTransform(message('odom', 'base', 1.0, 10))
        if kind == 'stranger':
            return got and got[0][0]
        if kind == 'listener':
            return (each := getattr(listener, 'messages', None)) and each.transforms[0]
        return getattr(buffer, 'messages', None)

    found = wait_until(
        hearer, lambda: message_heard() or None, timeout=PATIENCE.nanoseconds * 1e-9
    )
    assert found == message('odom', 'base', 1.0, 10)
    assert not any(each.raw for each in listener._subscriptions)
    listener.unregister()


def test_bytes_that_are_no_plain_cdr_are_read_as_rclpy_does(own):
    hearer = own(Node('hearer'))
    buffer = Buffer()
    listener = TransformListener(buffer, hearer)
    assert all(each.raw for each in listener._subscriptions)
    data = serialize_message(TFMessage(transforms=[message('odom', 'bXse', 1.0, 10)]))
    listener._take(data.replace(b'bXse', b'b\xffse'))
    assert [each.name for each in buffer.records()] == ['b\ufffdse']
    for bad in (b'', b'\0\1\0\0', data[:-9]):
        listener._take(bad)
        listener._take_static(bad)
    assert len(buffer.records()) == 1
    listener.unregister()


def test_a_publisher_whose_node_is_not_known_yet_has_no_name():
    unknown = ('_NODE_NAMESPACE_UNKNOWN_', '_NODE_NAME_UNKNOWN_')
    infos = [
        SimpleNamespace(node_namespace=namespace, node_name=name)
        for namespace, name in (unknown, ('/a', 'b'))
    ]
    hearer = SimpleNamespace(get_publishers_info_by_topic=lambda _topic: infos)
    assert publishers_of(hearer, '/tf') == ['/a/b']


def test_a_listener_can_serve_itself(own):
    """A callback, or a main program, may wait: a thread hears."""
    talker = own(Node('talker'))
    StaticTransformBroadcaster(talker).sendTransform(message('base', 'laser'))
    buffer = Buffer()
    listener = TransformListener(buffer, None, spin_thread=True)
    assert (
        buffer.lookup_transform('base', 'laser', Time(), PATIENCE).transform.translation.x == 1.0
    )
    listener.unregister()
    assert not any(thread.name == 'transforms' for thread in threading.enumerate())


def test_a_node_written_for_tf2_ros_changes_its_import_only(own):
    """The node of tf2's tutorial, as it is written there."""

    class FrameListener(Node):
        def __init__(self):
            super().__init__('turtle_tf2_frame_listener')
            self.tf_buffer = tf2_ros.Buffer()
            self.tf_listener = tf2_ros.TransformListener(self.tf_buffer, self)

        def look(self):
            try:
                return self.tf_buffer.lookup_transform('turtle1', 'carrot1', Time())
            except tf2_ros.TransformException as error:
                assert 'passed to lookupTransform argument target_frame does not exist' in str(
                    error
                )

    node = own(FrameListener())
    broadcaster = tf2_ros.StaticTransformBroadcaster(node)
    assert node.look() is None
    broadcaster.sendTransform(message('turtle1', 'carrot1', 2.0))
    assert wait_until(node, node.look, timeout=20.0).transform.translation.x == 2.0
