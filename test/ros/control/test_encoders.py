# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes of samples: those that rclpy makes of the message which the converter fills."""

import math
import random
import struct

from pal_statistics_msgs.msg import StatisticsValues
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from support.running_programs import PATIENCE

from amr_description.control.contracts import Port, Qos
from amr_description.control.ros.encoders import encoder_of, RosForm
from amr_description.control.ros.loop_publisher import _fill_clock
from amr_description.control.ros.plugin_nodes import qos
from amr_description.control.ros.status_topics import fill_values, RegistrySample, VALUES
from amr_description.control.samples import (
    BodyOdometrySample,
    DynamicJointStateSample,
    DynamicLayout,
    Frames,
    ImuConstants,
    ImuSample,
    JointStateSample,
    OdometrySample,
    TwistSample,
)
from amr_description.messages import encoders
from amr_description.messages.encoders import bytes_encoder_of, ENCODINGS, TemplateEncoder
from amr_description.messages.writers import writer_of
from amr_description.model.frames import Transform
from amr_description.ros.layouts import is_that_of, serialize, template_of
from amr_description.ros.message_types import message_type
from amr_description.ros.service_calls import wait_until

KEYS = sorted(ENCODINGS, key=lambda key: f'{key[0].__name__} {key[1]}')
SPECIAL = (0.0, -0.0, math.nan, math.inf, -math.inf, 5e-324, 1.7976931348623157e308)
NAMES = ('base', '', 'robot_1/base_link', 'Räder', 'a' * 37)


