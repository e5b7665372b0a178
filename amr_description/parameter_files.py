# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ROS parameter files: checked before rcl reads them, searched as rcl searches them, and written.

For a faulty file rcl reports a line of its own source; this module reports that of the file.

A file holds sections: the full name of a node, or a pattern for several, and below it
``ros__parameters``. Namespaces may be part of the name or tables above it, and dots in the name
of a parameter are the same as tables::

    /left/arm:                    left:
      ros__parameters:              arm:
        gains.p: 1.0                  ros__parameters: {gains: {p: 1.0}}

In a pattern ``*`` stands for one part of a name and ``**`` for any number of them. Which of
several sections of a node wins is up to the caller: nodes take the last, ``ros2 param load`` the
most particular one.

PyYAML takes 20 ms to import, so programs that may do without import this module where they need
it.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
import math
from pathlib import Path
import re
import sys
from typing import Any, ClassVar

import yaml

from amr_description.ament_index import hint_at, path_of
from amr_description.errors import ParameterError
from amr_description.text import closest_match, unwrap

KEY = 'ros__parameters'
EVERY_NODE = '/**'
"""The pattern of a section that is for all nodes."""

_SHAPE = 'a parameter file is written as  node_name: {ros__parameters: {name: value}}'
_STRING = 'tag:yaml.org,2002:str'
_BYTES = 'tag:yaml.org,2002:binary'
"""A list of bytes, as ``ros2 param dump`` writes it."""
_MERGE = 'tag:yaml.org,2002:merge'
_PLAIN = 'amr:plain'
_TRUTH = {
    **dict.fromkeys(
        ('Y', 'y', 'yes', 'Yes', 'YES', 'true', 'True', 'TRUE', 'on', 'On', 'ON'), True
    ),
    **dict.fromkeys(
        ('N', 'n', 'no', 'No', 'NO', 'false', 'False', 'FALSE', 'off', 'Off', 'OFF'), False
    ),
}
_INTEGER = re.compile(r'[-+]?(0x[\da-f]+|0[0-7]*|[1-9]\d*)', re.ASCII | re.IGNORECASE)
_DECIMAL = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?', re.ASCII | re.IGNORECASE)
_HEXADECIMAL = re.compile(
    r'[-+]?0x([\da-f]+\.?[\da-f]*|\.[\da-f]+)(p[-+]?\d+)?', re.ASCII | re.IGNORECASE
)
_NO_NUMBER = re.compile(r'([-+]?)(inf(inity)?|nan)(\(\w*\))?', re.ASCII | re.IGNORECASE)
_OF_YAML = re.compile(r'\.(nan|NaN|NAN)|([-+]?)\.(inf|Inf|INF)')
_LONGEST = 30
"""Characters of an integer of 64 bits, at most; one of thousands Python refuses to read."""
_SMALLEST = 2.2250738585072014e-308
"""The smallest double with all its digits; the C library reports what is smaller as no number."""


class YamlError(ParameterError):
    """A text is not YAML; ``where`` is its line and column, from 1, if they are known."""

    def __init__(self, problem: str, where: tuple[int, int] | None = None) -> None:
        super().__init__(problem)
        self.where = where


def load_yaml(text: str, load: Callable[[str], Any] = yaml.safe_load) -> Any:
    """
    Return what a text means as YAML 1.1.

    Args:
        text: the text.
        load: reads it; raises what PyYAML raises.

    Raises:
        YamlError: it is not YAML.
        ParameterError: it is nested too deeply to be read.
    """
    if _opens_without_end(text):
        raise ParameterError('it is nested too deeply')
    try:
        value = load(text)
        _check_end(value, set(), set())
        return value
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = (mark.line + 1, mark.column + 1) if mark else None
        raise YamlError(str(error.problem), where) from error
    except yaml.reader.ReaderError as error:
        raise YamlError(
            f'character {error.position + 1} is {_code_point(error.character)}, which YAML does '
            'not allow'
        ) from error
    except RecursionError as error:
        raise ParameterError('it is nested too deeply') from error
    except ValueError as error:  # a date such as 2026-99-99, an integer of 5000 digits
        raise YamlError(unwrap(str(error))) from error


