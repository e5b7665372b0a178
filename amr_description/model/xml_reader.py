# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
XML from strangers, with true line numbers: safe loading, and attributes read with a clear word on every fault.

Refused, in bounded time and memory: files over :data:`MAX_BYTES`, nesting beyond libxml2's 256 levels, and every
document type declaration, so that there are no entities to expand and nothing to fetch.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
import math
from pathlib import Path
import re
from typing import BinaryIO

from lxml import etree

from amr_description.errors import DescriptionError
from amr_description.model.findings import Finding, quote, Report

# The largest published robots stay below 1 MiB: meshes are files of their own.
MAX_BYTES = 8 * 2**20
_TOO_LARGE = f'larger than {MAX_BYTES // 2**20} MiB, which no robot description is'

_ENCODINGS = (
    'utf-8',
    'utf8',
    'us-ascii',
    'ascii',
    'iso-8859-1',
    'latin1',
    'iso-8859-15',
    'windows-1252',
)
_DECLARED_ENCODING = re.compile(rb'\A\s*<\?xml[^>]*?encoding\s*=\s*["\']([^"\']*)["\']')
# Atomic groups and possessive repeats (*+): linear time also on a file made to make it backtrack.
_DOCUMENT_TYPE = re.compile(
    r'\A(?>\s+|<\?.*?\?>|<!--.*?-->)*+<!DOCTYPE', re.DOTALL | re.IGNORECASE
)
# What urdfdom reads as a number; Python's float() would also take 1_000, nan and Arabic digits.
_NUMBER = re.compile(r'[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?', re.ASCII)
_NOT_FINITE = re.compile(r'[+-]?(?:nan|inf|infinity)', re.IGNORECASE)

# The numbers by which tinyxml2, urdfdom's parser, calls the faults that libxml2 names on the left.
_TINYXML = {
    etree.ErrorTypes.ERR_DOCUMENT_EMPTY: ('XML_ERROR_EMPTY_DOCUMENT', 13),
    etree.ErrorTypes.ERR_TAG_NAME_MISMATCH: ('XML_ERROR_MISMATCHED_ELEMENT', 14),
}


def read_file(path: str | Path) -> str:
    """Return the text of a description file; DescriptionError when it cannot be read."""
    try:
        with open(path, 'rb') as stream:
            return read_stream(stream, str(path))
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
        raise DescriptionError(
            f'cannot read the description {quote(str(path))}: {reason}'
        ) from None


def read_stream(stream: BinaryIO, source: str) -> str:
    """Return the text of an open binary stream, such as ``sys.stdin.buffer``."""
    return decode(stream.read(MAX_BYTES + 1), source)


def decode(data: bytes, source: str) -> str:
    """Return the text of a description: UTF-8, or the encoding that its XML declaration names."""
    if len(data) > MAX_BYTES:
        raise DescriptionError(f'{source}: {_TOO_LARGE}')
    match = _DECLARED_ENCODING.match(data)
    encoding = match[1].decode('ascii', 'replace').lower() if match else 'utf-8'
    if encoding not in _ENCODINGS:
        raise DescriptionError(
            f'{source}:1: unknown encoding {quote(encoding)}; save the file as UTF-8 and declare that'
        )
    try:
        return data.decode('utf-8-sig' if encoding in ('utf-8', 'utf8') else encoding)
    except UnicodeDecodeError as error:
        line = data.count(b'\n', 0, error.start) + 1
        raise DescriptionError(
            f'{source}:{line}: byte {error.start} is not {encoding.upper()}; save the file as UTF-8'
        ) from None


def parse_xml(text: str, source: str, report: Report) -> etree._Element | None:
    """Return the root element, or report why there is none and return None."""
    refusal = _refusal(text)
    if refusal:
        report(Finding.error(source, 1, refusal))
        return None
    # The explicit encoding overrides the declaration, which was true for the bytes, not for this text.
    parser = etree.XMLParser(
        encoding='utf-8', resolve_entities=False, no_network=True, load_dtd=False
    )
    try:
        return etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        report(_syntax_finding(error, source, empty=not text.strip()))
        return None


def _refusal(text: str) -> str:
    """Return why a text does not even get to the XML parser, or ''."""
    if len(text) > MAX_BYTES:
        return _TOO_LARGE
    if not text.isascii() and any('\ud800' <= character <= '\udfff' for character in text):
        return 'the text is not valid Unicode: it holds half a surrogate pair'
    if _DOCUMENT_TYPE.match(text):
        return 'a document type declaration (<!DOCTYPE …>) is refused, and with it every entity; remove it'
    return ''


