# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where the parameter files of a spawner speak of a controller, and what it takes from there."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from amr_description.errors import ParameterError
from amr_description.nodes.parameter_files import read_parameter_file
from amr_description.nodes.ros_arguments import ros_arguments

_WILDCARD = '/**'
_KEY = 'ros__parameters'


def files_in_arguments(words: Sequence[str]) -> list[str]:
    """Return the files behind ``--params-file`` among the ROS arguments of a command line."""
    pairs = pairwise(ros_arguments(words))
    return [str(Path(file).absolute()) for flag, file in pairs if flag == '--params-file']


def controller_entries(
    name: str, files: Sequence[str], namespace: str
) -> dict[str, dict[str, Any]]:
    """
    Return file → what it says of a controller, for those files that do; perhaps none.

    Looked for as ``name``, ``/ns/name``, ``/**/name``, ``/**/ns/name``, the same below ``/**``,
    and as ``/**``. Raises ParameterError: a file is no good, or all that speak of the controller
    lack the ``namespace`` that it has.
    """
    entries, lacking = {}, False
    for path in dict.fromkeys(files):
        content = _read(name, path, namespace)
        parameters = parameters_of(name, content, namespace)
        if parameters is not None:
            entries[path] = parameters
        lacking |= parameters is None and name in content
    if lacking and not entries:
        raise ParameterError(
            f'Missing namespace : {namespace} or wildcard in parameter file for controller : '
            f'{name}'
        )
    return entries


def not_found(name: str, files: Sequence[str]) -> str:
    """Say that none of the files speaks of a controller."""
    return f'Controller : {name} parameters not found in parameter files : {list(files)}'


def manager_parameters(
    name: str, entries: Mapping[str, Mapping[str, Any]]
) -> dict[str, str | list[str]]:
    """
    Return what to set at the manager before it loads a controller, below the controller's name.

    ``entries``: of :func:`controller_entries`. The first file that names a type or fallback
    controllers counts. Raises ParameterError: one of these is no text.
    """
    if not entries:
        return {}
    parameters: dict[str, str | list[str]] = {'params_file': list(entries)}
    for path, entry in entries.items():
        if entry.get('type') and 'type' not in parameters:
            parameters['type'] = _text(entry['type'], name, 'type', path)
        if entry.get('fallback_controllers') and 'fallback_controllers' not in parameters:
            found = entry['fallback_controllers']
            names = found if isinstance(found, list) else [found]
            parameters['fallback_controllers'] = [
                _text(each, name, 'fallback_controllers', path) for each in names
            ]
    return parameters


def parameters_of(name: str, content: Mapping[str, Any], namespace: str) -> dict[str, Any] | None:
    """Return the parameters of a controller in the content of one file, or ``None``."""
    for entry in _candidates(name, content, namespace.strip('/')):
        if isinstance(entry, dict) and _KEY in entry:
            return dict(entry[_KEY] or {})
    return None


def _candidates(name: str, content: Mapping[str, Any], namespace: str) -> Iterator[Any]:
    inside = f'/{namespace}' if namespace else ''
    keys = [f'{inside}/{name}', f'{_WILDCARD}/{name}', f'{_WILDCARD}{inside}/{name}']
    if not namespace:
        keys.insert(0, name)
    yield from (content.get(key) for key in keys)
    if namespace:
        yield content.get(inside, content.get(namespace, {})).get(name)
    wildcard = content.get(_WILDCARD, {})
    yield from (wildcard.get(key) for key in (name, *keys))
    yield wildcard


def _read(name: str, path: str, namespace: str) -> dict[str, Any]:
    try:
        return read_parameter_file(Path(path))
    except ParameterError as error:
        node = f'{namespace.rstrip("/")}/{name}'
        raise ParameterError(
            f'YAML file : {path} is not a valid ROS parameter file for controller node : {node}: '
            f'{error}'
        ) from error


def _text(value: Any, name: str, key: str, path: str) -> str:
    if not isinstance(value, str):
        raise ParameterError(f"'{key}' of controller {name} in {path} is {value!r}, not a name")
    return value
