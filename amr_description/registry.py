# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tables from a name to ``module:attribute``, imported only when used.

``ros2 --help`` and a talker must not pay for MuJoCo or for a controller that nobody loads.
"""

from collections.abc import Mapping
import importlib
from typing import Any

from amr_description.errors import AmrError


def resolve(target: str) -> Any:
    """Import ``module:attribute``. Raises ImportError or AttributeError, as ``import`` does."""
    module, _, attribute = target.partition(':')
    return getattr(importlib.import_module(module), attribute)


class Registry:
    """
    What is known under a name; a stranger's class needs no entry.

    A name that is not in the table is read as ``package.module/Class`` and imported, so that a
    type of another package can be named in a YAML file or a URDF without an edit here.
    """

    def __init__(self, kind: str, table: Mapping[str, str], error: type[AmrError]) -> None:
        """Store the table; ``kind`` (``controller type``) and ``error`` serve the messages."""
        self._kind = kind
        self._table = dict(table)
        self._error = error

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the table, in its order."""
        return tuple(self._table)

    def find(self, name: str) -> Any:
        """Return the class of that name; raises the registry's error with the names there are."""
        target = self._table.get(name) or name.replace('/', ':')
        try:
            return resolve(target)
        except Exception as cause:  # a stranger's module may raise anything
            if name in self._table:
                raise
            raise self._error(
                f"{self._kind} '{name}' is not known, and cannot be imported as "
                f'package.module/Class ({type(cause).__name__}: {cause}). '
                f'Known: {", ".join(self.names)}'
            ) from cause
