# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which publisher a message is of: its gid, which rcl knows and rclpy keeps to itself.

rclpy's message info has the number that a publisher gave a message, and not whose number it is. So
this calls rcl (Jazzy, ``rcl/subscription.h``) in the library that rclpy has loaded.
"""

import ctypes
from functools import cache
from typing import NamedTuple

from rclpy.subscription import Subscription


class Allocator(ctypes.Structure):
    """``rcutils_allocator_t``."""

    _fields_ = (('functions', ctypes.c_void_p * 4), ('state', ctypes.c_void_p))


class SerializedMessage(ctypes.Structure):
    """``rcl_serialized_message_t`` and ``rmw_serialized_message_t``: bytes to be filled."""

    _fields_ = (
        ('buffer', ctypes.c_void_p),
        ('length', ctypes.c_size_t),
        ('capacity', ctypes.c_size_t),
        ('allocator', Allocator),
    )

    def copied(self) -> bytes:
        """Return a copy."""
        return ctypes.string_at(self.buffer, self.length)


_GID = 16
_LIBRARY = 'librcl.so'  # symbols are looked for in what it was linked to, too


class MessageOfPublisher(NamedTuple):
    """
    A message.

    Attributes:
        data: Its bytes.
        received: The system time when DDS received it, ns.
        gid: Of its publisher, as ``TopicEndpointInfo.endpoint_gid`` has it.
    """

    data: bytes
    received: int
    gid: bytes


def take_with_gid(subscription: Subscription) -> MessageOfPublisher | None:
    """
    Take the next message of a subscription that no executor serves; None: none has come.

    Raises:
        InvalidHandle: The subscription was destroyed.
        OSError: rcl is not there, or not that of Jazzy.
    """
    rcl = _rcl()
    message = SerializedMessage(allocator=rcl.rcutils_get_default_allocator())
    info = _MessageInfo()
    try:
        handle = subscription.handle
        with handle:
            code = rcl.rcl_take_serialized_message(
                ctypes.c_void_p(handle.pointer), ctypes.byref(message), ctypes.byref(info), None
            )
        if code:
            return None
        return MessageOfPublisher(message.copied(), info.received, bytes(info.gid))
    finally:
        rcl.rcutils_uint8_array_fini(ctypes.byref(message))


class _MessageInfo(ctypes.Structure):
    """``rmw_message_info_t``."""

    _fields_ = (
        ('sent', ctypes.c_int64),
        ('received', ctypes.c_int64),
        ('publication_sequence_number', ctypes.c_uint64),
        ('reception_sequence_number', ctypes.c_uint64),
        ('implementation', ctypes.c_char_p),
        ('gid', ctypes.c_uint8 * _GID),
        ('is_from_this_process', ctypes.c_bool),
    )


@cache
def _rcl() -> ctypes.CDLL:
    """Return the library that rclpy has loaded. Raises OSError."""
    library = ctypes.CDLL(_LIBRARY)
    try:
        library.rcl_take_serialized_message.restype = ctypes.c_int
        library.rcutils_get_default_allocator.restype = Allocator
        library.rcutils_uint8_array_fini.restype = ctypes.c_int
    except AttributeError as error:
        raise OSError(str(error)) from error
    return library
