# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The sections of parameter files with the lines of their parameters, and the controllers in them.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

import yaml

from amr_description.errors import ParameterError
from amr_description.model.findings import SourceLocation
from amr_description.parameter_files import (
    compose,
    dotted,
    find_keys,
    flatten,
    KEY,
    read_parameter_file,
    Section,
    sections,
)

_TYPE = '.type'
# Nodes, and parameters of one: aliases can make a short file mean any number of them.
_MOST = 10_000


@dataclass(frozen=True, slots=True)
class LocatedSection:
    """A section with the values of its parameters, and where they stand, by dotted name."""

    section: Section
    location: SourceLocation
    values: dict[str, Any]
    locations: dict[str, SourceLocation]

    @property
    def node(self) -> str:
        """The full name of the node, perhaps with wildcards."""
        return self.section.pattern

    @property
    def name(self) -> str:
        """The name of the node without its namespace; a wildcard if it is for several."""
        return self.node.rpartition('/')[2]

    @property
    def is_for_every_node(self) -> bool:
        """Whether its name is a wildcard, so that it holds what many nodes have."""
        return '*' in self.name

    @property
    def label(self) -> str:
        """Return it as it stands in the file."""
        return '/'.join(map(str, self.section.keys))


@dataclass(frozen=True, slots=True)
class ListedController:
    """A controller that a file gives a type, and where."""

    node: str
    """The full name of its node."""
    type: str
    location: SourceLocation
    """Of the type."""
    manager: LocatedSection | None
    """The section that lists it; None: it has its type in its own."""

    @property
    def name(self) -> str:
        """Without its namespace."""
        return self.node.rpartition('/')[2]


def read_sections(paths: Iterable[str]) -> tuple[LocatedSection, ...]:
    """
    Return the sections of files, and of those that a manager hands to its controllers, in order.

    Raises ParameterError: a file cannot be read.
    """
    found = [each for path in dict.fromkeys(paths) for each in _read(path)]
    further = dict.fromkeys(_further_files(found))
    return tuple(found + [each for path in further for each in _read(path)])


def listed_controllers(found: Sequence[LocatedSection]) -> tuple[ListedController, ...]:
    """Return the controllers that have a type, each once, by the last section that gives it."""
    listed: dict[str, ListedController] = {}
    for each in found:
        kind = each.values.get('type')
        if isinstance(kind, str) and not each.is_for_every_node:
            place = each.locations['type']
            listed[each.node] = ListedController(each.node, kind, place, None)
        namespace = each.node.rpartition('/')[0]
        for name, value in each.values.items():
            if gives_type(name) and isinstance(value, str):
                node = f'{"" if "*" in namespace else namespace}/{name.removesuffix(_TYPE)}'
                listed[node] = ListedController(node, value, each.locations[name], each)
    return tuple(listed.values())


def gives_type(name: str) -> bool:
    """Return whether a parameter of a manager gives a controller its type: ``<name>.type``."""
    return name.endswith(_TYPE) and '.' not in name.removesuffix(_TYPE)


def _read(path: str) -> tuple[LocatedSection, ...]:
    """Return the sections of a file, which is read again when it has changed."""
    try:
        status = Path(path).stat()
    except OSError as error:
        raise ParameterError(f"parameter file '{path}': {error.strerror}") from error
    return _read_unchanged(path, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=32)
def _read_unchanged(path: str, _changed: int, _size: int) -> tuple[LocatedSection, ...]:
    content = read_parameter_file(Path(path))
    tree = compose(Path(path).read_text(encoding='utf-8'))
    try:
        return tuple(_located(each, tree, path) for each in islice(sections(content), _MOST))
    except RecursionError:  # an anchor that holds itself
        raise ParameterError(f"parameter file '{path}': nested too deeply") from None


def _further_files(found: list[LocatedSection]) -> Iterator[str]:
    """Yield the files that managers hand to their controllers."""
    for each in found:
        for name in each.values:
            files = each.values.get(f'{name.removesuffix(_TYPE)}.params_file')
            if name.endswith(_TYPE):
                names = files if isinstance(files, list) else [files]
                yield from (file for file in names if isinstance(file, str))


def _located(section: Section, tree: yaml.Node | None, path: str) -> LocatedSection:
    line, below = find_keys(tree, section.keys)
    values, locations = {}, {}
    if isinstance(section.parameters, dict):
        _, below = find_keys(below, (KEY,))
        for keys, value in islice(flatten(section.parameters), _MOST):
            values[dotted(keys)] = value
            locations[dotted(keys)] = SourceLocation(path, find_keys(below, keys)[0])
    return LocatedSection(section, SourceLocation(path, line), values, locations)
