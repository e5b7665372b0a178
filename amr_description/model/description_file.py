# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The text of a robot description, wherever one names a file: URDF as it stands, or xacro expanded.

A file whose name ends in ``.xacro`` goes through the xacro library, which evaluates its includes,
properties, macros and conditions; ``$(find package)`` looks into the ament index. Expressions in
it are Python: a description is as trustworthy as a program. What has no end there ends with
Ctrl-C.

``python -m amr_description.model.description_file FILE [NAME:=VALUE …]`` prints the text, or one
line on stderr that says why there is none: for programs that want it out of their own process.
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
# xacro puts the class of what it caught in front of its words.
_CLASS = re.compile(r"^<class '[^']*'>: ")
_SHOWN_STEPS = 6


def is_xacro(path: str | Path) -> bool:
    """Tell whether a file is to be expanded: ``robot.urdf.xacro``, ``robot.xacro``."""
    return str(path).endswith(SUFFIX)


def source_name(path: str | Path) -> str:
    """
    Return what messages call the text of :func:`description_text`.

    Lines of expanded text are not those of the file, and the name says so.
    """
    return f'{path} (expanded)' if is_xacro(path) else str(path)


def mappings_of(words: Sequence[str]) -> dict[str, str]:
    """Return the arguments ``name:=value`` of xacro; the last of a name wins. UsageError."""
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
    Return the URDF that a file holds or, if it is a xacro file, stands for.

    :param mappings: Values of the ``<xacro:arg>`` of the file.
    :param warn: Told, in a line each, what is probably not meant.
    :raises DescriptionError: It cannot be read or expanded: file, reason, and where xacro was.
    """
    if is_xacro(path):
        return _expanded(str(path), mappings, warn)
    if mappings:
        raise DescriptionError(
            f'{path}: takes no arguments ({", ".join(mappings)}:=…), its name does not end in '
            f'{SUFFIX}'
        )
    return read_file(path)


class _Arguments(dict[str, str]):
    """The arguments as xacro sees them; remembers which of them it asked for."""

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

    # Read and thrown away: what is too large, no text or not there is said in our words.
    read_file(path)
    arguments = _Arguments(mappings)
    try:
        text = xacro.process_file(path, mappings=arguments).toprettyxml(indent='  ')
    except Exception as error:  # expressions of a stranger's file may raise anything
        raise DescriptionError(_complaint(error, path)) from None
    unknown = [name for name in mappings if name not in arguments.asked]
    if unknown:
        known = sorted(str(name) for name in arguments.asked)
        warn(f'{path}: nothing asks for {quote_all(unknown)}; its arguments: {quote_all(known)}')
    return text


def _complaint(error: Exception, path: str) -> str:
    """Return one line: file (and line, if it is known), reason, and how xacro got there."""
    import xacro

    files = [str(file) for file in xacro.filestack or [path]]
    place = files[-1]
    if isinstance(error, ExpatError):
        place = f'{place}:{error.lineno}'
        reason = f'not well-formed XML: {ErrorString(error.code)}'
    elif isinstance(error, RecursionError):
        reason = 'nested too deeply; does a macro or an include contain itself?'
    else:
        reason = unwrap(' '.join(_words(error)))
    return one_line(f'{place}: {reason}{_way(xacro.macrostack or [], files[:-1])}')


def _words(error: BaseException) -> Iterator[str]:
    """Yield what an error says and, if xacro wrapped it around others, what these say."""
    import xacro

    if not isinstance(error, xacro.XacroException):
        kind = type(error)
        yield f'{kind.__name__}: {error}' if kind.__module__ == 'builtins' else str(error)
        return
    own = ' '.join(str(word) for word in error.args if word)
    if isinstance(error.exc, OSError) and own:  # of a missing include: own words say it all
        yield own
    elif error.exc is not None:
        yield '' if _CLASS.match(own) else own
        yield from _words(error.exc)
    else:
        yield own
    yield error.suffix or ''


def _way(macros: Sequence[Any], files: Sequence[str]) -> str:
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


def description_at(
    uri: str, mappings: Mapping[str, str] | None = None, *, warn: Callable[[str], object]
) -> str:
    """
    The URDF at a URI; of a xacro file, expanded with ``mappings`` and those of the URI itself.

    ``package://cart/urdf/cart.urdf.xacro?wheel_radius=0.2&camera=true``. ``warn`` is told, in a
    line each, what is probably not meant. Relative paths of meshes in it are made absolute.
    Raises ResourceError, DescriptionError.
    """
    file, _, query = uri.partition('?')
    if not is_xacro(file):
        file, query = uri, ''
    given = dict(parse_qsl(query, keep_blank_values=True)) | dict(mappings or {})
    path = resolve_uri(file)
    return with_absolute_paths(description_text(path, given, warn=warn), path.parent)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
