# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was typed as YAML -> a mapping, or one line that says where it is wrong."""

from typing import Any

import yaml

from amr_description.errors import AmrError
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
        return yaml.safe_load(text)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f'line {mark.line + 1}, column {mark.column + 1}: ' if mark else ''
        problem = shorten(str(error.problem))
        raise AmrError(f'The passed value is not YAML: {place}{problem}') from error
    except yaml.reader.ReaderError as error:
        raise AmrError(
            f'The passed value is not YAML: character {error.position + 1} is '
            f'{_code_point(error.character)}, which YAML does not allow'
        ) from error
    except RecursionError as error:
        raise AmrError('The passed value is not usable: it is nested too deeply') from error
    except ValueError as error:  # a date such as 2026-99-99, an integer of 5000 digits
        raise AmrError(f'The passed value is not YAML: {error}') from error


def _code_point(character: int | str | bytes) -> str:
    """PyYAML reports a number, but its own annotations allow the character."""
    return f'U+{character if isinstance(character, int) else ord(character):04X}'


def _kind(value: Any) -> str:
    if value is None:
        return 'empty'
    if isinstance(value, list):
        return 'a list'
    return f"the {type(value).__name__} '{shorten(str(value))}'"
