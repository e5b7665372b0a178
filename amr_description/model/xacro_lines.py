# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Expansion of xacro files that keeps the lines: of every element, and of what cannot be expanded.

xacro itself forgets them. Every element that it parses gets its origin as user data of DOM, which
goes on to the copies that are made of a macro.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any
from xml.dom import minidom, UserDataHandler
from xml.parsers.expat import ExpatError, ParserCreate

from amr_description.ament_index import package_around, package_prefix
from amr_description.errors import ResourceError
from amr_description.model.origins import Origin

_KEY = 'amr_description.origin'
_MACRO = 'xacro:macro'
# The names of elements among the local variables of xacro's functions.
_ELEMENTS = ('node', 'elt', 'tag')


class UnknownPackageError(LookupError):
    """``$(find package)`` names a package that is not there."""

    def __init__(self, package: str) -> None:
        super().__init__(package)
        self.package = package


def expanded(path: str, mappings: Mapping[str, str]) -> tuple[str, dict[int, Origin]]:
    """
    Return the text of a xacro file, and the origins of its lines on which an element begins.

    Raises whatever xacro and the expressions of the file raise; see :func:`origin_of_error`.
    """
    import xacro

    with _located_parsing(xacro), _packages_around(Path(path).parent):
        document = xacro.process_file(path, mappings=mappings)
    text = document.toprettyxml(indent='  ')
    return text, {line: origin for line, origin in _lines(text, document) if origin is not None}


def origin_of_error(error: BaseException) -> tuple[Origin | None, Origin | None]:
    """
    Return what xacro was at when it raised an error, and where the outermost macro was called.

    None: it is not known, or there was no macro.
    """
    at = called = None
    trace: TracebackType | None = error.__traceback__
    while trace is not None:
        frame = trace.tb_frame
        if frame.f_globals.get('__name__') == 'xacro':
            found = [_origin(frame.f_locals.get(name)) for name in _ELEMENTS]
            at = next(filter(None, found), at)
            if called is None and frame.f_code.co_name == 'handle_macro_call':
                called = at
        trace = trace.tb_next
    return at, called


def known_names(error: BaseException) -> tuple[set[str], set[str], set[str]]:
    """Return the properties, the macros and the parameters of the macro where an error arose."""
    found: dict[str, set[str]] = {'symbols': set(), 'macros': set(), 'm': set()}
    trace: TracebackType | None = error.__traceback__
    while trace is not None:
        frame = trace.tb_frame
        if frame.f_globals.get('__name__') == 'xacro':
            for name in ('symbols', 'macros'):
                table = frame.f_locals.get(name)
                while isinstance(table, Mapping):
                    found[name] |= {key for key in table if isinstance(key, str)}
                    table = getattr(table, 'parent', None)
            macro = frame.f_locals.get('m')
            found['m'] = set(getattr(macro, 'params', ())) or found['m']
        trace = trace.tb_next
    return found['symbols'], found['macros'], found['m']


@contextmanager
def _packages_around(folder: Path) -> Iterator[None]:
    """
    Have ``$(find package)`` find packages by our index, which needs no ROS, and those that are not
    installed in the sources around.
    """
    from xacro import substitution_args

    find = substitution_args._eval_find

    def found(package: str) -> str:
        try:
            return str(package_prefix(package) / 'share' / package)
        except ResourceError as error:
            around = package_around(package, folder)
            if around is None:
                raise UnknownPackageError(package) from error
            return str(around)

    substitution_args._eval_find = found
    try:
        yield
    finally:
        substitution_args._eval_find = find


@contextmanager
def _located_parsing(xacro: Any) -> Iterator[None]:
    """Have xacro's parser note the lines, in included files too, and where macros are called."""
    parse, call_macro = xacro.parse, xacro.handle_macro_call
    calls: list[Origin | None] = []

    def located(inp: Any, filename: str | None = None) -> minidom.Document:
        document = parse(inp, filename)
        if inp is None and filename is not None:
            _note_lines(document, filename, _Copy(calls))
        return document

    def traced(node: Any, *tables: Any) -> bool:
        calls.append(_origin(node))
        try:
            return bool(call_macro(node, *tables))
        finally:
            calls.pop()

    xacro.parse, xacro.handle_macro_call = located, traced
    try:
        yield
    finally:
        xacro.parse, xacro.handle_macro_call = parse, call_macro


def _note_lines(document: minidom.Document, file: str, copy: '_Copy') -> None:
    with open(file, 'rb') as stream:
        lines = _start_lines(stream.read())
    for element, line in zip(document.getElementsByTagName('*'), lines, strict=False):
        element.setUserData(_KEY, Origin(file, line, _macro_above(element)), copy)


class _Copy(UserDataHandler):
    """Hands the origin of an element on to its copies, with the call of the macro."""

    def __init__(self, calls: list[Origin | None]) -> None:
        """``calls``: of the macros that are being expanded, the innermost one last."""
        self._calls = calls

    def handle(self, operation: int, key: str, data: Origin, src: Any, dst: Any) -> None:
        """Called by DOM when an element was copied, renamed or moved to another document."""
        if operation != self.NODE_CLONED:
            return
        call = self._calls[-1] if self._calls else None
        if data.macro and call is not None and data.called is None:
            data = replace(data, called=(call.file, call.line))
        dst.setUserData(key, data, self)


def _macro_above(element: Any) -> str:
    """Return the name of the macro that an element stands in, or ''."""
    above = element.parentNode
    while above is not None:
        if getattr(above, 'tagName', '') == _MACRO:
            return above.getAttribute('name').removeprefix('xacro:')
        above = above.parentNode
    return ''


def _origin(node: Any) -> Origin | None:
    """Return the origin of an element, or of that around a text."""
    while node is not None and hasattr(node, 'parentNode'):
        if hasattr(node, 'getUserData'):
            origin = node.getUserData(_KEY)
            if isinstance(origin, Origin):
                return origin
        node = node.parentNode
    return None


def _lines(text: str, document: minidom.Document) -> Iterator[tuple[int, Origin | None]]:
    """Yield the line of each element of the expanded text, and its origin."""
    elements = document.getElementsByTagName('*')
    for line, element in zip(_start_lines(text.encode()), elements, strict=False):
        yield line, _origin(element)


def _start_lines(text: bytes) -> list[int]:
    """Return the line on which each element begins, in the order of the text."""
    lines: list[int] = []
    parser = ParserCreate()
    parser.StartElementHandler = lambda *_: lines.append(parser.CurrentLineNumber)
    try:
        parser.Parse(text, True)
    except ExpatError:  # it was reported when the document was parsed
        return []
    return lines
