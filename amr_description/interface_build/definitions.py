# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is wrong in ``.msg``, ``.srv`` and ``.action`` files, with line and column.

rosidl, which would find the same, stops at the first fault and does not say where it is. Its
parser judges what is not looked at here: the values of constants and defaults.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
import keyword
from pathlib import Path
import re
from typing import NamedTuple
import warnings

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build.packages import InterfacePackage, Underlay
from amr_description.text import closest_match, did_you_mean, one_line

SEPARATOR = '---'
# How many parts there are, and what the lines between them stand between.
PARTS = {'.msg': ('fields',), '.srv': ('request', 'response'),
         '.action': ('goal', 'result', 'feedback')}  # fmt: skip
PRIMITIVES = (
    'bool', 'byte', 'char', 'float32', 'float64', 'int8', 'uint8', 'int16', 'uint16', 'int32',
    'uint32', 'int64', 'uint64', 'string', 'wstring',
)  # fmt: skip
# Types of other languages and of ROS 1, and what they are called here.
OTHER_NAMES = {
    'int': 'int32', 'uint': 'uint32', 'long': 'int64', 'short': 'int16', 'float': 'float32',
    'double': 'float64', 'boolean': 'bool', 'str': 'string', 'time': 'builtin_interfaces/Time',
    'duration': 'builtin_interfaces/Duration', 'Header': 'std_msgs/Header',
}  # fmt: skip
FIELD_NAME = re.compile(r'(?!.*__)(?!.*_$)[a-z][a-z0-9_]*')
CONSTANT_NAME = re.compile(r'[A-Z]([A-Z0-9_]?[A-Z0-9]+)*')
MESSAGE_NAME = re.compile(r'[A-Z][A-Za-z0-9]*')
LOWER_CASE = 'lower-case letters, digits and single underscores, a letter first'


class DefinitionFault(NamedTuple):
    """What is wrong, and where; line and column count from 1."""

    line: int
    column: int
    text: str


class Reference(NamedTuple):
    """A message type that a field is of; of which ``package`` '' is the file's own."""

    line: int
    column: int
    package: str
    name: str


class FileFault(NamedTuple):
    """A fault and its file, relative to the package."""

    path: Path
    fault: DefinitionFault

    def __str__(self) -> str:
        """Return ``path:line:column: text``, on one line."""
        return one_line(f'{self.path}:{self.fault.line}:{self.fault.column}: {self.fault.text}')


@dataclass(frozen=True)
class InterfaceDefinition:
    """An interface file that has been read."""

    faults: list[DefinitionFault]
    references: list[Reference]


class _Line(NamedTuple):
    """A line with a field or a constant; columns count from 1."""

    number: int
    type: str
    rest: str
    rest_column: int


def read_definition(text: str, path: Path) -> InterfaceDefinition:
    """Return what is wrong in an interface file, and the message types that it refers to."""
    faults = list(_escapes(text)) + list(_file_name(path))
    references: list[Reference] = []
    separators: list[int] = []
    names: set[str] = set()
    lines = text.splitlines()
    for number, whole in enumerate(lines, 1):
        if whole == SEPARATOR and path.suffix != '.msg':
            separators.append(number)
            names.clear()
            continue
        content = whole.replace('\t', ' ').partition('#')[0].rstrip()
        if not content:
            continue
        if set(content.strip()) == {'-'} and len(content.strip()) > 1:
            faults.append(DefinitionFault(number, 1, _no_separator(whole, path)))
        elif content[0] == ' ':
            faults.append(
                DefinitionFault(number, 1, 'a line may not begin with a space; remove it')
            )
        else:
            kind, _, rest = content.partition(' ')
            column = len(content) - len(rest.lstrip()) + 1
            line = _Line(number, kind, rest.lstrip(), column)
            found = list(_line_faults(line, names))
            faults += found
            if not any(fault.column == 1 for fault in found):
                references += _references(line)
    faults += _separator_faults(separators, path, len(lines))
    return InterfaceDefinition(sorted(faults), references)


def _escapes(text: str) -> Iterator[DefinitionFault]:
    """Yield backslashes that rosidl cannot read: it takes comments, too, for strings of C."""
    for number, line in enumerate(text.splitlines(), 1):
        comment = line.partition('#')[2].lstrip('#')
        try:
            with warnings.catch_warnings(action='ignore'):  # of those that mean nothing, as in \\d
                comment.encode().decode('unicode_escape')
        except UnicodeDecodeError as error:
            start = len(error.object[: error.start].decode(errors='replace'))
            column = len(line) - len(comment) + start + 1
            found = f'rosidl cannot read the backslash in this comment: {error.reason}'
            yield DefinitionFault(number, column, f'{found}; write it without')


