# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Message, service and action classes by their names."""

import importlib
from types import ModuleType
from typing import Any

from amr_description.ament_index import packages
from amr_description.errors import AmrError
from amr_description.text import closest_match, did_you_mean, shorten

# An attribute that only the classes of each kind have, not their parts beside them.
_MARKS = {'msg': 'get_fields_and_field_types', 'srv': 'Request', 'action': 'Goal'}
_WORDS = {'msg': 'message', 'srv': 'service', 'action': 'action'}


def message_type(name: str, what: str = 'The passed message type') -> Any:
    """
    Return the class of ``package/msg/Name``, or ``package/Name``.

    Raises AmrError, which begins with ``what``.
    """
    return _interface(name, 'msg', f'{what} is invalid')


def service_type(name: str) -> Any:
    """Return the class of ``package/srv/Name``, or ``package/Name``. Raises AmrError."""
    other = name.split('/')[1:-1]
    if other in (['msg'], ['action']):
        raise AmrError(
            f"The passed type is not a service: '{shorten(name)}' is written as "
            f'{"a message" if other == ["msg"] else "an action"}'
        )
    return _interface(name, 'srv', 'The passed service type is invalid')


def action_type(name: str) -> Any:
    """Return the class of ``package/action/Name``, or ``package/Name``. Raises AmrError."""
    return _interface(name, 'action', 'The passed action type is invalid')


def type_name(interface: Any) -> str:
    """Return ``package/msg/Name`` of a message class, and so for a service or an action."""
    package, kind, *_ = interface.__module__.split('.')
    return f'{package}/{kind}/{interface.__name__}'


def _interface(name: str, kind: str, invalid: str) -> Any:
    path, _, last = name.rpartition('/')
    package, *middle = path.split('/')
    if middle not in ([], [kind]) or not package.isidentifier() or not last.isidentifier():
        raise AmrError(f"{invalid}: '{shorten(name)}' is not written as package/{kind}/Name")
    word = _WORDS[kind]
    try:
        module = importlib.import_module(f'{package}.{kind}')
    except ImportError as error:
        similar = closest_match(package, packages(), similarity=0.8)
        hint = (
            f'did you mean {similar}?'
            if similar
            else 'if it is in a workspace, source that first: source install/setup.bash'
        )
        raise AmrError(
            f"{invalid}: there is no package '{shorten(package)}' with {word}s; {hint}"
        ) from error
    found = getattr(module, last, None)
    if not hasattr(found, _MARKS[kind]):
        similar = _similar(module, last, kind)
        raise AmrError(f"{invalid}: {package} has no {word} '{shorten(last)}'{similar}")
    return found


def _similar(module: ModuleType, name: str, kind: str) -> str:
    names = [known for known, value in vars(module).items() if hasattr(value, _MARKS[kind])]
    return did_you_mean(name, names)
