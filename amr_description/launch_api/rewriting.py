# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``nav2_common.launch``: files of others with other values, as RewrittenYaml.

Each is a substitution whose text is the path of a file that is written for this process. As
parameters of a node they are handed over as a text, which ``--print`` shows.
"""

from collections.abc import Iterator, Mapping
from contextlib import suppress
import functools
from pathlib import Path
import tempfile
from typing import Any

from amr_description.errors import ParameterError
from amr_description.launch_api.conditions import Condition
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.substitutions import (
    described,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
    Substitution,
    text_of,
)
from amr_description.parameter_files import KEY, load_yaml, text_of as file_text, whole_content_of


class WrittenFile(Substitution):
    """Base: a source file, from which another one is made."""

    def __init__(self, source_file: SomeSubstitutions) -> None:
        self.source_file = normalize_to_list_of_substitutions(source_file)

    def describe(self) -> str:
        return f'{type(self).__name__}({described(self.source_file)})'

    def source(self, context: LaunchContext) -> tuple[Path, str]:
        """Return the path of the source file and its text. Raises BringupError."""
        path = Path(perform_substitutions(context, self.source_file))
        try:
            return path, path.read_text('utf-8')
        except (OSError, UnicodeDecodeError) as error:
            raise self.failure(f"'{path}': {error}") from None

    def table(self, context: LaunchContext) -> dict[Any, Any]:
        """Return the source file as YAML has it. Raises BringupError."""
        path, text = self.source(context)
        try:
            found = load_yaml(text, whole_content_of)
        except ParameterError as error:
            raise self.failure(f"'{path}': {error}") from None
        if not isinstance(found, dict):
            raise self.failure(f"'{path}' has no table of nodes, but {found!r}")
        return _apart(found)

    def written(self, context: LaunchContext) -> str:
        """Return the text of the new file. Raises BringupError."""
        raise NotImplementedError

    def perform(self, context: LaunchContext) -> str:
        """Write the new file; return its path."""
        with tempfile.NamedTemporaryFile(
            'w', encoding='utf-8', dir=_folder().name, suffix='.yaml', delete=False
        ) as file:
            file.write(self.written(context))
        return file.name


class RewrittenYaml(WrittenFile):
    """
    A parameter file with other values.

    Args:
        source_file: its path.
        param_rewrites: name or path (``node.ros__parameters.name``) of a parameter -> its value.
        root_key: a namespace for all of it.
        key_rewrites: name of a node, or any other key -> its new name.
        convert_types: whether a value is a number where it can be read so; true and false are
            truth values in any case.
    """

    def __init__(
        self,
        source_file: SomeSubstitutions,
        param_rewrites: Mapping[str, SomeSubstitutions],
        root_key: SomeSubstitutions | None = None,
        key_rewrites: Mapping[str, SomeSubstitutions] | None = None,
        convert_types: bool = False,
    ) -> None:
        super().__init__(source_file)
        self.param_rewrites = param_rewrites
        self.root_key = root_key
        self.key_rewrites = key_rewrites or {}
        self.convert_types = convert_types

    def written(self, context: LaunchContext) -> str:
        values = {
            name: self._converted(text_of(context, value))
            for name, value in self.param_rewrites.items()
        }
        keys = {name: text_of(context, value) for name, value in self.key_rewrites.items()}
        table = self.table(context)
        known = set(_replace(table, values, ()))
        for path, value in values.items():
            if path not in known and KEY in path.split('.') and not _add(table, path, value):
                raise self.failure(f"'{path}': what stands above it is no table")
        table = _renamed(table, keys)
        root = '' if self.root_key is None else text_of(context, self.root_key)
        return file_text({root: table} if root else table)

    def _converted(self, text: str) -> Any:
        for kind in (int, float) if self.convert_types else ():
            with suppress(ValueError):
                return kind(text)
        return {'true': True, 'false': False}.get(text.lower(), text)


class ReplaceString(WrittenFile):
    """A file with other texts in it, where a condition holds; else the file itself."""

    def __init__(
        self,
        source_file: SomeSubstitutions,
        replacements: Mapping[str, SomeSubstitutions],
        condition: Condition | None = None,
    ) -> None:
        super().__init__(source_file)
        self.replacements = replacements
        self.condition = condition

    def written(self, context: LaunchContext) -> str:
        _, text = self.source(context)
        if self.condition is None or self.condition.evaluate(context):
            for before, after in self.replacements.items():
                text = text.replace(before, text_of(context, after))
        return text


class HasNodeParams(WrittenFile):
    """``True`` if a parameter file has a node of this name, else ``False``."""

    def __init__(self, source_file: SomeSubstitutions, node_name: SomeSubstitutions) -> None:
        super().__init__(source_file)
        self.node_name = node_name

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        return str(text_of(context, self.node_name) in self.table(context))


@functools.cache
def _folder() -> 'tempfile.TemporaryDirectory[str]':
    """Make the folder of the files of this process, which goes with it."""
    return tempfile.TemporaryDirectory(prefix='amr-launch-')


def _apart(value: Any) -> Any:
    """Return a value in which nothing stands twice, as by aliases: each has changes of its own."""
    if isinstance(value, dict):
        return {key: _apart(each) for key, each in value.items()}
    return [_apart(each) for each in value] if isinstance(value, list) else value


def _replace(
    table: dict[Any, Any] | list[Any], values: Mapping[str, Any], above: tuple[str, ...]
) -> Iterator[str]:
    """Replace what is no table by its name or path; yield the paths of all."""
    items = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in [*items]:
        path = (*above, str(key))
        joined = '.'.join(path)
        yield joined
        for name in (str(key), joined) if isinstance(table, dict) else (joined,):
            if name in values and not isinstance(value, dict):
                table[key] = values[name]
        if isinstance(table[key], dict | list):
            yield from _replace(table[key], values, path)


def _add(table: dict[Any, Any], path: str, value: Any) -> bool:
    """Set a parameter that the file does not have; return whether there is a place for it."""
    *above, name = path.split('.')
    for key in above:
        if table.get(key) in (None, ''):
            table[key] = {}
        table = table[key]
        if not isinstance(table, dict):
            return False
    table[name] = value
    return True


def _renamed(table: Any, keys: Mapping[str, str]) -> Any:
    if not isinstance(table, dict):
        return table
    return {keys.get(key, key): _renamed(value, keys) for key, value in table.items()}
