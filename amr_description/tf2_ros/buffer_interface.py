# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``Buffer.transform``: points, poses and clouds from frame to frame, by what packages register.

A package such as tf2_geometry_msgs says once, when it is imported, how a message is transformed
and how other types are made of it; both registrations are of the whole process, as in tf2_ros.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar

from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from std_msgs.msg import Header

from amr_description.errors import TypeException
from amr_description.ros.messages import nanoseconds


class TransformRegistration:
    """How messages of a type are transformed: ``do_transform(message, transform)``."""

    _by_type: ClassVar[dict[type, Callable[[Any, TransformStamped], Any]]] = {}

    def print_me(self) -> None:
        """Print what is registered."""
        print(self._by_type)

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register a type, in place of what it had before."""
        self._by_type[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """Return how a type is transformed. Raises TypeException."""
        return _registered(self._by_type, key, key)


class ConvertRegistration:
    """How objects are made of messages, messages of objects, and objects of objects."""

    _from_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _to_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _convert: ClassVar[dict[Any, Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register what makes an object of this type of a message."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register what makes a message of an object of this type."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register what makes an object of the second type of one of the first."""
        self._convert[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """Return what makes an object of this type of a message. Raises TypeException."""
        return _registered(self._from_msg, key, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """Return what makes a message of an object of this type. Raises TypeException."""
        return _registered(self._to_msg, key, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """Return what makes the second type of the first. Raises TypeException."""
        return _registered(self._convert, key, key[1])


def _registered(table: dict[Any, Callable[..., Any]], key: Any, kind: type) -> Callable[..., Any]:
    if key not in table:
        name = f'{kind.__module__}.{kind.__qualname__}'
        raise TypeException(
            f'Type {name} is not loaded or supported; import what registers it, such as '
            'tf2_geometry_msgs or tf2_sensor_msgs'
        )
    return table[key]


def convert(a: Any, b_type: type) -> Any:
    """Return an object of another type that says the same, or a copy. Raises TypeException."""
    registration = ConvertRegistration()
    try:
        return registration.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
    return registration.get_from_msg(b_type)(registration.get_to_msg(type(a))(a))


def nanoseconds_of(time: Time | TimeMessage) -> int:
    """Return a time, of rclpy or of a message, in ns."""
    return time.nanoseconds if isinstance(time, Time) else nanoseconds(time)


def Stamped(obj: Any, stamp: TimeMessage, frame_id: str) -> Any:  # noqa: N802 - as in tf2_ros
    """Give an object a header, and return it."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class BufferInterface(ABC):
    """What a buffer, and a client of one elsewhere, have in common."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - never changed
        new_type: type | None = None,
    ) -> Any:
        """
        Return an object with a header in another frame.

        Args:
            object_stamped: what is transformed, from the frame and at the time of its header.
            target_frame: the frame of the result.
            timeout: how long to wait for the transform.
            new_type: what the result is converted to.

        Raises:
            TransformException: the transform is not known by then.
            TypeException: the type is not registered.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        result = do_transform(object_stamped, transform)
        return result if new_type is None else convert(result, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
        new_type: type | None = None,
    ) -> Any:
        """Return an object in another frame at another time; see :meth:`transform`."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        result = do_transform(object_stamped, transform)
        return result if new_type is None else convert(result, new_type)

    @abstractmethod
    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> TransformStamped:
        """Return the pose of ``source_frame`` in ``target_frame``."""

    @abstractmethod
    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> TransformStamped:
        """Return the pose of ``source_frame`` at one time in ``target_frame`` at another."""
