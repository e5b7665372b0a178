# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A trial's function: how other processes find it, and the parameters that it is run with.

It is found by its module and its file, so that a function of a script or of a test file will do.
``vary`` notes at the function itself what varies, so that whoever finds it knows that, too.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
import hashlib
import importlib
import importlib.util
import inspect
from itertools import product
import math
import numbers
from pathlib import Path
import pickle
import sys
from typing import Any, TypeAlias

import numpy as np

from amr_description.errors import TrialsError
from amr_description.text import quote_all

Value: TypeAlias = float | str
Draw: TypeAlias = Callable[[np.random.Generator], float]
GIVEN = ('simulate', 'rng')
"""What every trial gets, before its parameters."""
VARIED = '__trials_vary__'
"""The attribute of a function in which its parameters are: name → draw, or values of a grid."""


@dataclass(frozen=True)
class TrialFunction:
    """A function that other processes find: by its module, else by its file, else pickled."""

    label: str
    """As a command line names it: ``my_module:drive``, ``folder/my_file.py:drive``."""
    module: str = ''
    file: str = ''
    name: str = ''
    pickled: bytes = b''

    @classmethod
    def of(cls, function: Callable[..., Any]) -> 'TrialFunction':
        """Find out where a function is. Raises TrialsError: other processes could not find it."""
        name = getattr(function, '__qualname__', type(function).__name__)
        if not inspect.isfunction(function):
            return cls(name, pickled=_pickled(function, name))
        if '<' in name:  # <lambda>, <locals>
            raise TrialsError(
                f"the trial '{name}' cannot be sent to other processes; a function that is "
                'defined by def at the top of a file will do'
            )
        file = inspect.getsourcefile(function)
        if file is None or not Path(file).is_file():
            raise TrialsError(
                f"the trial '{name}' is in no file, where other processes would find it; write it "
                'to one, and import it'
            )
        path, module = Path(file).resolve(), function.__module__
        is_package = module != '__main__' and '.' in module
        found = cls(f'{module if is_package else _shown(path)}:{name}', module, str(path), name)
        _known[found] = function
        return found

    @classmethod
    def named(cls, target: str) -> 'TrialFunction':
        """Find ``module:function`` or ``file.py:function``. Raises TrialsError."""
        where, _, name = target.rpartition(':')
        if not (where and name.isidentifier()):
            raise TrialsError(f"'{target}' names no trial; module:function or file.py:function do")
        if where.endswith('.py'):
            path = Path(where).resolve()
            if not path.is_file():
                raise TrialsError(f"'{target}': there is no file {where}")
            found = cls(target, path.stem, str(path), name)
        else:
            try:
                module = importlib.import_module(where)
            except ModuleNotFoundError as error:
                raise TrialsError(
                    f"'{target}': {error}; it is looked for in this folder and in PYTHONPATH"
                ) from error
            found = cls(target, where, str(Path(module.__file__ or '').resolve()), name)
        found.load()
        return found

    def load(self) -> Callable[..., Any]:
        """Return the function. Raises TrialsError, or what its module raises when imported."""
        return _loaded(self)

    def grid(self) -> Sequence[Mapping[str, Value]]:
        """Return the values of each cell of the grid; one cell without any, if there is none."""
        varied = varied_of(self.load())
        grid = {name: each for name, each in varied.items() if not callable(each)}
        return [dict(zip(grid, cell, strict=True)) for cell in product(*grid.values())]

    def drawn(self, seed: int) -> Mapping[str, Value]:
        """Return the parameters that are drawn, each from a stream of its own."""
        found: dict[str, Value] = {}
        for name, draw in varied_of(self.load()).items():
            if callable(draw):
                value = draw(np.random.default_rng((seed, *name.encode())))
                found[name] = plain_value(value, f"the draw of '{name}'")
        return found


def varied_of(function: Callable[..., Any]) -> Mapping[str, Draw | Sequence[Value]]:
    """Return what varies, by name."""
    return getattr(function, VARIED, {})


