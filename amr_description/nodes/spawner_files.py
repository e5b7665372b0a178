# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where a spawner's parameter file speaks of a controller."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from amr_description.errors import ParameterError
from amr_description.nodes.parameter_files import read_parameter_file

_WILDCARD = '/**'
_KEY = 'ros__parameters'


def find_controller(name: str, files: Sequence[str], namespace: str) -> dict[str, Any]:
    """
    Return the controller's parameters from the first file that has them.

    Looked for as ``name``, ``/ns/name``, ``/**/name``, ``/**/ns/name``, or below ``/**``. Raises
    ParameterError: in none of the files, or only without the namespace that it needs.
    """
    for path in files:
        content = read_parameter_file(Path(path))
        parameters = parameters_of(name, content, namespace)
        if parameters is not None:
            return parameters
        if name in content:
            raise ParameterError(
                f'Missing namespace : {namespace} or wildcard in parameter file for controller : '
                f'{name}'
            )
    raise ParameterError(
        f'Controller : {name} parameters not found in parameter files : {list(files)}'
    )


def manager_parameters(
    name: str, files: Sequence[str], namespace: str
) -> dict[str, str | list[str]]:
    """
    Return what to set at the manager before it loads a controller, below the controller's name.

    ``files``: absolute paths; the first that speaks of the controller may name its type. Raises
    ParameterError as :func:`find_controller`.
    """
    if not files:
        return {}
    entry = find_controller(name, files, namespace)
    named = {key: entry[key] for key in ('type', 'fallback_controllers') if key in entry}
    return {'params_file': list(files), **named}


def parameters_of(
    name: str, content: Mapping[str, Any], namespace: str
) -> dict[str, Any] | None:
    """Return the parameters of a controller in the content of one file, or ``None``."""
    inner = namespace.strip('/')
    keys = [f'/{inner}/{name}', f'{_WILDCARD}/{name}', f'{_WILDCARD}/{inner}/{name}']
    if not inner:
        keys = [name, f'/{name}', f'{_WILDCARD}/{name}']
    wildcard = content.get(_WILDCARD, {})
    for entry in (
        *(content.get(key) for key in keys),
        content.get(f'/{inner}', content.get(inner, {})).get(name) if inner else None,
        wildcard.get(name),
        wildcard if _KEY in wildcard else None,
    ):
        if entry is not None and _KEY in entry:
            return dict(entry[_KEY])
    return None
