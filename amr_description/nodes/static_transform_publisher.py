# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
``static_transform_publisher``: publish the constant pose of a frame, latched.

::

    ros2 run tf2_ros static_transform_publisher --z 0.3 --yaw 1.57 \
        --frame-id base_link --child-frame-id laser
    ros2 run tf2_ros static_transform_publisher 0 0 0.3 1.57 0 0 base_link laser   # deprecated

It publishes one message on ``/tf_static`` (reliable, transient local, depth 1) and keeps running,
for later subscribers. Arguments, texts, parameters and exit codes are those of the original. But
values that no listener can use are rejected: numbers with a suffix (``1.0m``), and quaternions
that are not normalized.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import math
import secrets
import string

from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.errors import UsageError
from amr_description.model.frames import normalize, quaternion_from_rpy, Transform
from amr_description.ros.runtime import run
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.buffer_core import is_unit
from amr_description.tf2_ros.time_cache import StampedTransform
from amr_description.tf2_ros.tools import arguments_of, print_now, run_tool

USAGE = """\
usage: static_transform_publisher [--x X] [--y Y] [--z Z] [--qx QX] [--qy QY] [--qz QZ] [--qw QW]
                                  [--roll ROLL] [--pitch PITCH] [--yaw YAW]
                                  --frame-id FRAME_ID --child-frame-id CHILD_FRAME_ID

Publish the pose of a frame in its parent, for good. What is not given is 0: no offset, no turn.

required arguments:
  --frame-id FRAME_ID              parent frame
  --child-frame-id CHILD_FRAME_ID  child frame id

optional arguments:
  --x X, --y Y, --z Z              translation, m
  --roll ROLL, --pitch PITCH, --yaw YAW
                                   rotation about the fixed axes x, then y, then z, rad
  --qx QX, --qy QY, --qz QZ, --qw QW
                                   or the rotation as a quaternion

deprecated:
  static_transform_publisher X Y Z YAW PITCH ROLL FRAME_ID CHILD_FRAME_ID
  static_transform_publisher X Y Z QX QY QZ QW FRAME_ID CHILD_FRAME_ID"""

_TRANSLATION = ('x', 'y', 'z')
_ANGLES = ('roll', 'pitch', 'yaw')
_QUATERNION = ('qx', 'qy', 'qz', 'qw')
_FRAMES = ('frame-id', 'child-frame-id')
_NUMBERS = (*_TRANSLATION, *_ANGLES, *_QUATERNION)
_OLD_FORMS = {
    8: (*_TRANSLATION, *reversed(_ANGLES), *_FRAMES),
    9: (*_TRANSLATION, *_QUATERNION, *_FRAMES),
}
_LETTERS = string.ascii_letters + string.digits


class TransformArgumentsError(UsageError):
    """The command line is wrong; text and exit code are those of the original."""

    exit_code = 1


@dataclass(frozen=True)
class StaticTransform:
    """The transform to publish."""

    frame_id: str
    child_frame_id: str
    transform: Transform


def parse(
    words: Sequence[str], warn: Callable[[str], object] = lambda text: None
) -> StaticTransform:
    """
    Read a command line, in its present or its deprecated form.

    Args:
        words: without the program and ROS arguments.
        warn: called with a line if the form is deprecated.

    Raises:
        ArgumentsError: the command line is wrong.
    """
    values, rest = _flags(words)
    if len(rest) in _OLD_FORMS:
        warn('Old-style arguments are deprecated; see --help for new-style arguments')
        if values:
            raise TransformArgumentsError(
                'Cannot specify both new-style (flags) and old-style (arguments)'
            )
        values = dict(zip(_OLD_FORMS[len(rest)], rest, strict=True))
    elif rest:
        raise TransformArgumentsError(
            f'Extra unparsed arguments on command-line: {" ".join(rest)}'
        )
    return _request(values)


def _flags(words: Sequence[str]) -> tuple[dict[str, str], list[str]]:
    """Return the values of the flags, and the other words."""
    values: dict[str, str] = {}
    others: list[str] = []
    rest = iter(words)
    for word in rest:
        name = word.removeprefix('--')
        if word == name or name not in (*_NUMBERS, *_FRAMES):
            others.append(word)
            continue
        value = next(rest, None)
        if value is None:
            raise TransformArgumentsError(f'Not enough arguments for {word}')
        values[name] = value
    return values, others


