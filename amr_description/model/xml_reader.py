# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
XML of unknown origin, loaded safely, and the attributes of its elements, with true line numbers.

Refused, in bounded time and memory: files over :data:`MAX_BYTES` or :data:`MAX_LINES`, nesting
beyond libxml2's 256 levels, and every document type declaration, so that there are no entities to
expand and nothing to fetch.
"""

from dataclasses import dataclass, replace
import math
from pathlib import Path
import re
from typing import BinaryIO

from lxml import etree

from amr_description.ament_index import hint_at
from amr_description.errors import DescriptionError
from amr_description.model.findings import Finding, Report
from amr_description.model.frames import Vector
from amr_description.model.plain_xml import plain_xml
from amr_description.text import quote

# What urdfdom reads as a number; Python's float() would also take 1_000, nan and Arabic digits.
_NUMBER = re.compile(r'[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?', re.ASCII)
_NOT_FINITE = re.compile(r'[+-]?(?:nan|inf|infinity)', re.IGNORECASE)
# The largest published robots stay below 1 MiB: meshes are files of their own.
MAX_BYTES = 4 * 2**20
# libxml2 keeps the line of an element in 16 bits; a wrong line is worse than none.
MAX_LINES = 2**16 - 2
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
# Atomic groups and possessive repeats (*+) take linear time on any file.
_DOCUMENT_TYPE = re.compile(
    r'\A(?>\s+|<\?.*?\?>|<!--.*?-->)*+<!DOCTYPE', re.DOTALL | re.IGNORECASE
)
_SURROGATE = re.compile('[\ud800-\udfff]')
# The faults that libxml2 names on the left, as tinyxml2, the parser of urdfdom, names them.
_TINYXML = {
    etree.ErrorTypes.ERR_DOCUMENT_EMPTY: ('XML_ERROR_EMPTY_DOCUMENT', 13),
    etree.ErrorTypes.ERR_TAG_NAME_MISMATCH: ('XML_ERROR_MISMATCHED_ELEMENT', 14),
    etree.ErrorTypes.ERR_ATTRIBUTE_NOT_STARTED: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
    etree.ErrorTypes.ERR_ATTRIBUTE_NOT_FINISHED: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
    etree.ErrorTypes.ERR_ATTRIBUTE_WITHOUT_VALUE: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
}


def read_file(path: str | Path) -> str:
    """Return the text of a description file. Raises DescriptionError: it cannot be read."""
    try:
        with open(path, 'rb') as stream:
            return read_stream(stream, str(path))
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
        if isinstance(error, FileNotFoundError):
            reason += hint_at(Path(path))
        raise DescriptionError(
            f'cannot read the description {quote(str(path))}: {reason}'
        ) from None


def read_stream(stream: BinaryIO, source: str) -> str:
    """Return the text of an open binary stream, such as ``sys.stdin.buffer``."""
    return decode(stream.read(MAX_BYTES + 1), source)


def decode(data: bytes, source: str) -> str:
    """
    Return the text of a description, in UTF-8 or the encoding of its XML declaration.

    Raises:
        DescriptionError: it is too large, or not in that encoding.
    """
    if len(data) > MAX_BYTES:
        raise DescriptionError(f'{source}: {_TOO_LARGE}')
    match = _DECLARED_ENCODING.match(data)
    encoding = match[1].decode('ascii', 'replace').lower() if match else 'utf-8'
    if encoding not in _ENCODINGS:
        raise DescriptionError(
            f'{source}:1: unknown encoding {quote(encoding)}; save the file as UTF-8'
        )
    try:
        text = data.decode('utf-8-sig' if encoding in ('utf-8', 'utf8') else encoding)
        return plain_xml(text)
    except UnicodeDecodeError as error:
        line = data.count(b'\n', 0, error.start) + 1
        wrong = f'{source}:{line}: byte {error.start} is not {encoding.upper()}'
        raise DescriptionError(f'{wrong}; save the file as UTF-8') from None


def parse_xml(text: str, source: str, report: Report) -> etree._Element | None:
    """Return the root element, or report why there is none and return None."""
    text = plain_xml(text)
    refusal = _refusal(text)
    if refusal:
        report(Finding.error(source, 1, refusal))
        return None
    # This encoding overrides the declared one, which was that of the bytes, not of this text.
    parser = etree.XMLParser(
        encoding='utf-8', resolve_entities=False, no_network=True, load_dtd=False
    )
    try:
        return etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        report(_syntax_finding(error, source, empty=not text.strip()))
        return None


@dataclass(frozen=True, slots=True)
class ElementReader:
    """
    Reads the attributes of elements; reports a fault and, if ``report`` returns, a neutral value.

    Attributes:
        source: names the file in messages.
        report: called with each fault; it may raise.
        label: names the part that is read, such as ``joint "j1"``.
        urdfdom: the message of urdfdom where it refuses a file for a fault in this part.
    """

    source: str
    report: Report
    label: str = ''
    urdfdom: str = ''

    def of(self, label: str) -> 'ElementReader':
        """Return the reader of a part."""
        return replace(self, label=label)

    def refused_as(self, urdfdom: str) -> 'ElementReader':
        """Return the reader of an element whose faults urdfdom reports as ``urdfdom``."""
        return replace(self, urdfdom=urdfdom)

    def error(self, element: etree._Element, what: str, **details: str) -> None:
        """Report an error at ``element``; ``details`` as in :meth:`Finding.error`."""
        details.setdefault('urdfdom', self.urdfdom)
        self.report(Finding.error(self.source, line_of(element), self._labelled(what), **details))

    def warning(self, element: etree._Element, what: str, **details: str) -> None:
        """Report a warning at ``element``; ``details`` as in :meth:`Finding.warning`."""
        line = line_of(element)
        self.report(Finding.warning(self.source, line, self._labelled(what), **details))

    def _labelled(self, what: str) -> str:
        return f'{self.label}: {what}' if self.label else what

    def required(self, element: etree._Element, attribute: str, **details: str) -> str:
        """Return the text of an attribute that must not be missing or empty; '' after a report."""
        value = element.get(attribute, '').strip()
        if not value:
            self.error(element, f'<{element.tag}> has no attribute "{attribute}"', **details)
        return value

    def number(
        self, element: etree._Element, attribute: str, default: float | None = None
    ) -> float:
        """Return one finite number, or the default if it is missing; NaN after a report."""
        fallback = None if default is None else (default,)
        return self.numbers(element, attribute, 1, fallback)[0]

    def vector(
        self,
        element: etree._Element,
        attribute: str,
        default: Vector | None = None,
    ) -> Vector:
        """Return three numbers; see :meth:`numbers`."""
        x, y, z = self.numbers(element, attribute, 3, default)
        return x, y, z

    def numbers(
        self,
        element: etree._Element,
        attribute: str,
        count: int,
        default: tuple[float, ...] | None = None,
    ) -> tuple[float, ...]:
        """
        Return ``count`` finite numbers; the default if missing, NaNs after a report.

        What :func:`plain_numbers` takes from another text is returned, and reported, too.
        """
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
        values = [parse_number(word) for word in words]
        plain = plain_numbers(text, count)
        if plain != text:
            has_commas = ',' in text
            self.error(
                element,
                f'{attribute} of <{element.tag}>',
                found=quote(text),
                expected=f'{expected} without commas' if has_commas else expected,
                taken=f'it is read as {quote(plain)}',
            )
            words = plain.split()
            values = [parse_number(word) for word in words]
        elif len(words) != count or not all(map(math.isfinite, values)):
            finite = f'{expected}, finite' if any(map(_not_finite, words)) else expected
            self.error(
                element, f'{attribute} of <{element.tag}>', found=quote(text), expected=finite
            )
            return (math.nan,) * count
        return tuple(values)

    def flag(self, element: etree._Element, attribute: str, default: bool) -> bool:
        """Return a truth value, ``true`` or ``false``; the default after a report."""
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


def parse_number(text: str) -> float:
    """Return the number that a text stands for; NaN if it is not a number."""
    return float(text) if _NUMBER.fullmatch(text) else math.nan


def plain_numbers(text: str, count: int) -> str:
    """
    Return ``count`` numbers between blanks, where there are more of them or commas between them.

    Any other text comes back as it is. urdfdom refuses both; other simulators read them.
    """
    words = text.replace(',', ' ').split()
    is_plain = ',' not in text and len(words) <= count
    if count == 1 or is_plain or len(words) < count:
        return text
    values = [parse_number(word) for word in words]
    return ' '.join(words[:count]) if all(map(math.isfinite, values)) else text


def _not_finite(text: str) -> bool:
    return bool(_NOT_FINITE.fullmatch(text)) or math.isinf(parse_number(text))


def _refusal(text: str) -> str:
    """Return why a text is not given to the XML parser, or ''."""
    if len(text) > MAX_BYTES:
        return _TOO_LARGE
    if text.count('\n') >= MAX_LINES:
        return f'more than {MAX_LINES} lines, which no robot description has'
    if _SURROGATE.search(text):
        return 'the text is not valid Unicode: it holds half a surrogate pair'
    if _DOCUMENT_TYPE.match(text):
        return 'a document type declaration is refused, and all entities with it; remove <!DOCTYPE'
    return ''


def _syntax_finding(error: etree.XMLSyntaxError, source: str, *, empty: bool) -> Finding:
    line = error.lineno or 1
    name, number = _TINYXML.get(error.code, ('XML_ERROR_PARSING', 15))
    # libxml2 ends with the line, with which the finding begins, or with advice to programmers.
    reason = re.sub(r', (?:line \d+, column \d+|use XML_PARSE_HUGE).*', '', error.msg or '')
    if empty:
        line, name, number = 1, 'XML_ERROR_EMPTY_DOCUMENT', 13
    return Finding.error(
        source,
        line,
        'the description is empty' if empty else f'not well-formed XML: {reason}',
        expected='a URDF, <robot name="…"> … </robot>' if empty else '',
        urdfdom=f'Error={name} ErrorID={number} ({number:#x}) Line number={line}',
    )
