# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""IncludeLaunchDescription, and how a launch file is read: Python, or one of ``LOADERS``."""

from collections.abc import Callable, Iterable, Mapping
import importlib.machinery
import importlib.util
from pathlib import Path
import sys
from types import ModuleType
from typing import Any

from amr_description.ament_index import hint_at
from amr_description.bringup import user_errors
from amr_description.errors import AmrError, BringupError
from amr_description.launch_api import gazebo_files
from amr_description.launch_api.actions import SetLaunchConfiguration
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.counterparts import in_package, not_here, why_left_out
from amr_description.launch_api.descriptions import (
    Action,
    declared_arguments,
    Entities,
    LaunchDescription,
    LaunchDescriptionEntity,
)
from amr_description.launch_api.locations import at, Located, refusal
from amr_description.launch_api.substitutions import (
    described,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
    text_of,
)

LOADERS: dict[str, Callable[[Path], LaunchDescription]] = {}
"""By the ending of a file, ``.xml``: how it is read; all others are Python."""

_FUNCTION = 'generate_launch_description'
_open: list[Path] = []
"""The files that are being read or visited, outermost first."""


def read(path: Path) -> LaunchDescription:
    """Return the description of a launch file, or of ours in its place. Raises BringupError."""
    if (known := in_package(path)) is not None:
        package, file = known
        files = gazebo_files.FILES.get(package, {})
        if file in files:
            return files[file]()
        if why := why_left_out(package):
            return gazebo_files.left_out(package, file, why)
        raise not_here(package, file, list(files))
    if not path.is_file():
        raise refusal(f"there is no launch file '{path}'{hint_at(path)}", '')
    loader = LOADERS.get(path.suffix, _from_python)
    try:
        return loader(path)
    except (BringupError, RecursionError):
        raise
    except AmrError as error:
        raise BringupError(user_errors.describe(error)) from error
    except Exception as error:
        raise BringupError(f"'{path}' failed: {user_errors.describe(error)}") from error


def _from_python(path: Path) -> LaunchDescription:
    module = _import(path)
    function = getattr(module, _FUNCTION, None)
    if not callable(function):
        raise BringupError(
            f"launch file at '{path}' does not contain the required function '{_FUNCTION}()'"
        )
    description = function()
    if not isinstance(description, LaunchDescription):
        raise BringupError(
            f"'{path}': {_FUNCTION}() returned {type(description).__name__}, which is no "
            'LaunchDescription'
        )
    return description


def _import(path: Path) -> ModuleType:
    name = f'_launch_file_{path.name.partition(".")[0]}'
    spec = importlib.util.spec_from_file_location(
        name, path, loader=importlib.machinery.SourceFileLoader(name, str(path))
    )
    if spec is None or spec.loader is None:
        raise BringupError(f'{path} is no Python module')
    module = importlib.util.module_from_spec(spec)
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        spec.loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = before
    return module


class LaunchDescriptionSource(Located):
    """A launch file, or a description."""

    def __init__(self, launch_file_path: SomeSubstitutions | LaunchDescription) -> None:
        self._description: LaunchDescription | None = None
        self.path: Any = None
        if isinstance(launch_file_path, LaunchDescription):
            self._description = launch_file_path
        else:
            self.path = normalize_to_list_of_substitutions(launch_file_path)

    @property
    def location(self) -> str:
        """The path, as far as it is known."""
        return '' if self.path is None else described(self.path)

    def file(self, context: LaunchContext) -> Path | None:
        """Return the path; None: it is a description."""
        if self.path is None:
            return None
        return Path(perform_substitutions(context, self.path)).absolute()

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description; it is read once. Raises BringupError."""
        if self._description is None:
            try:
                self._description = read(self.file(context) or Path())
            except BringupError as error:
                raise at(error, self.where) from None
        return self._description

    def try_description(self) -> LaunchDescription | None:
        """Return the description if its path is known without arguments."""
        try:
            return self.get_launch_description(LaunchContext())
        except (AmrError, KeyError, OSError):
            return None


class RestoreLocals(Action):
    """The end of an included file."""

    def __init__(self, values: Mapping[str, Any], path: Path | None) -> None:
        super().__init__()
        self.values = values
        self.path = path

    def execute(self, context: LaunchContext) -> None:
        context.replace_locals(self.values)
        if self.path is not None:
            _open.remove(self.path)


class IncludeLaunchDescription(Action):
    """Another launch file."""

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutions,
        *,
        launch_arguments: Iterable[tuple[Any, Any]] | Mapping[Any, Any] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        source = launch_description_source
        if not isinstance(source, LaunchDescriptionSource):
            source = LaunchDescriptionSource(source)
        self.launch_description_source = source
        given = launch_arguments or ()
        self.launch_arguments = list(given.items() if isinstance(given, Mapping) else given)

    def sub_entities(self) -> Entities:
        description = self.launch_description_source.try_description()
        return () if description is None else description.entities

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        source = self.launch_description_source
        path = source.file(context)
        if path in _open:
            raise refusal(f"'{path}' includes itself", self.where)
        description = source.get_launch_description(context)
        self._require_arguments(context, description)
        before = dict(context.get_locals_as_dict())
        if path is not None:
            _open.append(path)
            folder = {'current_launch_file_directory': str(path.parent)}
            context.extend_locals({'current_launch_file_path': str(path), **folder})
        sets = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        return [*sets, description, RestoreLocals(before, path)]

    def _require_arguments(self, context: LaunchContext, description: LaunchDescription) -> None:
        """Raise BringupError if an argument without a default is not given."""
        given = [text_of(context, name) for name, _ in self.launch_arguments]
        for argument in declared_arguments(description):
            if argument.is_conditional or argument.default_value is not None:
                continue
            if argument.name not in (*given, *context.launch_configurations):
                raise refusal(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]",
                    self.where,
                )


def forget_open_files() -> None:
    """Begin anew, after an error too."""
    _open.clear()
