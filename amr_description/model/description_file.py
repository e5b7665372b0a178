# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The URDF text of a robot description file; xacro files are expanded.

A file that holds xacro, whatever its name (``xacro_markup.py``), goes through the xacro library,
which evaluates its includes, properties, macros and conditions; ``$(find package)`` uses the ament
index. Its expressions are Python: a description must be trusted like a program. An endless one can
be stopped by Ctrl-C.

``python -m amr_description.model.description_file FILE [NAME:=VALUE …]`` prints the text, or one
line on stderr that says why there is none, for programs that expand a file in another process.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
import re
import sys
from typing import Any
from urllib.parse import parse_qsl
from xml.parsers.expat import ErrorString, ExpatError

from amr_description.ament_index import packages, prefixes, resolve_uri
from amr_description.errors import AmrError, DescriptionError, UsageError
from amr_description.model.findings import Finding
from amr_description.model.mesh_paths import with_absolute_paths
from amr_description.model.origins import Origin, with_file, with_origins
from amr_description.model.xacro_markup import has_xacro_elements, is_named_xacro, is_xacro
from amr_description.model.xml_reader import parse_xml, read_file
from amr_description.text import closest_match, did_you_mean, one_line, quote, quote_all, unwrap

_NO_MAPPINGS: Mapping[str, str] = {}
# xacro prefixes its messages with the class of the exception that it caught.
_CLASS = re.compile(r"^<class '[^']*'>: ")
_SHOWN_STEPS = 6
_NOT_WELL_FORMED = 'not well-formed XML: '


def mappings_of(words: Sequence[str]) -> dict[str, str]:
    """Return xacro arguments ``name:=value``; the last one of a name wins. Raises UsageError."""
    mappings = {}
    for word in words:
        name, separator, value = word.partition(':=')
        if not (separator and name.strip()):
            raise UsageError(f"'{word}' is no argument of a xacro file; write name:=value")
        mappings[name.strip()] = value.strip()
    return mappings


def description_text(
    path: str | Path,
    mappings: Mapping[str, str] = _NO_MAPPINGS,
    *,
    warn: Callable[[str], object] = lambda _line: None,
) -> str:
    """
    Return the URDF of a file; a xacro file is expanded.

    Args:
        path: the file.
        mappings: values of the ``<xacro:arg>`` of the file.
        warn: called with one line for each probable mistake.

    Raises:
        DescriptionError: the file cannot be read or expanded; says the file, the reason, and in
            which macro xacro was.
    """
    return _read(path, mappings, warn)[0]


def located_text(
    path: str | Path,
    mappings: Mapping[str, str] = _NO_MAPPINGS,
    *,
    warn: Callable[[str], object] = lambda _line: None,
) -> str:
    """Return :func:`description_text`; where it is expanded, with the origins of its lines."""
    text, origins = _read(path, mappings, warn)
    return text if origins is None else with_origins(text, origins)


def description_at(
    uri: str, mappings: Mapping[str, str] | None = None, *, warn: Callable[[str], object]
) -> str:
    """
    Return the URDF at a URI, with relative paths of meshes made absolute, and its origin.

    Args:
        uri: of a file; that of a xacro file may end in its arguments:
            ``package://cart/urdf/cart.urdf.xacro?wheel_radius=0.2&camera=true``.
        mappings: further arguments, which override those of the URI.
        warn: called with one line for each probable mistake.

    Raises:
        ResourceError: the package or the scheme of the URI is not known.
        DescriptionError: as :func:`description_text`.
    """
    path, query = split_uri(uri)
    given = dict(parse_qsl(query, keep_blank_values=True)) | dict(mappings or {})
    text, origins = _read(path, given, warn)
    text = with_file(text, str(path)) if origins is None else with_origins(text, origins)
    return with_absolute_paths(text, path.parent)