def _check_end(value: Any, around: set[int], seen: set[int]) -> None:
    """Raise ParameterError: a value contains itself, as ``&a [*a]`` does; also of a tree."""
    parts = value.value if isinstance(value, yaml.CollectionNode) else value
    if not isinstance(parts, list | tuple | dict):
        return
    if id(value) in around:
        raise ParameterError('a value contains itself, as &a [*a] does; write it without *')
    if id(value) in seen:
        return
    around.add(id(value))
    for part in parts.values() if isinstance(parts, dict) else parts:
        _check_end(part, around, seen)
    around.remove(id(value))
    seen.add(id(value))


def _opens_without_end(text: str) -> bool:
    """
    Whether it begins with more brackets than Python calls functions within each other.

    PyYAML would find that out in a second of processor time, which goes with their number squared.
    """
    return bool(re.match(rf'(?:\s*[\[{{]){{{sys.getrecursionlimit()}}}', text))


def scalar_of(text: str) -> bool | int | float | str:
    """
    Return what a plain scalar of a parameter file means to rcl: ``5e-2`` is a double.

    As ``get_value`` of rcl_yaml_param_parser does, which asks the C library: ``strtol`` with the
    base that the text names, then ``strtod``. PyYAML reads YAML 1.1, which differs in both ways:
    ``1_000``, ``1:30`` and dates are strings to rcl.
    """
    if text in _TRUTH:
        return _TRUTH[text]
    if len(text) < _LONGEST and _INTEGER.fullmatch(text):
        digits = text.lstrip('+-')
        base = 16 if digits[:2] in ('0x', '0X') else 8 if digits[0] == '0' else 10
        if -(2**63) <= (number := int(text, base)) < 2**63:
            return number
    if found := _OF_YAML.fullmatch(text):
        return math.nan if found[1] else float(f'{found[2]}inf')
    if found := _NO_NUMBER.fullmatch(text):
        return float(f'{found[1]}{found[2]}')
    read = float.fromhex if _HEXADECIMAL.fullmatch(text) else float
    if read is float and not _DECIMAL.fullmatch(text):
        return text
    try:
        value = read(text)
    except OverflowError:
        return text
    is_lost = math.isinf(value) or (
        abs(value) < _SMALLEST and re.search('[1-9a-f]', _digits(text))
    )
    return text if is_lost else value


def _digits(text: str) -> str:
    """Return a number without its sign, prefix and exponent."""
    digits = text.lower().lstrip('+-')
    return digits[2:].partition('p')[0] if digits[:2] == '0x' else digits.partition('e')[0]


