# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameters as the YAML that rcl reads.

Written by hand, as bring-up imports nothing but the standard library: a string is a JSON string,
which YAML reads as a double-quoted one, so that '5', 'true' and a URDF arrive as they are.
"""

from collections.abc import Iterator, Mapping, Sequence
import json
import math
from pathlib import Path
import re

from amr_description.bringup.description import ParameterValue
from amr_description.errors import BringupError

# JSON leaves these as they are, YAML forbids them or reads them as line ends.
_UNPRINTABLE = re.compile('[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff]')


def node_key(name: str | None, namespace: str | None) -> str:
    """Return the name that a node's parameters stand under: its full name if known, else all."""
    if name and namespace:
        return f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    return '/**'


def yaml_text(key: str, parameters: Mapping[str, ParameterValue]) -> str:
    """Return a parameter file for one node; nested tables become dotted names."""
    lines = [f'{_string(key)}:', '  ros__parameters:']
    lines += [f'    {_string(k)}: {_value(k, v)}' for k, v in flat(parameters)]
    return '\n'.join(lines) + '\n'


def flat(parameters: Mapping[str, ParameterValue]) -> Iterator[tuple[str, ParameterValue]]:
    """Yield (dotted name, value) of every parameter of a nested table."""
    for name, value in parameters.items():
        if not isinstance(name, str):
            raise BringupError(f'the name of a parameter is {name!r}, which is no text')
        if isinstance(value, Mapping):
            yield from ((f'{name}.{below}', v) for below, v in flat(value))
        else:
            yield name, value


def _value(name: str, value: ParameterValue) -> str:
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):
        if not value:
            raise BringupError(
                f"parameter '{name}' is an empty list, which has no type in ROS; leave it out"
            )
        if len({type(element) for element in value}) > 1:
            raise BringupError(
                f"parameter '{name}' has elements of several types: {list(value)}; "
                'a ROS array has one'
            )
        return f'[{", ".join(_scalar(name, element) for element in value)}]'
    return _scalar(name, value)


def _scalar(name: str, value: object) -> str:
    match value:
        case bool():
            return 'true' if value else 'false'
        case int() if -(2**63) <= value < 2**63:
            return str(value)
        case float() if math.isfinite(value):
            return repr(value)
        case float():
            return '.nan' if math.isnan(value) else f'{"-" if value < 0 else ""}.inf'
        case str() | Path() if '\0' not in str(value):
            return _string(str(value))
    raise BringupError(
        f"parameter '{name}' is {value!r}, a {type(value).__name__}; it can be bool, "
        'int (64 bit), float, str (without NUL) or a list of one of them'
    )


def _string(text: str) -> str:
    quoted = json.dumps(text, ensure_ascii=False)
    return _UNPRINTABLE.sub(lambda match: f'\\u{ord(match[0]):04x}', quoted)
