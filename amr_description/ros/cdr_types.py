# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The layouts of message classes of rosidl; this module imports no rclpy."""

from functools import cache
import importlib
from typing import Any

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

from amr_description.cdr.layouts import CODES, FieldGroup, group, Layout, many, Number, Text


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