def takes_arguments(uri: str) -> bool:
    """Return whether a URI, as :func:`description_at` takes it, is that of a xacro file."""
    try:
        return is_xacro(split_uri(uri)[0])
    except AmrError:  # whoever reads it says why
        return False


def split_uri(uri: str) -> tuple[Path, str]:
    """
    Return the file of a URI, and the arguments of a xacro file behind ``?``. Raises ResourceError.
    """
    file, mark, query = uri.partition('?')
    path = resolve_uri(file)
    if mark and not is_xacro(path):  # it is part of the name
        return resolve_uri(uri), ''
    return path, query


def _read(
    path: str | Path, mappings: Mapping[str, str], warn: Callable[[str], object]
) -> tuple[str, dict[int, Origin] | None]:
    """Return the URDF of a file, and the origins of its lines; None: it is as it stands."""
    text = read_file(path)
    if not is_xacro(path, text):
        if mappings:
            raise DescriptionError(
                f'{path}: takes no arguments ({", ".join(mappings)}:=…), it holds no xacro'
            )
        return text, None
    try:
        return _expanded(str(path), mappings, warn)
    except DescriptionError as error:
        # Such as <parameters>$(find package)/…: a URDF all the same, without that package too.
        if mappings or is_named_xacro(path) or has_xacro_elements(text):
            raise
        warn(f'{error}; what it stands in is left as it is')
        return text, None


