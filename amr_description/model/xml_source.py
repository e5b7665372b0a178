# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
XML from strangers, loaded safely and with true line numbers.

Refused, in bounded time and memory: files over :data:`MAX_BYTES` or :data:`MAX_LINES`, nesting
beyond libxml2's 256 levels, and every document type declaration, so that there are no entities to
expand and nothing to fetch.
"""

from pathlib import Path
import re
from typing import BinaryIO

from lxml import etree

from amr_description.errors import DescriptionError
from amr_description.model.findings import Finding, quote, Report

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
# Atomic groups and possessive repeats (*+): linear time also on a file made to make it backtrack.
_DOCUMENT_TYPE = re.compile(
    r'\A(?>\s+|<\?.*?\?>|<!--.*?-->)*+<!DOCTYPE', re.DOTALL | re.IGNORECASE
)
_SURROGATE = re.compile('[\ud800-\udfff]')
# The numbers by which tinyxml2, urdfdom's parser, calls the faults that libxml2 names on the left.
_TINYXML = {
    etree.ErrorTypes.ERR_DOCUMENT_EMPTY: ('XML_ERROR_EMPTY_DOCUMENT', 13),
    etree.ErrorTypes.ERR_TAG_NAME_MISMATCH: ('XML_ERROR_MISMATCHED_ELEMENT', 14),
    etree.ErrorTypes.ERR_ATTRIBUTE_NOT_STARTED: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
    etree.ErrorTypes.ERR_ATTRIBUTE_NOT_FINISHED: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
    etree.ErrorTypes.ERR_ATTRIBUTE_WITHOUT_VALUE: ('XML_ERROR_PARSING_ATTRIBUTE', 7),
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
            f'{source}:1: unknown encoding {quote(encoding)}; save the file as UTF-8'
        )
    try:
        return data.decode('utf-8-sig' if encoding in ('utf-8', 'utf8') else encoding)
    except UnicodeDecodeError as error:
        line = data.count(b'\n', 0, error.start) + 1
        place, wrong = f'{source}:{line}', f'byte {error.start} is not {encoding.upper()}'
        raise DescriptionError(f'{place}: {wrong}; save the file as UTF-8') from None


def parse_xml(text: str, source: str, report: Report) -> etree._Element | None:
    """Return the root element, or report why there is none and return None."""
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


def _refusal(text: str) -> str:
    """Return why a text does not even get to the XML parser, or ''."""
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
    # libxml2 ends with the place, with which the finding begins, or with advice to programmers.
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
