# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is sent to an input without ROS: a sample, or a dict in the form of the message."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
import struct
from typing import Any

from amr_description.cdr.serialized import fill, serialized
from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Port
from amr_description.control.dof_samples import DofCommandSample
from amr_description.control.samples import CommandsSample, FlagSample, TwistSample
from amr_description.control.trajectory_samples import (
    SpeedScalingSample,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.errors import AmrError
from amr_description.messages.definitions import layout_of, texts
from amr_description.messages.parts import fill_stamp
from amr_description.messages.plain import has_stamp, message_like, message_of, PlainMessage
from amr_description.messages.readers import Key, reader_of
from amr_description.messages.writers import WRITERS


@dataclass(frozen=True)
class PlainCommand:
    """A command for an input."""

    port: Port
    sample: Any
    message: Any
    """As it was sent; None: a sample was."""

    def serialized(self) -> bytes:
        """Return the bytes of the message. Raises AmrError: there is no way to them."""
        name = self.port.message
        if name not in texts():
            raise AmrError(
                f"what is sent on '{self.port.name}' cannot be recorded: the definition of {name} "
                'is not in this package; end the recording'
            )
        message = self.message
        if message is None:
            kind = type(self.sample)
            write = COMMAND_WRITERS.get((kind, name)) or WRITERS.get((kind, name))
            if write is None:
                raise AmrError(
                    f"what is sent on '{self.port.name}' cannot be recorded: nothing writes a "
                    f'{kind.__name__} as {name}; send a dict in the form of the message'
                )
            message = PlainMessage(name)
            write(self.sample, message)
        return serialized(layout_of(name), message)


def command_of(port: Port, message: Any, time: int) -> PlainCommand:
    """
    Return the command that is sent to an input; one without a stamp gets the time.

    Args:
        port: Of the input.
        message: A sample already, or a mapping in the form of the message.
        time: Present time, ns.

    Raises:
        AmrError: A value does not fit, or there is no converter.
    """
    if not isinstance(message, Mapping):
        is_without = has_stamp(port.message) and getattr(message, 'stamp', None) == 0
        return PlainCommand(port, replace(message, stamp=time) if is_without else message, None)
    made = message_of(port.message, message)
    stamp = getattr(getattr(made, 'header', None), 'stamp', None)
    if stamp is not None and stamp.sec == stamp.nanosec == 0:
        stamp.sec, stamp.nanosec = divmod(time, NANOSECONDS)
    return PlainCommand(port, reader_of(port)(made), made)


def recorded_command(port: Port, message: PlainMessage) -> PlainCommand:
    """Return the command of a message as it is. Raises AmrError: there is no converter."""
    return PlainCommand(port, reader_of(port)(message), message)


def plain_message(name: str, data: bytes) -> PlainMessage:
    """
    Return the message of bytes.

    Raises AmrError: They are none of that type, or its definition is not here.
    """
    if name not in texts():
        raise AmrError(f'the definition of {name} is not in this package')
    message = PlainMessage(name)
    try:
        fill(layout_of(name), data, message, PlainMessage)
    except (ValueError, struct.error) as error:
        raise AmrError(f'these bytes are no {name}: {error}') from error
    return message


def fill_unstamped_twist(sample: TwistSample, message: Any) -> None:
    """Write a planar twist."""
    message.linear.x, message.linear.y = sample.linear, sample.lateral
    message.angular.z = sample.angular


def fill_commands(sample: CommandsSample, message: Any) -> None:
    """Write numbers."""
    message.data = sample.values


def fill_command(sample: CommandsSample, message: Any) -> None:
    """Write the only number."""
    (message.data,) = sample.values


def fill_flag(sample: FlagSample, message: Any) -> None:
    """Write the flag."""
    message.data = sample.value


def fill_dof_command(sample: DofCommandSample, message: Any) -> None:
    """Write names and values."""
    message.dof_names, message.values = sample.names, sample.values
    message.values_dot = sample.rates


def fill_speed_scaling(sample: SpeedScalingSample, message: Any) -> None:
    """Write the factor."""
    message.factor = sample.factor


def fill_trajectory(sample: TrajectorySample, message: Any) -> None:
    """Write names and points."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.joint_names = sample.joint_names
    message.points = [
        _point(message, point, time)
        for point, time in zip(sample.points, sample.times, strict=True)
    ]


def _point(message: Any, point: TrajectoryPoint, time: int) -> Any:
    made = message_like(
        message,
        'trajectory_msgs/msg/JointTrajectoryPoint',
        positions=point.positions,
        velocities=point.velocities,
        accelerations=point.accelerations,
        effort=point.effort,
    )
    fill_stamp(time, made.time_from_start)
    return made


COMMAND_WRITERS: Mapping[Key, Callable[[Any, Any], None]] = {
    (CommandsSample, 'std_msgs/msg/Float64'): fill_command,
    (CommandsSample, 'std_msgs/msg/Float64MultiArray'): fill_commands,
    (DofCommandSample, 'control_msgs/msg/MultiDOFCommand'): fill_dof_command,
    (FlagSample, 'std_msgs/msg/Bool'): fill_flag,
    (SpeedScalingSample, 'control_msgs/msg/SpeedScalingFactor'): fill_speed_scaling,
    (TrajectorySample, 'trajectory_msgs/msg/JointTrajectory'): fill_trajectory,
    (TwistSample, 'geometry_msgs/msg/Twist'): fill_unstamped_twist,
}
"""What writes samples of inputs that nothing publishes: the other way of ``READERS``."""