def _request(values: dict[str, str]) -> StaticTransform:
    """Return the transform of the given values. Raises ArgumentsError."""
    numbers = {name: _number(name, values[name]) for name in _NUMBERS if name in values}
    if not numbers.keys().isdisjoint(_ANGLES) and not numbers.keys().isdisjoint(_QUATERNION):
        raise TransformArgumentsError('Cannot specify both quaternion and Euler rotations')
    parent, child = (values.get(name, '') for name in _FRAMES)
    if not parent:
        raise TransformArgumentsError('Frame id must not be empty')
    if not child:
        raise TransformArgumentsError('Child frame id must not be empty')
    if parent.removeprefix('/') == child.removeprefix('/'):
        raise TransformArgumentsError(
            f"cannot publish static transform from '{parent}' to '{child}', exiting: "
            'child_frame_id cannot equal frame_id'
        )
    x, y, z = (numbers.get(name, 0.0) for name in _TRANSLATION)
    return StaticTransform(parent, child, Transform((x, y, z), _rotation(numbers)))


def _rotation(numbers: dict[str, float]) -> tuple[float, float, float, float]:
    if numbers.keys().isdisjoint(_QUATERNION):
        roll, pitch, yaw = (numbers.get(name, 0.0) for name in _ANGLES)
        return quaternion_from_rpy(roll, pitch, yaw)
    x, y, z = (numbers.get(name, 0.0) for name in _QUATERNION[:3])
    rotation = (x, y, z, numbers.get('qw', 1.0))
    if not is_unit(rotation):
        length = math.hypot(*rotation)
        raise TransformArgumentsError(
            f'The quaternion {rotation} (qx, qy, qz, qw) has the length {length:g} instead of 1, '
            'so every listener would ignore the transform'
            + (f'; of length 1 is {normalize(rotation)}' if length else '')
        )
    return normalize(rotation)


def _number(name: str, word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise TransformArgumentsError(f"Failed to parse --{name} argument as float: '{word}'")
    return value


class StaticTransformPublisher(Node):
    """The node: it publishes once, and keeps running for later subscribers."""

    def __init__(self, request: StaticTransform) -> None:
        suffix = ''.join(secrets.choice(_LETTERS) for _ in range(16))
        translation, rotation = request.transform.translation, request.transform.rotation
        values = {
            **{f'translation.{axis}': v for axis, v in zip('xyz', translation, strict=True)},
            **{f'rotation.{axis}': v for axis, v in zip('xyzw', rotation, strict=True)},
            'frame_id': request.frame_id,
            'child_frame_id': request.child_frame_id,
        }
        super().__init__(
            f'static_transform_publisher_{suffix}',
            parameter_overrides=[Parameter(name, value=value) for name, value in values.items()],
        )
        for name, value in values.items():
            self.declare_parameter(name, value, ParameterDescriptor(read_only=True))
        self.get_logger().info(
            'Spinning until stopped - publishing transform\n'
            f'translation: ({_quoted(translation)})\nrotation: ({_quoted(rotation)})\n'
            f"from '{request.frame_id}' to '{request.child_frame_id}'"
        )
        self._broadcaster = StaticTransformBroadcaster(self)
        self._broadcaster.sendTransform(self._message(request))

    def _message(self, request: StaticTransform) -> TransformStamped:
        now = self.get_clock().now().nanoseconds
        return transform_message(
            StampedTransform(request.frame_id, request.child_frame_id, now, request.transform)
        )


def publish(args: list[str] | None) -> int:
    """Publish, and keep running until Ctrl-C; return the exit code."""
    words = arguments_of(args)
    wants_help = not {'-h', '--help'}.isdisjoint(words)
    if wants_help or not words:
        print_now(USAGE)
        return 0 if wants_help else TransformArgumentsError.exit_code
    logger = get_logger('static_transform_publisher')
    try:
        request = parse(words, logger.warning)
    except TransformArgumentsError as error:
        logger.error(f'error parsing command line arguments: {error} (see --help)')
        return error.exit_code
    return run(lambda: StaticTransformPublisher(request), args)


def main(args: list[str] | None = None) -> int:
    """Publish, and keep running until Ctrl-C."""
    return run_tool(lambda: publish(args))


def _quoted(values: Sequence[float]) -> str:
    return ', '.join(f"'{value:f}'" for value in values)


if __name__ == '__main__':
    raise SystemExit(main())