class _Loader(yaml.SafeLoader):
    """Reads a parameter file as rcl does: see :func:`scalar_of`; all keys are texts."""

    yaml_implicit_resolvers: ClassVar[dict[Any, Any]] = {}
    reads_aliases: ClassVar[bool] = False

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Refuse what rcl does not read, with its place; have a plain scalar be known as one."""
        if self.check_event(yaml.AliasEvent):
            if self.reads_aliases:
                return super().compose_node(parent, index)
            event = self.peek_event()
            raise yaml.composer.ComposerError(
                None, None, f"ROS reads no aliases, as '*{event.anchor}'; write the value out",
                event.start_mark,
            )  # fmt: skip
        node = super().compose_node(parent, index)
        if isinstance(node, yaml.ScalarNode):
            is_key = isinstance(parent, yaml.MappingNode) and index is None
            if is_key and node.value == '<<' and not node.style:
                if self.reads_aliases:
                    node.tag = _MERGE
                    return node
                raise yaml.composer.ComposerError(
                    None, None, "ROS merges no tables, as '<<:' does; write the values out",
                    node.start_mark,
                )  # fmt: skip
            is_text = is_key or node.style in ('"', "'") or self._given_tag == _STRING
            if self._given_tag != _BYTES:
                node.tag = _STRING if is_text else _PLAIN
        return node

    def compose_scalar_node(self, anchor: Any) -> yaml.ScalarNode:
        """Note what it is said to be; other tags than these two mean nothing to rcl."""
        self._given_tag = self.peek_event().tag
        return super().compose_scalar_node(anchor)


class _SourceLoader(_Loader):
    """Reads aliases and ``<<:``, too: of what is written out before ROS reads it."""

    reads_aliases: ClassVar[bool] = True


_Loader.add_constructor(_PLAIN, lambda _, node: scalar_of(node.value))


@lru_cache(maxsize=4)
def compose(text: str) -> yaml.Node | None:
    """
    Return the tree of a parameter file; tables of one key that stands twice are joined.

    It is for reading. The latest are kept: the start of a robot asks ten times for one file, and
    to parse that takes milliseconds.

    So rcl reads it: ``/**:`` may stand above every node of a file, and each counts. PyYAML would
    keep the last one.
    """
    tree = yaml.compose(text, Loader=_Loader)
    if tree is not None:
        _join_tables(tree, set())
    return tree


def _join_tables(node: yaml.Node, seen: set[int]) -> None:
    if not isinstance(node, yaml.MappingNode) or id(node) in seen:
        return
    seen.add(id(node))  # an anchor may hold itself
    first: dict[str, yaml.MappingNode] = {}
    kept = []
    for key, value in node.value:
        name = key.value if isinstance(key, yaml.ScalarNode) else ''
        if name in first and isinstance(value, yaml.MappingNode):
            first[name].value.extend(value.value)
            continue
        if name and isinstance(value, yaml.MappingNode):
            first[name] = value
        kept.append((key, value))
    node.value = kept
    for _, value in kept:
        _join_tables(value, seen)


def content_of(text: str) -> Any:
    """Return what the text of a parameter file holds. Raises what PyYAML raises."""
    tree = compose(text)
    return None if tree is None else _Loader('').construct_document(tree)


def whole_content_of(text: str) -> Any:
    """Return what a text holds once aliases are written out. Raises what PyYAML raises."""
    return yaml.load(text, Loader=_SourceLoader)


def file_names(text: str) -> list[str]:
    """Return the names in a list with commas; a file whose own name has commas is one."""
    if Path(text).is_file():
        return [text]
    return [name for each in text.split(',') if (name := each.strip())]


def given_files(files: str | Path | Sequence[str | Path] | None, argument: str = '') -> list[Path]:
    """
    Return parameter files that are given: one, several, or names between commas.

    Args:
        files: Names, paths, or ``package://`` URIs; None, or empty: none is given.
        argument: Of which they are the value, for the message.

    Raises:
        ResourceError: One is not there.
    """
    names = [files] if isinstance(files, str | Path) else files or ()
    return [path_of(name, argument) for each in names for name in file_names(str(each))]


def read_parameter_file(path: Path) -> dict[str, Any]:
    """
    Return a parameter file as YAML gives it: nodes, perhaps below their namespaces.

    Raises:
        ParameterError: it is not a parameter file; with line and column where there are any.
    """
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        hint = hint_at(path) if isinstance(error, FileNotFoundError) else ''
        raise ParameterError(f"parameter file '{path}': {error.strerror}{hint}") from error
    except UnicodeDecodeError as error:
        raise ParameterError(f"parameter file '{path}': not UTF-8 text ({error})") from error
    try:
        content = load_yaml(text, content_of)
        for _ in sections(content if isinstance(content, dict) else {}):
            pass
    except YamlError as error:
        line = ''.join(f':{number}' for number in error.where or ())
        tabs = '; YAML is indented by spaces, not tabs' if "'\\t'" in str(error) else ''
        raise ParameterError(f'{path}{line}: {error}{tabs}') from error
    except SectionError as error:
        number, _ = find_keys(compose(text), error.keys)
        raise ParameterError(f'{path}:{number}: {error}') from error
    except ParameterError as error:
        raise ParameterError(f"parameter file '{path}': {error}") from error
    except RecursionError as error:  # an anchor that holds itself
        raise ParameterError(f"parameter file '{path}': it is nested too deeply") from error
    if not isinstance(content, dict) or not content:
        raise ParameterError(f"parameter file '{path}' holds no node; {_SHAPE}")
    return content


class SectionError(ParameterError):
    """What stands at ``keys`` of a file is no section; they are those above it, and its own."""

    def __init__(self, problem: str, keys: tuple[Any, ...]) -> None:
        super().__init__(problem)
        self.keys = keys


@dataclass(frozen=True, slots=True)
class Section:
    """The parameters of a node, or of those that a pattern matches, in a parameter file."""

    keys: tuple[Any, ...]
    """Those above ``ros__parameters`` in the file, from outside to inside."""
    parameters: Any
    """As YAML gives them: a mapping, if the file is good."""

    @property
    def pattern(self) -> str:
        """The full name of the node, perhaps with wildcards."""
        return ''.join(f'/{str(key).strip("/")}' for key in self.keys)

    def is_of(self, node: str) -> bool:
        """Return whether it is for a node, given by its full name."""
        wildcards = {'**': '(/[^/]+)*', '*': '/[^/]+'}
        parts = self.pattern.removeprefix('/').split('/')
        expression = ''.join(wildcards.get(part, f'/{re.escape(part)}') for part in parts)
        return re.fullmatch(expression, node) is not None


def sections(content: Mapping[Any, Any], above: tuple[Any, ...] = ()) -> Iterator[Section]:
    """Yield the sections of a file in their order. Raises SectionError: a node has none."""
    for key, value in content.items():
        keys = (*above, key)
        if not isinstance(value, dict):
            raise SectionError(
                f"below '{'/'.join(map(str, keys))}' stands {value!r}, and no {KEY}; {_SHAPE}",
                keys,
            )
        if KEY in value:
            yield Section(keys, value[KEY])
            continue
        meant = [name for name in value if _is_misspelt(name)]
        if meant:
            raise SectionError(
                f"'{meant[0]}' is misspelt: write {KEY}, with two underscores in front of "
                f"'parameters'",
                (*keys, meant[0]),
            )
        yield from sections(value, keys)


def _is_misspelt(name: Any) -> bool:
    """Return whether a key is meant as :data:`KEY`: ``ros_parameters``, ``ros__params``."""
    return bool(closest_match(str(name), [KEY], 0.75))


def find_keys(tree: yaml.Node | None, keys: tuple[Any, ...]) -> tuple[int, yaml.Node]:
    """
    Return the line of the innermost key, and the node below it.

    Args:
        tree: what :func:`compose` makes of the file, which holds something.
        keys: from outside to inside.
    """
    assert tree is not None, 'what holds keys is not empty'
    line = tree.start_mark.line + 1
    for key in keys:
        line, tree = _entry(tree, key)
    return line, tree


def _entry(tree: yaml.Node, key: Any) -> tuple[int, yaml.Node]:
    """Return the line of a key and the node below it; of what is merged in, that of the whole."""
    if isinstance(tree, yaml.SequenceNode) and len(tree.value) == 1:
        tree = tree.value[0]
    if isinstance(tree, yaml.MappingNode):
        for name, below in reversed(tree.value):  # of a value that stands twice the last counts
            if name.value == str(key):
                return name.start_mark.line + 1, below
    return tree.start_mark.line + 1, tree


def flatten(
    parameters: Mapping[Any, Any], above: tuple[Any, ...] = ()
) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """
    Yield (keys from outside to inside, value) of every parameter; see :func:`dotted`.

    A list of one table counts as the table, as rcl reads it: gpio_controllers are configured so.
    """
    for key, value in parameters.items():
        if isinstance(value, list) and len(value) == 1 and isinstance(value[0], Mapping):
            value = value[0]
        if isinstance(value, Mapping):
            yield from flatten(value, (*above, key))
        else:
            yield (*above, key), value


def dotted(keys: tuple[Any, ...]) -> str:
    """Return the name of the parameter at these keys."""
    return '.'.join(map(str, keys))


def parameter_file_text(node: str, parameters: Mapping[str, Any]) -> str:
    """
    Return a parameter file that rcl reads as it is meant, and ``ros2 param dump`` prints.

    Args:
        node: the full name of the node, or a pattern.
        parameters: values that ROS has types for, by dotted name.
    """
    return text_of({node: {KEY: _nested(parameters)}}, sort_keys=True)


def text_of(content: Any, *, sort_keys: bool = False, width: float = 80) -> str:
    """Return the text of a parameter file in which :func:`content_of` finds the same."""
    options: dict[str, Any] = {'default_flow_style': False, 'width': width}
    return yaml.dump(content, Dumper=_Dumper, sort_keys=sort_keys, **options)


class _Dumper(yaml.SafeDumper):
    """Quotes the strings that rcl would not read as such."""

    def represent_text(self, text: str) -> yaml.ScalarNode:
        style = "'" if not isinstance(scalar_of(text), str) else None
        return self.represent_scalar('tag:yaml.org,2002:str', text, style)


_Dumper.add_representer(str, _Dumper.represent_text)


def _nested(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Put ``a.b`` as b below a, unless a has a value of its own."""
    tree: dict[str, Any] = {}
    for name, value in sorted(parameters.items()):
        table, rest = tree, name
        while '.' in rest and isinstance(table.get(rest.partition('.')[0], {}), dict):
            above, _, rest = rest.partition('.')
            table = table.setdefault(above, {})
        table[rest] = value
    return tree


def _code_point(character: int | str | bytes) -> str:
    """PyYAML reports a number, but its own annotations allow the character."""
    return f'U+{character if isinstance(character, int) else ord(character):04X}'