class Drawn:
    """Samples drawn at random; what is constant changes with each object."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.frame, self.other_frame = self.name(), self.name()
        self.frames = Frames(self.frame, self.other_frame, self.numbers(6), self.numbers(6))
        count = self.random.randrange(5)
        self.names = tuple(self.name() for _ in range(count))
        self.layout = DynamicLayout(
            self.frame,
            self.names,
            tuple(tuple(self.name() for _ in range(self.random.randrange(4))) for _ in self.names),
        )
        self.imu = ImuConstants(self.frame, self.numbers(9), self.numbers(9), self.numbers(9))

    def name(self):
        return self.random.choice(NAMES)

    def number(self):
        if self.random.random() < 0.2:
            return self.random.choice(SPECIAL)
        return self.random.uniform(-1e3, 1e3)

    def finite(self):
        return self.random.uniform(-1e3, 1e3)

    def numbers(self, count):
        return tuple(self.number() for _ in range(count))

    def stamp(self):
        return self.random.choice((0, 1, 999_999_999, 10**9, self.random.randrange(2**31 * 10**9)))

    def sample(self, kind):
        stamp = self.stamp()
        if kind is int:
            return stamp
        if kind is OdometrySample:
            x, y, linear, angular, lateral = self.numbers(5)
            return kind(stamp, x, y, self.finite(), linear, angular, self.frames, lateral)
        if kind is BodyOdometrySample:
            pose = Transform(self.numbers(3), self.numbers(4))
            return kind(stamp, pose, self.numbers(3), self.numbers(3), self.frames)
        if kind is JointStateSample:
            rows = (self.numbers(len(self.names)) for _ in range(3))
            return kind(stamp, self.frame, self.names, *rows)
        if kind is DynamicJointStateSample:
            rows = tuple(self.numbers(len(row)) for row in self.layout.interfaces)
            return kind(stamp, rows, self.layout)
        if kind is ImuSample:
            return kind(stamp, self.numbers(4), self.numbers(3), self.numbers(3), self.imu)
        return TwistSample(stamp, self.number(), self.number(), self.frame, self.number())


def writer(key):
    """The converter, and the type of its messages."""
    kind, name = key
    if kind is int:
        return _fill_clock, message_type(name, '')
    return writer_of(Port('topic', name, sample=kind)), message_type(name, '')


def expected(key, sample):
    fill, message_class = writer(key)
    message = message_class()
    fill(sample, message)
    return message


def made_by(key):
    return encoder_of(*key, *writer(key))


def read(data, key):
    """What a subscriber reads, as text: so NaN is equal to NaN, and -0.0 is not to 0.0."""
    return str(deserialize_message(data, message_type(key[1], '')))


def assert_same(key, data, sample):
    """Not byte by byte: those that align what follows them are anything from rclpy."""
    message = expected(key, sample)
    assert isinstance(data, bytes)
    assert read(data, key) == read(serialize_message(message), key)
    template = template_of(message, ENCODINGS[key].changing)
    assert is_that_of(message, data, template)


@pytest.mark.parametrize('key', KEYS, ids=str)
def test_bytes_are_those_of_the_message_whatever_the_numbers(key):
    encode = made_by(key)
    for seed in range(12):
        drawn = Drawn(seed)
        for _ in range(4):
            sample = drawn.sample(key[0])
            assert_same(key, encode(sample), sample)


@pytest.mark.parametrize('key', [each for each in KEYS if each[0] is not int], ids=str)
def test_bytes_without_ros_are_those_of_the_message(key):
    encode = bytes_encoder_of(Port('topic', key[1], sample=key[0]))
    for seed in range(12):
        sample = Drawn(seed).sample(key[0])
        assert encode(sample) == serialize(expected(key, sample))


@pytest.mark.parametrize('key', KEYS, ids=str)
def test_constants_that_alternate_are_those_of_the_sample(key):
    encode = made_by(key)
    for seed in (1, 2, 1, 3, 2):
        sample = Drawn(seed).sample(key[0])
        assert_same(key, encode(sample), sample)


def test_lengths_that_change_below_the_same_names_are_those_of_the_sample():
    key = (DynamicJointStateSample, 'control_msgs/msg/DynamicJointState')
    encode = made_by(key)
    layout = DynamicLayout('base', ('a',), (('position', 'velocity'),))
    for values in ((1.0, 2.0), (1.0,), (), (1.0, 2.0, 3.0)):
        sample = DynamicJointStateSample(5, (values,), layout)
        assert_same(key, encode(sample), sample)


def test_numbers_of_a_registry_are_those_of_the_message():
    encode = TemplateEncoder(VALUES, fill_values, RosForm(StatisticsValues))
    drawn = Drawn(5)
    for version, count in ((1, 3), (1, 3), (2, 0), (3, 5), (4, 5)):
        sample = RegistrySample(drawn.stamp(), (), version, list(drawn.numbers(count)))
        message = StatisticsValues()
        fill_values(sample, message)
        template = template_of(message, VALUES.changing)
        assert is_that_of(message, encode(sample), template)


def test_the_template_is_made_once_for_equal_constants(monkeypatch):
    made = []
    template_of = encoders.template_of
    monkeypatch.setattr(
        encoders, 'template_of', lambda *args: made.append(args) or template_of(*args)
    )
    encode = made_by((OdometrySample, 'nav_msgs/msg/Odometry'))
    for seed in (1, 1, 1, 2):
        encode(Drawn(seed).sample(OdometrySample))
    assert len(made) == 2


def test_messages_are_published_where_rclpy_serializes_otherwise(monkeypatch):
    monkeypatch.setattr(RosForm, 'is_right', lambda *_: False)
    key = (JointStateSample, 'sensor_msgs/msg/JointState')
    encode = made_by(key)
    for seed in (1, 1, 2):
        sample = Drawn(seed).sample(JointStateSample)
        assert str(encode(sample)) == str(expected(key, sample))


def test_a_type_of_samples_without_an_encoding_is_published_as_a_message():
    filled = []
    encode = encoder_of(None, 'any', lambda sample, message: filled.append((sample, message)), str)
    assert encode('sample') == ''
    assert filled == [('sample', '')]


def test_a_sample_that_cannot_be_written_raises_and_the_next_is_right():
    key = (OdometrySample, 'nav_msgs/msg/Odometry')
    encode = made_by(key)
    frames = Frames('odom', 'base', (0.1,) * 6, (0.2,) * 6)
    for x in (1.0, None, 2.0):
        sample = OdometrySample(7, x, 0.0, 0.0, 0.0, 0.0, frames)
        if x is None:
            with pytest.raises(struct.error):
                encode(sample)
        else:
            assert_same(key, encode(sample), sample)


# --- over DDS ---------------------------------------------------------------------------------


QOS = {
    'controllers': (qos(Qos()), 'latched'),
    'latched': (QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL), 'latched'),
    'reliable': (QoSProfile(depth=10), 'reliable'),
    'best effort': (
        QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT),
        'best effort',
    ),
    'keep all': (QoSProfile(history=HistoryPolicy.KEEP_ALL), 'reliable'),
}
"""Of a publisher, and the name of that of its subscribers."""


@pytest.fixture(scope='module')
def node():
    rclpy.init(args=[])
    node = Node('test_encoders')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


class Subscribers:
    """One that asks for bytes and one that asks for messages, in the process of the publisher."""

    def __init__(self, node, message_class, topic, profile):
        self.raw, self.read = [], []
        subscribe = node.create_subscription
        self._subscriptions = (
            subscribe(message_class, topic, self.raw.append, profile, raw=True),
            subscribe(message_class, topic, self.read.append, profile),
        )
        self._node = node

    def wait_for(self, count):
        wait_until(
            self._node,
            lambda: len(self.raw) == len(self.read) == count or None,
            timeout=PATIENCE,
        )

    def close(self):
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)


def arrived(node, name, as_bytes):
    """Publish two samples, one of them before anybody subscribes; return what arrives."""
    key = (JointStateSample, 'sensor_msgs/msg/JointState')
    drawn = Drawn(4)
    samples = [drawn.sample(JointStateSample) for _ in range(2)]
    make = made_by(key) if as_bytes else lambda sample: expected(key, sample)
    own, of_subscribers = QOS[name]
    topic = f'said_{as_bytes}_{name.replace(" ", "_")}'
    message_class = message_type(key[1], '')
    publisher = node.create_publisher(message_class, topic, own)
    publisher.publish(make(samples[0]))
    subscribers = Subscribers(node, message_class, topic, QOS[of_subscribers][0])
    wait_until(node, lambda: publisher.get_subscription_count() == 2 or None, timeout=PATIENCE)
    is_latched = of_subscribers == 'latched'
    if is_latched:
        subscribers.wait_for(1)
    publisher.publish(make(samples[1]))
    subscribers.wait_for(1 + is_latched)
    subscribers.close()
    node.destroy_publisher(publisher)
    assert all(isinstance(each, bytes) for each in subscribers.raw)
    raw = [read(each, key) for each in subscribers.raw]
    assert raw == [str(each) for each in subscribers.read]
    assert len(raw) == 1 + is_latched
    return raw, [len(each) for each in subscribers.raw]


@pytest.mark.parametrize('name', QOS)
def test_subscribers_in_this_process_get_bytes_as_they_get_messages(node, name):
    """Those that ask for bytes, those that ask for messages, and those that come too late."""
    assert arrived(node, name, as_bytes=True) == arrived(node, name, as_bytes=False)


@pytest.mark.parametrize('key', KEYS, ids=str)
def test_what_arrives_is_as_long_as_what_rclpy_sends(node, key):
    """Which ``serialize_message`` does not show: it does not cut off the end."""
    sample = Drawn(3).sample(key[0])
    topic = f'sent_{KEYS.index(key)}'
    message_class = message_type(key[1], '')
    publisher = node.create_publisher(message_class, topic, 10)
    subscribers = Subscribers(node, message_class, topic, 10)
    wait_until(node, lambda: publisher.get_subscription_count() == 2 or None, timeout=PATIENCE)
    publisher.publish(expected(key, sample))
    publisher.publish(made_by(key)(sample))
    subscribers.wait_for(2)
    first, second = subscribers.raw
    assert (len(first), read(first, key)) == (len(second), read(second, key))
    subscribers.close()
    node.destroy_publisher(publisher)