class _Arguments(dict[str, str]):
    """The arguments that xacro gets; records which of them it looks up."""

    def __init__(self, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self.asked: set[object] = set()

    def __contains__(self, name: object) -> bool:
        self.asked.add(name)
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.asked.add(name)
        return super().__getitem__(name)


def _expanded(
    path: str, mappings: Mapping[str, str], warn: Callable[[str], object]
) -> tuple[str, dict[int, Origin]]:
    """Return the text that a file expands to, and where its elements come from."""
    if find_spec('xacro') is None:
        raise DescriptionError(
            f'{path}: it holds xacro, and the package that expands it is not installed: pip '
            'install xacro'
        )
    from amr_description.model.xacro_lines import expanded

    arguments = _Arguments(mappings)
    try:
        text, origins = expanded(path, arguments)
    except Exception as error:  # expressions may raise anything
        raise DescriptionError(_complaint(error, path)) from None
    unknown = [name for name in mappings if name not in arguments.asked]
    if unknown:
        known = sorted(str(name) for name in arguments.asked)
        warn(f'{path}: nothing asks for {quote_all(unknown)}; its arguments: {quote_all(known)}')
    return text, origins


def _complaint(error: Exception, path: str) -> str:
    """Return one line: file, line if known, reason, and in which macros xacro was."""
    import xacro

    from amr_description.model.xacro_lines import origin_of_error

    files = [str(file) for file in xacro.filestack or [path]]
    location, called = files[-1], None
    if isinstance(error, ExpatError):
        location = f'{files[-1]}:{error.lineno}'
        reason = _NOT_WELL_FORMED + _markup_fault(files[-1], error)
    elif isinstance(error, RecursionError):
        reason = 'nested too deeply; does a macro or an include contain itself?'
    else:
        reason = unwrap(' '.join(_words(error))) + _hint(error)
        at, called = origin_of_error(error)
        location = f'{at.file}:{at.line}' if at is not None else location
    trace = _macro_trace(xacro.macrostack or [], called, files[:-1])
    return one_line(f'{location}: {reason}{trace}')


def _words(error: BaseException) -> Iterator[str]:
    """Yield the texts of an error and of those that xacro wrapped in it."""
    import xacro

    from amr_description.model.xacro_lines import UnknownPackageError

    if isinstance(error, UnknownPackageError):
        yield _missing_package(error.package)
        return
    if not isinstance(error, xacro.XacroException):
        kind = type(error)
        yield f'{kind.__name__}: {error}' if kind.__module__ == 'builtins' else str(error)
        return
    own = ' '.join(str(word) for word in error.args if word)
    if isinstance(error.exc, OSError) and own:  # a missing include: its own text is complete
        yield own
    elif error.exc is not None:
        yield '' if _CLASS.match(own) else own
        yield from _words(error.exc)
    else:
        yield own
    yield error.suffix or ''


def _markup_fault(path: str, error: ExpatError) -> str:
    """Return what is wrong in the text of a file; libxml2 tells more of it than expat."""
    faults: list[Finding] = []
    parse_xml(read_file(path), path, faults.append)
    found = faults[0].what if faults else ''
    told = found.removeprefix(_NOT_WELL_FORMED) if found.startswith(_NOT_WELL_FORMED) else ''
    match = re.match(r'Opening and ending tag mismatch: (\S+) line (\d+) and (\S+)', told)
    if match:
        tag, line, end = match.groups()
        return (
            f'</{end}> stands where <{tag}> of line {line} is still open; write </{tag}> before '
            f'it, or <{tag} …/>'
        )
    if told.startswith('AttValue'):
        told += '; write the value of the attribute in quotes'
    return told or ErrorString(error.code)


def _hint(error: BaseException) -> str:
    """Return ``; did you mean …?`` or what else would do, for a name that xacro does not know."""
    from amr_description.model.xacro_lines import known_names

    symbols, macros, parameters = known_names(error)
    text = ' '.join(_words(error))
    for pattern, known, prefix in (
        (r"name '(\w+)' is not defined", symbols, ''),
        (r'unknown macro name: xacro:(\S+)', macros, 'xacro:'),
        (r'Invalid parameter "(\w+)"', parameters, ''),
    ):
        match = re.search(pattern, text)
        meant = closest_match(match[1], known) if match else ''
        if meant:
            return f'; did you mean {prefix}{meant}?'
    match = re.search(r'Undefined parameters \[(\w+)', text)
    if match:
        return f'; give {match[1]}="…" where the macro is called'
    match = re.search(r'No such file or directory: (.+)$', text)
    if match:
        path = Path(match[1].strip())
        return did_you_mean(path.name, [each.name for each in path.parent.glob('*')])
    return ''


def _missing_package(name: str) -> str:
    """Return that there is no such package, and what would do."""
    if not prefixes():
        return (
            f"package '{name}' not found: AMENT_PREFIX_PATH is empty; source install/setup.bash "
            'of its workspace, or have the package lie beside the file, with its package.xml'
        )
    near = closest_match(name, packages(), 0.8)
    return (
        f"package '{name}' not found in AMENT_PREFIX_PATH; build it and source install/setup.bash "
        f'of its workspace, or correct the name{f"; did you mean {near}?" if near else ""}'
    )


def _macro_trace(macros: Sequence[Any], called: Origin | None, files: Sequence[str]) -> str:
    """Return the macros that were being expanded, innermost first, and the including files."""
    names = [quote(macro.body.getAttribute('name')) for macro in reversed(macros)]
    steps = [f'{"called by" if i else "in macro"} {name}' for i, name in enumerate(names)]
    if names and called is not None:
        steps.append(f'called at {called.file}:{called.line}')
    steps += [f'included from {file}' for file in reversed(files)]
    if len(steps) > _SHOWN_STEPS:
        steps[_SHOWN_STEPS:] = ['…']
    return f' ({", ".join(steps)})' if steps else ''


def main(arguments: Sequence[str]) -> int:
    """Print the text of ``FILE NAME:=VALUE …``; return the exit code."""
    try:
        if not arguments:
            raise UsageError('usage: FILE [NAME:=VALUE ...]')
        path, *words = arguments
        text, origins = _read(path, mappings_of(words), _print_warning)
        text = with_file(text, path) if origins is None else with_origins(text, origins)
        sys.stdout.buffer.write(text.encode('utf-8', 'xmlcharrefreplace'))
    except AmrError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    return 0


def _print_warning(line: str) -> None:
    print(f'warning: {line}', file=sys.stderr)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