def _syntax_finding(error: etree.XMLSyntaxError, source: str, *, empty: bool) -> Finding:
    line = error.lineno or 1
    name, number = _TINYXML.get(error.code, ('XML_ERROR_PARSING', 15))
    if empty:
        name, number, line = 'XML_ERROR_EMPTY_DOCUMENT', 13, 1
    # libxml2 repeats the place at the end of its message; the finding begins with it.
    reason = re.sub(r', line \d+, column \d+.*$', '', error.msg or '', flags=re.DOTALL)
    return Finding.error(
        source,
        line,
        'the description is empty' if empty else 'not well-formed XML',
        found='' if empty else reason,
        expected='a URDF, <robot name="…"> … </robot>' if empty else '',
        urdfdom=f'Error={name} ErrorID={number} ({number:#x}) Line number={line}',
    )


@dataclass(frozen=True, slots=True)
class ElementReader:
    """
    Reads attributes; a fault goes to ``report`` and a neutral value comes back, should ``report`` return.

    ``label`` names the part being read (``joint "j1"``), ``urdfdom`` holds urdfdom's words where it refuses the
    file for a fault in this part.
    """

    source: str
    report: Report
    label: str = ''
    urdfdom: str = ''

    def of(self, label: str, urdfdom: str = '') -> 'ElementReader':
        """Return the reader of a part."""
        return replace(self, label=label, urdfdom=urdfdom)

    def refused_as(self, urdfdom: str) -> 'ElementReader':
        """Return the same reader for an element whose faults urdfdom calls ``urdfdom``."""
        return replace(self, urdfdom=urdfdom)

    def error(self, element: etree._Element, what: str, **details: str) -> None:
        """Report an error at ``element``; ``details`` as in :meth:`Finding.error`."""
        self._report(Finding.error, element, what, details)

    def warning(self, element: etree._Element, what: str, **details: str) -> None:
        """Report a warning at ``element``."""
        self._report(Finding.warning, element, what, details)

    def _report(
        self,
        kind: Callable[..., Finding],
        element: etree._Element,
        what: str,
        details: dict[str, str],
    ) -> None:
        label = f'{self.label}: ' if self.label else ''
        if kind == Finding.error:
            details.setdefault('urdfdom', self.urdfdom)
        self.report(kind(self.source, line_of(element), f'{label}{what}', **details))

    def required(self, element: etree._Element, attribute: str, **details: str) -> str:
        """Return the text of an attribute that must be there and not be empty; '' after a report."""
        value = element.get(attribute, '').strip()
        if not value:
            self.error(element, f'<{element.tag}> has no attribute "{attribute}"', **details)
        return value

    def number(
        self, element: etree._Element, attribute: str, default: float | None = None
    ) -> float:
        """Return one number; without a default it must be there. NaN after a report."""
        fallback = None if default is None else (default,)
        return self.numbers(element, attribute, 1, fallback)[0]

    def numbers(
        self,
        element: etree._Element,
        attribute: str,
        count: int,
        default: tuple[float, ...] | None = None,
    ) -> tuple[float, ...]:
        """Return ``count`` finite numbers; without a default they must be there. NaNs after a report."""
        text = element.get(attribute)
        expected = 'a number' if count == 1 else f'{count} numbers'
        if text is None and default is not None:
            return default
        if text is None:
            self.error(
                element, f'<{element.tag}> has no attribute "{attribute}"', expected=expected
            )
            return (math.nan,) * count
        words = text.split()
        values = [_number(word) for word in words]
        if len(words) != count or not all(map(math.isfinite, values)):
            finite = f'{expected}, finite' if any(map(_not_finite, words)) else expected
            self.error(
                element, f'{attribute} of <{element.tag}>', found=quote(text), expected=finite
            )
            return (math.nan,) * count
        return tuple(values)

    def flag(self, element: etree._Element, attribute: str, default: bool) -> bool:
        """Return a truth value, written ``true`` or ``false``; the default after a report."""
        text = element.get(attribute)
        if text is not None and text.lower() not in ('true', 'false'):
            self.error(
                element,
                f'{attribute} of <{element.tag}>',
                found=quote(text),
                expected='true or false',
            )
            return default
        return default if text is None else text.lower() == 'true'


def line_of(element: etree._Element) -> int:
    """Return the line of the file on which the element begins."""
    return element.sourceline or 1


def _not_finite(word: str) -> bool:
    return bool(_NOT_FINITE.fullmatch(word)) or math.isinf(_number(word))


def _number(word: str) -> float:
    return float(word) if _NUMBER.fullmatch(word) else math.nan
