# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples as the bytes of messages, for what is published in every cycle.

For each of these there is a converter, too, which fills a message: it says what is sent, and this
is only faster. An :class:`Encoding` says which numbers of a message a sample has; everything else
is taken from a message that the converter has filled, once and whenever it changes. With rclpy the
first bytes are then compared, too, with what it makes of that message; should they differ,
messages are published. Without ROS all samples become bytes (:func:`bytes_encoder_of`).

Processor time of one publication, µs (4 joints; readers in other processes, by UDP):

==================  ==================  ==================
message             no reader           two readers
==================  ==================  ==================
Clock               5.3 → 2.5           11.6 → 8.3
JointState          13.8 → 3.6          26.6 → 10.2
DynamicJointState   17.4 → 4.1          25.9 → 10.5
Odometry            16.9 → 2.8          25.5 → 8.8
TFMessage           12.0 → 2.6          19.2 → 8.4
==================  ==================  ==================

Of what is left, 2.1 are Fast DDS for any message, and 2.6 the kernel for each reader's process.
Sent by a thread of Fast DDS instead (``RMW_FASTRTPS_PUBLICATION_MODE=ASYNCHRONOUS``), a cycle
takes a quarter less, but that thread gets no time where the simulation runs as fast as possible:
of 37,000 joint states 5,000 arrived, sent as here 38,000 of 49,000, with the same reader.

A type of sample that is not here is published by its converter alone.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math
import struct
from typing import Any, Protocol, TypeAlias

from amr_description.cdr.layouts import FieldGroup
from amr_description.cdr.serialized import serialized
from amr_description.cdr.template import Template, template_of
from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Port
from amr_description.control.samples import (
    BodyOdometrySample,
    DynamicJointStateSample,
    ImuSample,
    JointStateSample,
    OdometrySample,
    TwistSample,
)
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import PlainMessage
from amr_description.messages.writers import writer_of

_NONE = object()

Encoder: TypeAlias = Callable[[Any], Any]
"""Makes of a sample what is published: a message, or the bytes of one."""

_Bind: TypeAlias = Callable[[Template], Callable[[Any], bytes]]


def filling(fill: Callable[[Any, Any], None], message: Any) -> Encoder:
    """
    Return the plain encoder: it writes every sample into the same message.

    Args:
        fill: the converter, ``(sample, message) -> None``.
        message: is sent many times.
    """

    def encode(sample: Any) -> Any:
        fill(sample, message)
        return message

    return encode


@dataclass(frozen=True, slots=True)
class Encoding:
    """How the samples of one type become the bytes of one type of messages."""

    changing: tuple[str, ...]
    """Fields of the message that a sample has numbers for, in the order of the message."""
    constants: Callable[[Any], Any]
    """``(sample) ->`` all that the rest of the message depends on."""
    bind: _Bind
    """``(template) -> (sample) -> bytes``."""


class Form(Protocol):
    """Messages of one type, in one of two forms: those of rclpy, or plain ones."""

    @property
    def layout(self) -> FieldGroup:
        """How they are laid out."""

    def new(self) -> Any:
        """Return a message of defaults."""

    def is_right(self, template: Template, data: bytes, message: Any) -> bool:
        """Return whether bytes that a template has made are those of a message."""


class PlainForm:
    """Messages without ROS."""

    def __init__(self, type_name: str) -> None:
        """``type_name``: ``package/msg/Name``. Raises KeyError: there is no definition of it."""
        self.layout = layout_of(type_name)
        self._type_name = type_name

    def new(self) -> PlainMessage:
        """Return a message of defaults."""
        return PlainMessage(self._type_name)

    def is_right(self, template: Template, data: bytes, message: Any) -> bool:
        """Both are made here."""
        return True


def bytes_encoder_of(port: Port) -> Callable[[Any], bytes]:
    """
    Return what makes the bytes of messages of the samples of an output, without ROS.

    Raises:
        ControllerError: There is no converter.
        KeyError: There is no definition of its messages.
    """
    fill, form = writer_of(port), PlainForm(port.message)
    encode = encoder_of(None if port.convert else port.sample, port.message, fill, form)
    layout = form.layout

    def encode_as_bytes(sample: Any) -> bytes:
        made = encode(sample)
        return made if isinstance(made, bytes) else serialized(layout, made)

    return encode_as_bytes


def encoder_of(
    sample: type | None, message: str, fill: Callable[[Any, Any], None], form: Form
) -> Encoder:
    """
    Return what makes bytes, or else messages, of samples.

    Args:
        sample: type of the samples.
        message: name of the type of the messages.
        fill: the converter, ``(sample, message) -> None``.
        form: of the messages.
    """
    encoding = ENCODINGS.get((sample, message))
    if encoding is None:
        return filling(fill, form.new())
    return TemplateEncoder(encoding, fill, form)


class TemplateEncoder:
    """Makes bytes of samples by a template, which it makes anew when the constants change."""

    def __init__(self, encoding: Encoding, fill: Callable[[Any, Any], None], form: Form) -> None:
        """See :func:`encoder_of`."""
        self._encoding = encoding
        self._constants_of = encoding.constants
        self._fill, self._form = fill, form
        self._constants: Any = _NONE
        self._encode = filling(fill, form.new())

    def __call__(self, sample: Any) -> Any:
        """Return the bytes of a message, or the message."""
        constants = self._constants_of(sample)
        if constants is not self._constants and constants != self._constants:
            self._encode = self._begin(sample)
            self._constants = constants
        try:
            return self._encode(sample)
        except struct.error:  # more numbers than there were, or fewer
            self._encode = self._begin(sample)
            return self._encode(sample)

    def _begin(self, sample: Any) -> Encoder:
        """Fill a message with a sample, and make the template of it."""
        form, message = self._form, self._form.new()
        self._fill(sample, message)
        template = template_of(form.layout, message, self._encoding.changing)
        encode = self._encoding.bind(template)
        if form.is_right(template, encode(sample), message):
            return encode
        return filling(self._fill, message)


