# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A launch file for ``ros2 launch``: what it takes, and the stack that it is translated into."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
import importlib
import importlib.util
from pathlib import Path

from amr_description.bringup import user_errors
from amr_description.bringup.arguments import parse
from amr_description.bringup.description import Stack
from amr_description.bringup.handlers import Level
from amr_description.bringup.input_files import notes_on
from amr_description.errors import AmrError, BringupError
from amr_description.launch_api import including, markup
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import (
    declared_arguments,
    LaunchDescription,
    show_arguments,
)
from amr_description.launch_api.including import (
    IncludeLaunchDescription,
    LaunchDescriptionSource,
    read,
)
from amr_description.launch_api.modules import is_installed, understood
from amr_description.launch_api.opened_files import note, recording
from amr_description.launch_api.translation import translated
from amr_description.stand_ins import hint_of_module
from amr_description.text import suggestion


def launch_by_the_original(path: Path, words: Sequence[str], *, show: bool = False) -> int | None:
    """
    Run a launch file by the original launch.

    Args:
        path: the file.
        words: its arguments, ``name:=value``.
        show: whether to print its arguments only, if ``ros2launch`` is installed.

    Returns:
        Its exit code; None: it is not installed.

    Raises:
        UsageError: an argument is malformed.
        BringupError: it is installed, but not what it needs.
    """
    if not is_installed():
        return None
    pairs = list(parse(words).items())
    if show and importlib.util.find_spec('ros2launch') is not None:
        api = importlib.import_module('ros2launch.api')
        api.print_arguments_of_launch_file(launch_file_path=str(path))
        return 0
    modules = ('launch', 'launch.launch_description_sources', 'launch.actions')
    try:
        launch, sources, actions = map(importlib.import_module, modules)
    except ImportError as error:
        hint = hint_of_module(error.name or '')
        raise BringupError(
            'the original launch is installed, and cannot be imported: '
            + (f'{error}: {hint}' if hint else str(error))
        ) from error
    include = actions.IncludeLaunchDescription(
        sources.AnyLaunchDescriptionSource(str(path)), launch_arguments=pairs
    )
    service = launch.LaunchService(argv=list(words))
    service.include_launch_description(launch.LaunchDescription([include]))
    return int(service.run())


including.LOADERS.update(markup.LOADERS)


class LaunchFile:
    """A file with ``generate_launch_description``, or one of XML or YAML."""

    def __init__(self, path: Path) -> None:
        """Read nothing yet."""
        self._path = path.absolute()

    def show_arguments(self) -> str:
        """Return what ``--show-args`` prints. Raises BringupError."""
        with understood():
            return show_arguments(declared_arguments(read(self._path)))

    def stack(self, given: Mapping[str, str]) -> Stack:
        """Return what is started with these arguments, by name. Raises BringupError."""
        context = LaunchContext()
        with understood(), recording() as files:
            note(str(self._path))
            try:
                source = LaunchDescriptionSource(str(self._path))
                pairs = list(given.items())
                include = IncludeLaunchDescription(source, launch_arguments=pairs)
                description = LaunchDescription([include])
                include.where = source.where = description.where = ''
                stack = translated(description, context, self._path)
                declared = declared_arguments(source.get_launch_description(context))
            except AmrError:
                raise
            except RecursionError:
                raise BringupError(f"'{self._path}' includes itself") from None
            except Exception as error:
                text = user_errors.describe(error)
                raise BringupError(f"'{self._path}' failed: {text}") from error
        known = {each.name for each in declared} | context.read
        unknown = [name for name in given if name not in known]
        notes: list[tuple[Level, str]] = [
            ('WARNING', f"it declares no argument '{name}'{suggestion(name, sorted(known))}")
            for name in unknown
        ]
        return replace(stack, notes=[*notes, *notes_on(files), *stack.notes])
