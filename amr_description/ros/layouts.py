# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of rclpy as bytes: their layouts, their templates, equal bytes of equal messages."""

from collections.abc import Collection
from functools import cache
import importlib
from typing import Any

from rclpy.serialization import serialize_message
from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

from amr_description.cdr import template
from amr_description.cdr.layouts import CODES, FieldGroup, group, Layout, many, Number, Text
from amr_description.cdr.padding import without_padding
from amr_description.cdr.template import Template


@cache
def layout_of(message_type: Any) -> FieldGroup:
    """Return the layout of the messages of a class."""
    module, name = message_type.__module__.split('.')[0], message_type.__name__
    slots = zip(message_type.get_fields_and_field_types(), message_type.SLOT_TYPES, strict=True)
    return group(f'{module}/msg/{name}', [(field, _layout(slot)) for field, slot in slots])


def _layout(slot: Any) -> Layout:
    if isinstance(slot, BasicType):
        return Number(CODES[slot.typename], slot.typename)
    if isinstance(slot, AbstractString):
        return Text()
    if isinstance(slot, AbstractWString):
        return Text(width=4)
    if isinstance(slot, NamespacedType):
        module = importlib.import_module('.'.join(slot.namespaces))
        return layout_of(getattr(module, slot.name))
    assert isinstance(slot, AbstractNestedType), f'{slot} is no type of a field'
    element = _layout(slot.value_type)
    return many(element, slot.size if isinstance(slot, Array) else None)


# --- Equal bytes of equal messages ---------------------------------------------------------------
#
# What aligns numbers has whatever was in memory, where rclpy serializes; here it is zero.


def serialize(message: Any) -> bytes:
    """Return the bytes of a message, which are those of every equal one."""
    kind: Any = type(message)
    return without_padding(layout_of(kind), bytes(serialize_message(message)))


def template_of(
    message: Any, changing: Collection[str], *, blocks: Collection[str] = ()
) -> Template:
    """Return the template of a message of rclpy; see that of the same name there."""
    kind: Any = type(message)
    return template.template_of(layout_of(kind), message, changing, blocks=blocks)


def is_that_of(message: Any, data: bytes, made: Template) -> bool:
    """Return whether bytes that a template has made are those that rclpy makes of a message."""
    return made.has_made(data, serialize_message(message))
