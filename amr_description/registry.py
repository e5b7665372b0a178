# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tables from a name to ``module:attribute``, which is imported only when it is used.

So ``ros2 --help`` and a talker do not import MuJoCo, or controllers that are not loaded.
"""

from collections.abc import Mapping
import importlib
from importlib.util import find_spec
import os
from pathlib import Path
import sys
from types import ModuleType
from typing import Any

from amr_description.errors import AmrError
from amr_description.ownership import changed_by_others
from amr_description.plugin_errors import place_of
from amr_description.text import did_you_mean

_MOST_NAMES = 12
"""That are listed in a message."""


def resolve(target: str) -> Any:
    """Import ``module:attribute``. Raises ImportError or AttributeError, as ``import`` does."""
    module, _, attribute = target.partition(':')
    try:
        found = importlib.import_module(module)
    except ModuleNotFoundError as error:
        if not _include_overlay(error.name or ''):
            raise
        found = importlib.import_module(module)
    return getattr(found, attribute)


def _runs_something(target: str) -> bool:
    """
    Return whether a module has no plugin for sure, and may be a program.

    A request that spawns a robot names modules, and the import of some runs what is in them:
    ``pip.__main__`` reads the command line, and ends the process.
    """
    first, *others = target.partition(':')[0].split('.')
    return first in sys.stdlib_module_names or '__main__' in others


def _changed_by_others(target: str) -> str:
    """
    Return why a module of the folder that the program was started in is not to be imported.

    ``python -m`` finds modules there, and in /tmp others put theirs. '': it is from elsewhere.
    """
    first = target.partition(':')[0].partition('.')[0]
    try:
        spec, here = find_spec(first), Path.cwd()
    except (ImportError, ValueError, OSError):  # OSError: the folder is gone
        return ''
    if spec is None:  # who imports it says so
        return ''
    for each in (spec.origin or '', *(spec.submodule_search_locations or ())):
        path = Path(each)
        if path.name.startswith('__init__.'):
            path = path.parent
        if each and path.parent == here:
            real = path.resolve()
            for folder in (real, *real.parents):
                if reason := changed_by_others(folder):
                    return reason
    return ''


def _include_overlay(module: str) -> bool:
    """
    Have a package of ours also find what another one of its name has; return whether there is one.

    A workspace may have a package of this one's name, as the tutorial makes it, with a controller
    of its own. ``amr_description`` then is ours, which was imported first.

    Args:
        module: what was not found, ``amr_description.my_controller``.
    """
    package, _, _ = module.rpartition('.')
    if package.partition('.')[0] != __package__ or package not in sys.modules:
        return False
    known = sys.modules[package].__path__
    below = package.replace('.', os.sep)
    found = [os.path.join(folder, below) for folder in sys.path]
    more = [folder for folder in found if folder not in known and os.path.isdir(folder)]
    known.extend(more)
    return bool(more)


class Registry:
    """
    Classes by name; those of third parties need no entry.

    A name that is not in the table is read as ``package.module/Class`` and imported, so that a
    YAML file or a URDF can name a class of another package.
    """

    def __init__(
        self,
        kind: str,
        table: Mapping[str, str],
        error: type[AmrError],
        *,
        absent: Mapping[str, str] | None = None,
        base: str = '',
        needs: Mapping[str, str] | None = None,
    ) -> None:
        """
        Take the names.

        Args:
            kind: ``controller type``, for the messages.
            table: from a name to ``module:attribute``.
            error: what is raised for a name that is not known.
            absent: names that are known elsewhere, and what would do in their place.
            base: ``module:Class``, of which a class of a third party is derived; '': of any.
            needs: what such a class has to have, and what it is.
        """
        self._kind = kind
        self._table = dict(table)
        self._error = error
        self._absent = absent or {}
        self._base = base
        self._needs = needs or {}

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the table, in its order."""
        return tuple(self._table)

    def find(self, name: str) -> Any:
        """Return the class of a name. Raises ``error`` with the known names."""
        target = self._table.get(name) or name.replace('/', ':')
        if name not in self._table and _runs_something(target):
            raise self._error(
                f"{self._kind} '{name}' is not known: that module is of Python itself, or a "
                'program; package.module/Class of a package of yours will do'
            )
        if name not in self._table and (reason := _changed_by_others(target)):
            raise self._error(
                f"{self._kind} '{name}' is not loaded from the present folder: {reason}; a folder "
                'that nobody else can change will do, or a package'
            )
        try:
            found = resolve(target)
        except (Exception, SystemExit) as cause:  # a third-party module may raise anything
            if name in self._table:
                raise
            raise self._error(self.absence(name, cause)) from cause
        if name not in self._table and (fault := self._fault_of(found)):
            raise self._error(f"{self._kind} '{name}' {fault}")
        return found

    def _fault_of(self, found: Any) -> str:
        """Return what is wrong with a class of a third party; '': nothing."""
        if self._base:
            base = resolve(self._base)
            if not (isinstance(found, type) and issubclass(found, base)):
                what = self._base.replace(':', '.')
                return f'is no {base.__name__}: derive it from {what}'
        lacking = (name for name in self._needs if not hasattr(found, name))
        if (name := next(lacking, None)) is not None:
            return f'has no {name}, {self._needs[name]}'
        return ''

    def absence(self, name: str, cause: BaseException | None = None) -> str:
        """Return, in one line, that a name is not there, and what would do."""
        if name in self._absent:
            return f"{self._kind} '{name}' is not there: {self._absent[name]}"
        reason = ''
        if cause is not None:
            place = place_of(cause)
            if Path(__file__).name in place:  # it is not there at all
                place = ''
            reason = f' ({type(cause).__name__}: {cause}{_instead_of(cause)}{place})'
        known = f'. Known: {", ".join(self.names)}' if len(self.names) <= _MOST_NAMES else ''
        return (
            f"{self._kind} '{name}' is not known, and cannot be imported as "
            f'package.module/Class{reason}{did_you_mean(name, self.names)}{known}'
        )


def _instead_of(cause: BaseException) -> str:
    """Return which classes a module has in place of one that it has not; '': it is not so."""
    module = getattr(cause, 'obj', None)
    if not isinstance(module, ModuleType):
        return ''
    own = (each for each in vars(module).values() if isinstance(each, type))
    names = [each.__name__ for each in own if each.__module__ == module.__name__]
    return f'; there are {", ".join(names)}' if names else ''
