# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The URDF text of a robot description file; xacro files are expanded.

A file whose name ends in ``.xacro`` goes through the xacro library, which evaluates its includes,
properties, macros and conditions; ``$(find package)`` uses the ament index. Its expressions are
Python: a description must be trusted like a program. An endless one can be stopped by Ctrl-C.

``python -m amr_description.model.description_file FILE [NAME:=VALUE …]`` prints the text, or one
line on stderr that says why there is none, for programs that expand a file in another process.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
import re
import sys
from typing import Any
from urllib.parse import parse_qsl
from xml.parsers.expat import ErrorString, ExpatError

from amr_description.ament_index import resolve_uri
from amr_description.errors import AmrError, DescriptionError, UsageError
from amr_description.model.mesh_paths import with_absolute_paths
from amr_description.model.xml_reader import read_file
from amr_description.text import one_line, quote, quote_all, unwrap

SUFFIX = '.xacro'
_NO_MAPPINGS: Mapping[str, str] = {}
# xacro prefixes its messages with the class of the exception that it caught.
_CLASS = re.compile(r"^<class '[^']*'>: ")
_SHOWN_STEPS = 6


def is_xacro(path: str | Path) -> bool:
    """Return whether a file is expanded: ``robot.urdf.xacro``, ``robot.xacro``."""
    return str(path).endswith(SUFFIX)


def source_name(path: str | Path) -> str:
    """
    Return the name that messages use for the text of :func:`description_text`.

    It says so if the text is expanded, as its lines are then not those of the file.
    """
    return f'{path} (expanded)' if is_xacro(path) else str(path)


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
    if is_xacro(path):
        return _expanded(str(path), mappings, warn)
    if mappings:
        raise DescriptionError(
            f'{path}: takes no arguments ({", ".join(mappings)}:=…), its name does not end in '
            f'{SUFFIX}'
        )
    return read_file(path)


def description_at(
    uri: str, mappings: Mapping[str, str] | None = None, *, warn: Callable[[str], object]
) -> str:
    """
    Return the URDF at a URI, with relative paths of meshes made absolute.

    Args:
        uri: of a file; that of a xacro file may end in its arguments:
            ``package://cart/urdf/cart.urdf.xacro?wheel_radius=0.2&camera=true``.
        mappings: further arguments, which override those of the URI.
        warn: called with one line for each probable mistake.

    Raises:
        ResourceError: the package or the scheme of the URI is not known.
        DescriptionError: as :func:`description_text`.
    """
    file, _, query = uri.partition('?')
    if not is_xacro(file):
        file, query = uri, ''
    given = dict(parse_qsl(query, keep_blank_values=True)) | dict(mappings or {})
    path = resolve_uri(file)
    return with_absolute_paths(description_text(path, given, warn=warn), path.parent)


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


def _expanded(path: str, mappings: Mapping[str, str], warn: Callable[[str], object]) -> str:
    import xacro

    # Read and dropped: a file that is missing, too large or not text gets our message.
    read_file(path)
    arguments = _Arguments(mappings)
    try:
        text = xacro.process_file(path, mappings=arguments).toprettyxml(indent='  ')
    except Exception as error:  # expressions may raise anything
        raise DescriptionError(_complaint(error, path)) from None
    unknown = [name for name in mappings if name not in arguments.asked]
    if unknown:
        known = sorted(str(name) for name in arguments.asked)
        warn(f'{path}: nothing asks for {quote_all(unknown)}; its arguments: {quote_all(known)}')
    return text


def _complaint(error: Exception, path: str) -> str:
    """Return one line: file, line if known, reason, and in which macros xacro was."""
    import xacro

    files = [str(file) for file in xacro.filestack or [path]]
    location = files[-1]
    if isinstance(error, ExpatError):
        location = f'{location}:{error.lineno}'
        reason = f'not well-formed XML: {ErrorString(error.code)}'
    elif isinstance(error, RecursionError):
        reason = 'nested too deeply; does a macro or an include contain itself?'
    else:
        reason = unwrap(' '.join(_words(error)))
    return one_line(f'{location}: {reason}{_macro_trace(xacro.macrostack or [], files[:-1])}')


def _words(error: BaseException) -> Iterator[str]:
    """Yield the texts of an error and of those that xacro wrapped in it."""
    import xacro

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


def _macro_trace(macros: Sequence[Any], files: Sequence[str]) -> str:
    """Return the macros that were being expanded, innermost first, and the including files."""
    names = [quote(macro.body.getAttribute('name')) for macro in reversed(macros)]
    steps = [f'{"called by" if i else "in macro"} {name}' for i, name in enumerate(names)]
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
        text = description_text(path, mappings_of(words), warn=_print_warning)
        sys.stdout.buffer.write(text.encode('utf-8', 'xmlcharrefreplace'))
    except AmrError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    return 0


def _print_warning(line: str) -> None:
    print(f'warning: {line}', file=sys.stderr)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
