# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages serialized so that equal ones have equal bytes.

What aligns numbers has whatever was in memory, where rclpy serializes; here it is zero.
"""

from typing import Any

from rclpy.serialization import serialize_message

from amr_description.cdr.padding import without_padding
from amr_description.ros.cdr_types import layout_of


def serialize(message: Any) -> bytes:
    """Return the bytes of a message, which are those of every equal one."""
    kind: Any = type(message)
    return without_padding(layout_of(kind), bytes(serialize_message(message)))