def _clock(template: Template) -> Callable[[int], bytes]:
    pack = template.pack
    begin, end = template.constants
    return lambda time: pack(begin, *divmod(time, NANOSECONDS), end)


def _joint_states(template: Template) -> Callable[[JointStateSample], bytes]:
    pack = template.pack
    begin, names, velocities, efforts, end = template.constants

    def encode(sample: JointStateSample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            names, *sample.position,
            velocities, *sample.velocity,
            efforts, *sample.effort, end,
        )  # fmt: skip

    return encode


def _dynamic_joint_states(template: Template) -> Callable[[DynamicJointStateSample], bytes]:
    pack = template.pack
    begin, *rows, end = template.constants

    def encode(sample: DynamicJointStateSample) -> bytes:
        arguments = [begin, *divmod(sample.stamp, NANOSECONDS)]
        for names, values in zip(rows, sample.values, strict=True):
            arguments.append(names)
            arguments.extend(values)
        return pack(*arguments, end)

    return encode


def _odometry(template: Template) -> Callable[[OdometrySample], bytes]:
    pack = template.pack
    begin, pose, twist, end = template.constants

    def encode(sample: OdometrySample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        half = sample.heading * 0.5
        return pack(
            begin, seconds, nanoseconds,
            pose, sample.x, sample.y, 0.0, 0.0, 0.0, math.sin(half), math.cos(half),
            twist, sample.linear, sample.lateral, 0.0, 0.0, 0.0, sample.angular, end,
        )  # fmt: skip

    return encode


def _odometry_transform(template: Template) -> Callable[[OdometrySample], bytes]:
    pack = template.pack
    begin, transform, end = template.constants

    def encode(sample: OdometrySample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        half = sample.heading * 0.5
        return pack(
            begin, seconds, nanoseconds,
            transform, sample.x, sample.y, 0.0, 0.0, 0.0, math.sin(half), math.cos(half), end,
        )  # fmt: skip

    return encode


def _body_odometry(template: Template) -> Callable[[BodyOdometrySample], bytes]:
    pack = template.pack
    begin, pose, twist, end = template.constants

    def encode(sample: BodyOdometrySample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            pose, *sample.pose.translation, *sample.pose.rotation,
            twist, *sample.linear, *sample.angular, end,
        )  # fmt: skip

    return encode


def _body_transform(template: Template) -> Callable[[BodyOdometrySample], bytes]:
    pack = template.pack
    begin, transform, end = template.constants

    def encode(sample: BodyOdometrySample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        pose = sample.pose
        return pack(begin, seconds, nanoseconds, transform, *pose.translation, *pose.rotation, end)

    return encode


def _imu(template: Template) -> Callable[[ImuSample], bytes]:
    pack = template.pack
    begin, orientation, angular, linear, end = template.constants

    def encode(sample: ImuSample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            orientation, *sample.orientation,
            angular, *sample.angular_velocity,
            linear, *sample.linear_acceleration, end,
        )  # fmt: skip

    return encode


def _twist(template: Template) -> Callable[[TwistSample], bytes]:
    pack = template.pack
    begin, twist, end = template.constants

    def encode(sample: TwistSample) -> bytes:
        seconds, nanoseconds = divmod(sample.stamp, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            twist, sample.linear, sample.lateral, 0.0, 0.0, 0.0, sample.angular, end,
        )  # fmt: skip

    return encode


def _frames(sample: Any) -> Any:
    return sample.frames


def _joint_names(sample: JointStateSample) -> Any:
    return sample.name, sample.frame_id


_ODOMETRY = ('header.stamp', 'pose.pose', 'twist.twist')
_TRANSFORM = ('transforms.header.stamp', 'transforms.transform')
ENCODINGS: dict[tuple[type | None, str], Encoding] = {
    (int, 'rosgraph_msgs/msg/Clock'): Encoding(('clock',), lambda _: '', _clock),
    (BodyOdometrySample, 'nav_msgs/msg/Odometry'): Encoding(_ODOMETRY, _frames, _body_odometry),
    (BodyOdometrySample, 'tf2_msgs/msg/TFMessage'): Encoding(_TRANSFORM, _frames, _body_transform),
    (DynamicJointStateSample, 'control_msgs/msg/DynamicJointState'): Encoding(
        ('header.stamp', 'interface_values.values'),
        lambda sample: sample.layout,
        _dynamic_joint_states,
    ),
    (ImuSample, 'sensor_msgs/msg/Imu'): Encoding(
        ('header.stamp', 'orientation', 'angular_velocity', 'linear_acceleration'),
        lambda sample: sample.constants,
        _imu,
    ),
    (JointStateSample, 'sensor_msgs/msg/JointState'): Encoding(
        ('header.stamp', 'position', 'velocity', 'effort'), _joint_names, _joint_states
    ),
    (OdometrySample, 'nav_msgs/msg/Odometry'): Encoding(_ODOMETRY, _frames, _odometry),
    (OdometrySample, 'tf2_msgs/msg/TFMessage'): Encoding(_TRANSFORM, _frames, _odometry_transform),
    (TwistSample, 'geometry_msgs/msg/TwistStamped'): Encoding(
        ('header.stamp', 'twist'), lambda sample: sample.frame_id, _twist
    ),
}
"""By the types of sample and message, as the table of converters."""
