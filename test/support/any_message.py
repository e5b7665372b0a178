# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of any content, well formed as DDS sees them; the line of a shell that sends one."""

import math
import random

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)
import yaml

from amr_description.ros.message_types import message_type

WORDS = (
    '', 'map', 'odom', 'base_link', 'base_footprint', 'world', 'amr', 'nope', '/', 'a/b', 'a b',
    '~', 'joint_wheel_front_left', 'AmrSystem', 'empty', '..', '/dev/zero', 'file:///etc/passwd',
    'package://amr_description/urdf/amr.urdf', '${1/0}', '\x1b[2J',
    'ü\U0001f916', '<robot name="x"><link name="a"/></robot>', '<robot', 'x' * 3000, 'nan', '-1',
)  # fmt: skip
NUMBERS = (
    0.0, -0.0, 1.0, -1.0, 0.1, 1e-300, 1e9, -1e9, 1e308, -1e308, math.nan, math.inf, -math.inf,
)  # fmt: skip
_RANGES = {
    'octet': (0, 255), 'char': (0, 255), 'int8': (-(2**7), 2**7 - 1), 'uint8': (0, 2**8 - 1),
    'int16': (-(2**15), 2**15 - 1), 'uint16': (0, 2**16 - 1), 'int32': (-(2**31), 2**31 - 1),
    'uint32': (0, 2**32 - 1), 'int64': (-(2**63), 2**63 - 1), 'uint64': (0, 2**64 - 1),
}  # fmt: skip
_LARGEST_FLOAT = 3.4e38


def any_message(kind, chance: random.Random):
    """Return a message of a class, each field of any value."""
    message = kind()
    for (name, _), slot in zip(
        kind.get_fields_and_field_types().items(), kind.SLOT_TYPES, strict=True
    ):
        if chance.random() < 0.8:
            setattr(message, name, _value(slot, chance, getattr(message, name)))
    return message


def _value(slot, chance, default):
    if isinstance(slot, AbstractNestedType):
        if isinstance(slot, Array):
            count = slot.size
        else:
            count = chance.choice((0, 1, 2, 3, 50))
            if isinstance(slot, BoundedSequence):
                count = min(count, slot.maximum_size)
        return [_value(slot.value_type, chance, None) for _ in range(count)]
    if isinstance(slot, NamespacedType):
        return any_message(message_type('/'.join(slot.namespaced_name())), chance)
    if isinstance(slot, AbstractGenericString):
        return chance.choice(WORDS)
    return _number(slot, chance)


def _number(slot: BasicType, chance):
    name = slot.typename
    if name == 'boolean':
        return chance.random() < 0.5
    if name in ('float', 'double'):
        number = chance.choice((*NUMBERS, chance.uniform(-10.0, 10.0)))
        return number if name == 'double' or not abs(number) > _LARGEST_FLOAT else 1.0
    low, high = _RANGES[{'byte': 'octet'}.get(name, name)]
    number = chance.choice((low, high, 0, 1, 2, 77, chance.randint(low, high)))
    number = min(max(number, low), high)
    return bytes([number]) if name == 'octet' else number


def plain(message):
    """Return a message as mappings, lists and numbers."""
    if hasattr(message, 'get_fields_and_field_types'):
        return {
            name: plain(getattr(message, name)) for name in message.get_fields_and_field_types()
        }
    if isinstance(message, bytes):
        return message[0]
    if isinstance(message, str | bool | int | float):
        return message
    return (
        [plain(each) for each in message.tolist()]
        if hasattr(message, 'tolist')
        else [plain(each) for each in message]
    )


def line(verb: str, name: str, type_name: str, message) -> str:
    """Return the line of a shell that sends a message again: ``ros2 topic pub -1 …``."""
    text = yaml.safe_dump(plain(message), default_flow_style=True, width=math.inf).strip()
    quoted = text.replace("'", "'\\''")
    return f"ros2 {verb} {name} {type_name} '{quoted}'"
