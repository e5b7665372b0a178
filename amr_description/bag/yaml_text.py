# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""YAML of bags, whoever wrote it: what is wrong with it is one line, and it cannot end Python."""

from typing import Any

import yaml

from amr_description.errors import BagError, ParameterError
from amr_description.parameter_files import load_yaml
from amr_description.text import shorten

_LOADER: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)
_DUMPER: Any = getattr(yaml, 'CSafeDumper', yaml.SafeDumper)
_DEEPEST = 1000
_MOST_SHOWN = 8  # of a list or mapping


def load(text: str, what: str) -> Any:
    """Return what a text means. Raises BagError, which begins with ``what``."""
    try:
        return load_yaml(text, _load)
    except ParameterError as error:
        raise BagError(f'{what}: not YAML: {shorten(str(error))}') from error


def dump(value: Any) -> str:
    """Return the YAML of a value, its keys in their order."""
    return str(yaml.dump(value, Dumper=_DUMPER, sort_keys=False))


def shown(value: Any) -> str:
    """Return a value of YAML for a message. Aliases make a short text a value without end."""
    children: list[Any] = []
    if isinstance(value, dict):
        children = [*value.keys(), *value.values()]
    elif isinstance(value, (list, set, tuple)):
        children = [*value]
    if len(children) > 2 * _MOST_SHOWN or any(
        isinstance(each, (dict, list, set, tuple)) for each in children
    ):
        return f'a {type(value).__name__} of {len(value)}'
    try:
        return shorten(repr(value))
    except ValueError:  # Python does not write an integer of more than 4300 digits
        return 'a long number'


def word(value: Any) -> str:
    """Return the text of a scalar; of none the empty text. Raises TypeError: it is none."""
    if isinstance(value, (dict, list, set, tuple)):
        raise TypeError(f'want a text, not {shown(value)}')
    return '' if value is None else str(value)


def _load(text: str) -> Any:
    # The library in C calls itself at each level, and crashes when the stack is full. A level
    # takes a bracket, or a column.
    brackets = text.count('[') + text.count('{')
    if brackets + max(map(len, text.splitlines()), default=0) > _DEEPEST:
        depth = 0
        for event in yaml.parse(text, Loader=_LOADER):
            depth += isinstance(event, yaml.CollectionStartEvent)
            depth -= isinstance(event, yaml.CollectionEndEvent)
            if depth > _DEEPEST:
                raise RecursionError
    return yaml.load(text, Loader=_LOADER)  # noqa: S506 - a safe one
