# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What forms of messages have: fields with their defaults, and constants that stand for values."""

from collections.abc import Mapping
from functools import cache
from typing import Any

from amr_description.cdr.layouts import FieldGroup, Layout, Many, Text
from amr_description.ros.layouts import layout_of
from amr_description.ros.message_types import action_type, message_type, service_type
from amr_description.viewer.backend import Answer
from amr_description.viewer.forms import FieldInfo
from amr_description.viewer.requests import Definition


async def define(request: Definition, _: str) -> Answer:
    """Answer with the fields of the messages of a type. Raises AmrError."""
    kind = sent_type(request.message)
    return Answer(request.message, _fields(layout_of(kind), kind()))


def sent_type(name: str) -> Any:
    """Return the class of a message, of a service's request, of an action's goal."""
    match name.split('/')[1:-1]:
        case ['srv']:
            return service_type(name).Request
        case ['action']:
            return action_type(name).Goal
        case _:
            return message_type(name)


def _fields(layout: FieldGroup, example: Any) -> tuple[FieldInfo, ...]:
    return tuple(
        _field(name, each, getattr(example, name), constants_of(type(example), layout, name))
        for name, each in layout.fields
    )


def constants_of(kind: Any, layout: FieldGroup, name: str) -> dict[str, Any]:
    """Return constants of a message that may be values of a field: its own, else of no field."""
    constants = _constants(kind)
    claimed = {
        field: {each: value for each, value in constants.items() if _is_named_by(each, field)}
        for field, _ in layout.fields
    }
    return claimed[name] or {
        each: value
        for each, value in constants.items()
        if not any(each in of_field for of_field in claimed.values())
    }


@cache
def _constants(kind: Any) -> dict[str, Any]:
    """Return the constants of a message, by their values; not the defaults of its fields."""
    names = [each for each in dir(kind) if each.isupper() and each != 'SLOT_TYPES']
    found = {each: getattr(kind, each) for each in names if not each.endswith('__DEFAULT')}
    plain = {name: ord(each) if _is_octet(each) else each for name, each in found.items()}
    return dict(sorted(plain.items(), key=lambda each: (str(type(each[1])), each[1])))


def _is_named_by(constant: str, field: str) -> bool:
    """Whether a constant is of a field by its name, as ``STATE_PLAYING`` is of ``state``."""
    return constant.startswith(f'{field.upper()}_')


def _field(name: str, layout: Layout, value: Any, constants: Mapping[str, Any]) -> FieldInfo:
    if isinstance(layout, Many):
        element = layout.element
        inner = () if not isinstance(element, FieldGroup) else _fields(element, _example(element))
        return FieldInfo(name, _kind(element), layout.count or 0, inner, None, {})
    if isinstance(layout, FieldGroup):
        return FieldInfo(name, layout.name, None, _fields(layout, value), None, {})
    default = ord(value) if _is_octet(value) else value
    fitting = {
        constant: each for constant, each in constants.items() if type(each) is type(default)
    }
    return FieldInfo(name, _kind(layout), None, (), default, fitting)


def _example(layout: FieldGroup) -> Any:
    return message_type(layout.name)()


def _is_octet(value: Any) -> bool:
    return isinstance(value, bytes) and len(value) == 1


def _kind(layout: Layout) -> str:
    if isinstance(layout, Text):
        return 'wstring' if layout.is_wide else 'string'
    assert not isinstance(layout, Many), 'an array has no arrays'
    return layout.name
