# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameter values: as they are typed, as Python has them, as ROS sends them.

What is typed is YAML 1.1: ``off`` is a truth value, ``5`` an integer, ``5.0`` a double, ``"5"`` a
string, ``[1.0, 2.0]`` an array of doubles. What YAML knows but ROS does not, a mapping, a date, a
list of several types, is the string that it looks like.
"""

from collections.abc import Callable
import json
import sys
from typing import Any, TypeAlias

from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy.parameter import Parameter
import yaml

from amr_description.cli.yaml_input import read_value
from amr_description.errors import AmrError, ParameterError
from amr_description.text import shorten

Value: TypeAlias = bool | int | float | str | list[Any] | None

TYPE_NAMES = {
    ParameterType.PARAMETER_NOT_SET: 'not set',
    ParameterType.PARAMETER_BOOL: 'boolean',
    ParameterType.PARAMETER_INTEGER: 'integer',
    ParameterType.PARAMETER_DOUBLE: 'double',
    ParameterType.PARAMETER_STRING: 'string',
    ParameterType.PARAMETER_BYTE_ARRAY: 'byte array',
    ParameterType.PARAMETER_BOOL_ARRAY: 'boolean array',
    ParameterType.PARAMETER_INTEGER_ARRAY: 'integer array',
    ParameterType.PARAMETER_DOUBLE_ARRAY: 'double array',
    ParameterType.PARAMETER_STRING_ARRAY: 'string array',
}
_SCALARS = (bool, int, float, str)
_INTEGERS = range(-(2**63), 2**63)


def typed(text: str) -> Value:
    """Return what stands behind a parameter's name on a command line. Raises AmrError."""
    if text.lstrip().startswith('<'):
        return text  # XML, such as a robot_description: as YAML it would lose lines, or fail
    try:
        value = read_value(text)
    except AmrError as error:
        if isinstance(error.__cause__ and error.__cause__.__cause__, yaml.parser.ParserError):
            return text  # '[left' may be meant, and the genuine command takes it
        quoting = f'; for a string write {_quoted(text)}' if shorten(text) == text else ''
        raise AmrError(f'{error}{quoting}') from error
    return value if has_type(value) else text


def has_type(value: Any) -> bool:
    """Return whether a value from YAML can be the value of a parameter."""
    elements = value if isinstance(value, list) else [value]
    kinds = {type(element) for element in elements}
    if kinds == {bytes}:  # what dump writes of a byte array
        return isinstance(value, list) and all(len(element) == 1 for element in value)
    return len(kinds) <= 1 and kinds.issubset(_SCALARS)


def to_message(value: Value, wanted: int = ParameterType.PARAMETER_NOT_SET) -> ParameterValue:
    """
    Return a value as a message.

    Args:
        value: the value.
        wanted: the type of the parameter; an empty list gets it if it is that of an array.

    Raises:
        ParameterError: an integer is too large.
    """
    if value == []:
        is_array = TYPE_NAMES[wanted].endswith('array')
        return ParameterValue(type=wanted if is_array else ParameterType.PARAMETER_BOOL_ARRAY)
    for element in value if isinstance(value, list) else [value]:
        if isinstance(element, int) and element not in _INTEGERS:
            raise ParameterError(
                f'{shorten(str(element))} does not fit into the 64 bits of an integer parameter'
            )
    return Parameter('', value=value).get_parameter_value()


def as_text(value: Value) -> str:
    """Return a value as it is typed."""
    text = yaml.safe_dump(value, default_flow_style=True, allow_unicode=True, width=sys.maxsize)
    return text.removesuffix('...\n').strip()


def advice(text: str, wanted: int) -> str:
    """Return the type of the parameter, and how to write ``text`` with this type."""
    kind = TYPE_NAMES[wanted]
    article = 'an' if kind.startswith('integer') else 'a'
    try:
        instead = _rewritten(text, wanted)
    except AmrError as error:
        return f'it is {article} {kind}. {error}'
    return f'it is {article} {kind}' + (f': write {shorten(instead)}' if instead else '')


def _rewritten(text: str, wanted: int) -> str:
    """
    Return the same value with another type, as YAML; '' if that type has no such value.

    Raises AmrError if ``text`` is not YAML.
    """
    if wanted == ParameterType.PARAMETER_BOOL:
        return 'true or false'
    if wanted == ParameterType.PARAMETER_STRING:
        return _quoted(text)
    number = _NUMBERS.get(wanted)
    if number is None:
        return ''
    try:
        value = read_value(text)
        if TYPE_NAMES[wanted].endswith('array'):
            value = [number(each) for each in (value if isinstance(value, list) else [value])]
        else:
            value = number(value)
    except (OverflowError, TypeError, ValueError):
        return ''
    return as_text(value)


def _quoted(text: str) -> str:
    """Return a YAML string, quoted for a shell."""
    return f"'{json.dumps(shorten(text), ensure_ascii=False)}'"


def _integer(value: Any) -> int:
    """Return a whole number. Raises TypeError or ValueError if it is not one."""
    if float(value) != int(value):
        raise ValueError
    return int(value)


_NUMBERS: dict[int, Callable[[Any], float]] = {
    ParameterType.PARAMETER_INTEGER: _integer,
    ParameterType.PARAMETER_INTEGER_ARRAY: _integer,
    ParameterType.PARAMETER_DOUBLE: float,
    ParameterType.PARAMETER_DOUBLE_ARRAY: float,
}
