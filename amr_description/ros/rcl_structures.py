# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Structures of rcl (Jazzy, ``rcutils/types/uint8_array.h``) for those who call it by ctypes."""

import ctypes


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
