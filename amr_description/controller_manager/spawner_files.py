# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What parameter files say of a controller that is to be spawned."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from amr_description.errors import ParameterError
from amr_description.parameter_files import EVERY_NODE, read_parameter_file, sections
from amr_description.ros_arguments import files_in, ros_arguments


def files_in_arguments(words: Sequence[str]) -> list[str]:
    """Return the files behind ``--params-file`` among the ROS arguments of a command line."""
    return [str(Path(file).absolute()) for file in files_in(ros_arguments(words))]


def controller_entries(
    name: str, files: Sequence[str], namespace: str
) -> dict[str, dict[str, Any]]:
    """
    Return a controller's parameters in each of the files that have any.

    Raises ParameterError: a file is no good, or all that speak of the controller lack the
    ``namespace`` that it has.
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
    """Return the message that no file has parameters for a controller."""
    return f'Controller : {name} parameters not found in parameter files : {list(files)}'


def type_for_the_manager(name: str, files: Sequence[str], namespace: str) -> str:
    """Return what would do where a file has the type for the manager alone; '': none has."""
    for path in files:
        for section in sections(_read(name, path, namespace)):
            entry = dict(section.parameters or {}).get(name)
            if isinstance(entry, Mapping) and entry.get('type'):
                return (
                    f'{path} has a type for it in the section {section.pattern}, which only the '
                    f'manager reads: write type: {entry["type"]} below '
                    f'{name}: ros__parameters:, too'
                )
    return ''


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
    node = f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    found = [section for section in sections(content) if section.is_of(node)]
    if not found:
        return None
    # Its own name comes before patterns, and these before the one that is for all nodes.
    own = min(found, key=lambda each: (each.pattern == EVERY_NODE, '*' in each.pattern))
    return dict(own.parameters or {})


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
