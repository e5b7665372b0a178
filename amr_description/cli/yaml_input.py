# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""YAML from a command line: values, or one line that says where it is wrong."""

from typing import Any

from amr_description.errors import AmrError, ParameterError
from amr_description.parameter_files import load_yaml, YamlError
from amr_description.text import shorten

_NOT_A_MAPPING = 'The passed value needs to be a dictionary in YAML format'


def read_mapping(text: str) -> dict[Any, Any]:
    """Read the fields of a message, ``{x: 1.0, y: 2.0}``. Raises AmrError."""
    value = read_value(text)
    if not isinstance(value, dict):
        raise AmrError(f'{_NOT_A_MAPPING}, {{field: value}}; this is {_kind(value)}')
    return value


def read_value(text: str) -> Any:
    """Read any value. Raises AmrError."""
    try:
        return load_yaml(text)
    except YamlError as error:
        place = 'line {}, column {}: '.format(*error.where) if error.where else ''
        raise AmrError(f'The passed value is not YAML: {place}{shorten(str(error))}') from error
    except ParameterError as error:
        raise AmrError(f'The passed value is not usable: {error}') from error


def _kind(value: Any) -> str:
    if value is None:
        return 'empty'
    if isinstance(value, list):
        return 'a list'
    return f"the {type(value).__name__} '{shorten(str(value))}'"
