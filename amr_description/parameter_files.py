# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ROS parameter files, checked before rcl reads them.

rcl says of a faulty file where its C source gave up; this says where the file is wrong.
"""

from pathlib import Path
from typing import Any

import yaml

from amr_description.errors import ParameterError
from amr_description.text import unwrap

_SHAPE = 'a parameter file is written as  node_name: {ros__parameters: {name: value}}'


def read_parameter_file(path: Path) -> dict[str, Any]:
    """
    Return a parameter file as YAML gives it: nodes, perhaps below their namespaces.

    :raises ParameterError: It is no good; with line and column where there are any.
    """
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise ParameterError(f"parameter file '{path}': {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ParameterError(f"parameter file '{path}': not UTF-8 text ({error})") from error
    try:
        content = yaml.safe_load(text)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        place = f':{mark.line + 1}:{mark.column + 1}' if mark else ''
        raise ParameterError(f'{path}{place}: {error.problem}') from error
    except yaml.YAMLError as error:
        raise ParameterError(f'{path}: {unwrap(str(error))}') from error
    except RecursionError as error:
        raise ParameterError(f'{path}: nested too deeply') from error
    except ValueError as error:  # a date such as 2026-99-99, an integer of 5000 digits
        raise ParameterError(f'{path}: {error}') from error
    if not isinstance(content, dict) or not content:
        raise ParameterError(f"parameter file '{path}' holds no node; {_SHAPE}")
    try:
        _require_nodes(content, path)
    except RecursionError as error:  # an anchor that holds itself
        raise ParameterError(f'{path}: nested too deeply') from error
    return content


def _require_nodes(content: dict, path: Path, above: str = '') -> None:
    """Every key is a node, or a namespace with nodes below it."""
    for key, value in content.items():
        name = f'{above}{key}'
        if not isinstance(value, dict):
            raise ParameterError(
                f"parameter file '{path}': below '{name}' stands {value!r}, and no "
                f'ros__parameters; {_SHAPE}'
            )
        if 'ros__parameters' not in value:
            _require_nodes(value, path, f'{name}/')