def _file_name(path: Path) -> Iterator[DefinitionFault]:
    if not MESSAGE_NAME.fullmatch(path.stem):
        better = ''.join(part[:1].upper() + part[1:] for part in re.split(r'[\W_]+', path.stem))
        found = f'the file is called {path.name}, which makes no name of a type'
        yield DefinitionFault(1, 1, f'{found}; call it {better or "Name"}{path.suffix}')


def _no_separator(whole: str, path: Path) -> str:
    if path.suffix == '.msg':
        return f'{SEPARATOR} is for .srv and .action files; a .msg file has no parts'
    return f'the line between two parts is {SEPARATOR!r} alone, got {whole!r}'


def _separator_faults(separators: list[int], path: Path, count: int) -> Iterator[DefinitionFault]:
    parts = PARTS[path.suffix]
    wanted = f'{" and ".join(parts[:-1])} and {parts[-1]}' if len(parts) > 1 else ''
    if len(separators) < len(parts) - 1:
        needed = f'{len(parts) - 1} lines {SEPARATOR}, got {len(separators)}'
        needed = needed if len(parts) > 2 else f'a line {SEPARATOR}, got none'
        yield DefinitionFault(max(count, 1), 1, f'between {wanted} there must be {needed}')
    for number in separators[len(parts) - 1 :]:
        yield DefinitionFault(
            number, 1, f'one {SEPARATOR} too many: a {path.suffix} file has {wanted} only'
        )


def _line_faults(line: _Line, names: set[str]) -> Iterator[DefinitionFault]:
    fault = _type_fault(line.type)
    if fault:
        yield DefinitionFault(line.number, 1, fault)
    if not line.rest:
        wanted = 'a field is written TYPE NAME, a constant TYPE NAME=VALUE'
        yield DefinitionFault(
            line.number, len(line.type) + 1, f'{line.type!r} without a name; {wanted}'
        )
        return
    is_constant = '=' in line.rest
    name = re.split('[ =]', line.rest, maxsplit=1)[0]
    if is_constant:
        name = line.rest.partition('=')[0].rstrip()
    wrong = _constant_name_fault(name, line) if is_constant else _field_name_fault(name)
    if not wrong and name in names:
        wrong = f'{name!r} stands here twice; give it another name'
    names.add(name)
    if wrong:
        yield DefinitionFault(line.number, line.rest_column, wrong)
    elif not fault:
        yield from _value_faults(line, name, is_constant=is_constant)


def _type_fault(kind: str) -> str:
    """Return what is wrong with a type; '' if nothing is."""
    base = kind
    if kind.endswith(']'):
        base, bracket, size = kind[:-1].rpartition('[')
        if not bracket:
            return f'{kind!r} ends with ] and has no ['
        bound = size.removeprefix('<=')
        if size and not (bound.isdecimal() and int(bound) > 0):
            wanted = '[], [3] or [<=3], with a number of 1 or more'
            return f'{kind!r} is no array: want {base}{wanted}'
    if base in PRIMITIVES:
        return ''
    text, is_bounded, bound = base.partition('<=')
    if is_bounded:
        if text in ('string', 'wstring') and bound.isdecimal() and int(bound) > 0:
            return ''
        return f'{base!r} is no bounded type: want string<=10 or wstring<=10, with 1 or more'
    return _message_type_fault(base)


def _message_type_fault(base: str) -> str:
    if base in OTHER_NAMES:
        return f'no type {base!r}; its name is {OTHER_NAMES[base]} here'
    package, *names = base.split('/') if '/' in base else ('a', base)
    if len(names) == 2 and names[0] == 'msg':
        return f'{base!r} is written {package}/{names[1]} in these files'
    if len(names) == 1 and FIELD_NAME.fullmatch(package) and MESSAGE_NAME.fullmatch(names[0]):
        return ''
    if '/' in base:
        return f'{base!r} is no type; that of another package is written package_name/TypeName'
    guess = closest_match(base, PRIMITIVES)
    hint = f'; did you mean {guess}?' if guess else f': it is none of {", ".join(PRIMITIVES)}'
    return f'unknown type {base!r}{hint}'


def _field_name_fault(name: str) -> str:
    if not FIELD_NAME.fullmatch(name):
        return f'{name!r} is no name of a field: want {LOWER_CASE}{_snake_case(name)}'
    if keyword.iskeyword(name):
        return f'{name!r} is a word of Python and makes no name of a field; try {name}_value'
    return ''


def _snake_case(name: str) -> str:
    words = re.sub(r'([a-z0-9])([A-Z])', r'\1_\2', name).lower()
    better = re.sub(r'[\W_]+', '_', words).strip('_0123456789')
    return f', {better}' if FIELD_NAME.fullmatch(better) else ''


def _constant_name_fault(name: str, line: _Line) -> str:
    if line.type not in PRIMITIVES:
        return f'a constant is of a primitive type, not of {line.type!r}'
    if not CONSTANT_NAME.fullmatch(name):
        return f'{name!r} is no name of a constant: want upper-case letters, digits, underscores'
    return ''


