# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Message classes by their names."""

import difflib
import importlib
from typing import Any

from amr_description.errors import AmrError

_INVALID = 'The passed message type is invalid'


def message_type(name: str) -> Any:
    """Return the class of ``package/msg/Name``, or ``package/Name``. Raises AmrError."""
    package, *middle, message = name.split('/')
    if middle not in ([], ['msg']) or not package.isidentifier() or not message.isidentifier():
        raise AmrError(f"{_INVALID}: '{name}' is not written as package/msg/Name")
    try:
        module = importlib.import_module(f'{package}.msg')
    except ImportError as error:
        raise AmrError(f"{_INVALID}: there is no package '{package}' with messages") from error
    found = getattr(module, message, None)
    if not hasattr(found, 'get_fields_and_field_types'):
        raise AmrError(
            f"{_INVALID}: {package} has no message '{message}'{_similar(module, message)}"
        )
    return found


def type_name(message: Any) -> str:
    """Return ``package/msg/Name`` of a message class."""
    package, kind, *_ = message.__module__.split('.')
    return f'{package}/{kind}/{message.__name__}'


def _similar(module: Any, message: str) -> str:
    names = [name for name in vars(module) if name[0].isupper()]
    close = difflib.get_close_matches(message, names, n=3)
    return f'; did you mean {" or ".join(close)}?' if close else ''