def plain_value(value: Any, what: str) -> Value:
    """Return a value as a report has it. Raises TrialsError: it is neither number nor text."""
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Real | np.bool_) and math.isfinite(value):
        return float(value)
    raise TrialsError(f'{what} is {value!r}; a finite number or a text will do')


def require_parameters(function: Callable[..., Any], names: Sequence[str]) -> None:
    """Raise TrialsError: the function does not take what it would be given."""
    taken = inspect.signature(function).parameters.values()
    wanted = [each.name for each in taken if each.default is each.empty and each.kind < 2]
    takes_all = any(each.kind is each.VAR_KEYWORD for each in taken)
    known = [*GIVEN, *names]
    missing = [name for name in wanted if name not in known]
    unknown = [name for name in known if name not in {each.name for each in taken}]
    name = getattr(function, '__qualname__', repr(function))
    if missing:
        raise TrialsError(
            f"the trial '{name}' takes {quote_all(missing)}, which nobody gives it; it gets "
            f'{quote_all(known)}, the latter by vary()'
        )
    if unknown and not takes_all:
        raise TrialsError(f"the trial '{name}' does not take {quote_all(unknown)}, which it gets")


def cells(grid: Sequence[Mapping[str, Value]], seed: int) -> Iterator[tuple[str, int]]:
    """Yield the name of each run of a seed, ``17`` or of a grid ``17.0``, and its cell."""
    for number in range(len(grid)):
        yield (f'{seed}.{number}' if len(grid) > 1 else str(seed)), number


def _pickled(function: Any, name: str) -> bytes:
    try:
        data = pickle.dumps(function)
    except Exception as error:  # whatever an object raises
        raise TrialsError(
            f"the trial '{name}' cannot be sent to other processes: {error}; a function that is "
            'defined by def at the top of a file will do'
        ) from error
    if b'__main__' in data:
        raise TrialsError(
            f"the trial '{name}' is made of what this script defines, which other processes do "
            'not have; import it from a module'
        )
    return data


def _shown(path: Path) -> str:
    """Return a path as it is typed from here."""
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)


class _LoadedFarEnoughError(BaseException):
    """A script that is loaded for its functions has come to where it runs trials itself."""


_known: dict[TrialFunction, Callable[..., Any]] = {}
"""Those of this process."""
_loading: set[str] = set()
"""Files that are loaded just now, which define what trials are, and shall run none."""


def stop_loading() -> None:
    """End the loading of a script: in another process it is loaded for its functions alone."""
    if _loading:
        raise _LoadedFarEnoughError


@lru_cache(maxsize=16)
def _loaded(trial: TrialFunction) -> Callable[..., Any]:
    found: Any
    if trial in _known:
        return _known[trial]
    if trial.pickled:
        found = pickle.loads(trial.pickled)
    else:
        found = _module_of(trial)
        for part in trial.name.split('.'):
            found = getattr(found, part, None)
    if not callable(found):
        raise TrialsError(f"'{trial.label}': there is no function of that name")
    return partial(found) if inspect.isclass(found) else found


def _module_of(trial: TrialFunction) -> Any:
    """Return the module: that of its name if that is its file, else what is in the file."""
    if trial.module != '__main__':
        try:
            module = importlib.import_module(trial.module)
        except ModuleNotFoundError as error:
            if error.name is None or not f'{trial.module}.'.startswith(f'{error.name}.'):
                raise
        else:
            if Path(module.__file__ or '').resolve() == Path(trial.file):
                return module
    digest = hashlib.blake2b(trial.file.encode(), digest_size=4).hexdigest()
    name = f'_trials_{Path(trial.file).stem}_{digest}'
    if name not in sys.modules:
        folder = str(Path(trial.file).parent)
        if folder not in sys.path:  # as for a script
            sys.path.append(folder)
        spec = importlib.util.spec_from_file_location(name, trial.file)
        if spec is None or spec.loader is None:
            raise TrialsError(f"'{trial.label}': {trial.file} cannot be imported")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        _loading.add(name)
        try:
            spec.loader.exec_module(module)
        except _LoadedFarEnoughError:
            pass
        except BaseException:
            del sys.modules[name]
            raise
        finally:
            _loading.discard(name)
    return sys.modules[name]