def _value_faults(line: _Line, name: str, *, is_constant: bool) -> Iterator[DefinitionFault]:
    """Yield what rosidl says of the value of a constant or the default of a field."""
    from rosidl_adapter.parser import Constant, Field, Type

    text = line.rest[len(name) :].lstrip()
    value = text[1:].lstrip() if is_constant else text
    try:
        if is_constant:
            Constant(line.type, name, value)
        else:
            Field(Type(line.type, context_package_name='a'), name, value or None)
    except Exception as error:  # rosidl has no common base
        column = line.rest_column + len(line.rest) - len(value)
        yield DefinitionFault(
            line.number, column, f'{name}: {error}' if value else f'{name} has no value'
        )


def _references(line: _Line) -> list[Reference]:
    base = line.type.partition('[')[0]
    if base.partition('<=')[0] in PRIMITIVES:
        return []
    package, _, name = base.rpartition('/')
    return [Reference(line.number, 1, package, name)]


class PackageCheck(NamedTuple):
    """What is wrong in the files of a package, and the types of others that it refers to."""

    faults: list[FileFault]
    used: frozenset[tuple[str, str]]
    """(package, name) of messages of other packages."""

    def raise_faults(self, folder: Path) -> None:
        """Raise InterfaceBuildError with a line for each fault, if there are any."""
        if self.faults:
            raise InterfaceBuildError('\n'.join(f'{folder}/{fault}' for fault in self.faults))


def installed_messages(underlay: Underlay) -> dict[str, frozenset[str]]:
    """Return the names of the messages of each package that is installed."""
    return {
        name: frozenset(path.stem for path in underlay.share(name).glob('msg/*.json'))
        for name in underlay.prefixes
    }


def check_package(package: InterfacePackage, known: Mapping[str, Collection[str]]) -> PackageCheck:
    """
    Read all interface files of a package but its ``.idl`` files.

    Args:
        package: it may have definitions that make no sense.
        known: the names of the messages of each other package.

    Raises:
        OSError: a file cannot be read.
    """
    faults: list[FileFault] = []
    uses: dict[Path, list[Reference]] = {}
    for path in package.interfaces:
        if path.suffix not in PARTS:
            continue
        try:
            text = (package.folder / path).read_bytes().decode()
        except UnicodeDecodeError as error:
            before = error.object[: error.start]
            where = DefinitionFault(
                before.count(b'\n') + 1, error.start - before.rfind(b'\n'), str(error)
            )
            faults.append(FileFault(path, where))
            continue
        definition = read_definition(text, path)
        faults += [FileFault(path, fault) for fault in definition.faults]
        uses[path] = definition.references
    used = set()
    for path, references in uses.items():
        for each in references:
            is_own = each.package in ('', package.name)
            text = _own_fault(each.name, package) if is_own else _foreign_fault(each, known)
            if text:
                faults.append(FileFault(path, DefinitionFault(each.line, each.column, text)))
            elif not is_own:
                used.add((each.package, each.name))
    faults += _loops(package.name, uses)
    return PackageCheck(sorted(faults), frozenset(used))


def _own_fault(wanted: str, package: InterfacePackage) -> str:
    own = {path.stem for path in package.interfaces if path.parent.name == 'msg'}
    if wanted in own:
        return ''
    if (package.folder / 'msg' / f'{wanted}.msg').exists():
        return f'msg/{wanted}.msg is there, and CMakeLists.txt does not name it; add it there'
    return f'this package has no message {wanted!r}{did_you_mean(wanted, sorted(own))}'


def _foreign_fault(wanted: Reference, known: Mapping[str, Collection[str]]) -> str:
    package = wanted.package
    if package not in known:
        match = closest_match(package, known, similarity=0.8)
        found = f'no package {package!r} with messages is installed'
        if match:
            return f'{found}; did you mean {match}?'
        return f'{found}; if it is in this workspace, package.xml needs <depend>{package}</depend>'
    if wanted.name in known[package]:
        return ''
    return f'{package} has no message {wanted.name!r}{did_you_mean(wanted.name, known[package])}'


def _loops(name: str, uses: Mapping[Path, list[Reference]]) -> list[FileFault]:
    """Return a fault for messages that contain each other."""
    arrows = {
        path.stem: {each.name for each in found if each.package in ('', name)}
        for path, found in uses.items()
        if path.suffix == '.msg'
    }
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as error:
        loop = error.args[1][::-1]
        path = next(path for path in uses if path.suffix == '.msg' and path.stem == loop[0])
        at = next(each for each in uses[path] if each.name == loop[1])
        text = f'messages contain each other: {" -> ".join(loop)}'
        return [FileFault(path, DefinitionFault(at.line, at.column, text))]
    return []
