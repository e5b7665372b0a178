# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The XML that urdfdom's parser takes and others do not, made such that all take it."""

import re

_DECLARATION = re.compile(r'\A\s*+<\?xml\s[^<>]*\?>')
_PREFIX_OF_TAG = re.compile(r'</?([A-Za-z_][\w.-]*+):')
_PREFIX_OF_ATTRIBUTE = re.compile(r'\s([A-Za-z_][\w.-]*+):[\w.-]++\s*+=')
# Found 30 times faster than the prefix itself; most descriptions have none.
_END_OF_PREFIXED_ATTRIBUTE = re.compile(r':[\w.-]++\s*+=')
_DECLARED_PREFIX = re.compile(r'\sxmlns:([\w.-]+)\s*=')
# XML's own, and that of xacro, which does not expand a file that does not declare it.
_KNOWN_PREFIXES = {'xml', 'xmlns', 'xacro'}
_ROBOT = re.compile(r'<robot\b')
_KNOWN_DECLARATION = re.compile(r'\A<\?xml\s+version\s*=\s*["\']1\.[01]["\']')


def plain_xml(text: str) -> str:
    """
    Return a description as every XML parser takes it; one that they take comes back as it is.

    That of urdfdom reads neither the version of the XML declaration nor what stands behind a
    character NUL, lets blanks stand before a declaration, and knows no namespaces. Such a
    declaration is left out, and so is what is blank behind a NUL; prefixes of other programs, such
    as ``drake:``, are declared. All lines keep their numbers.
    """
    before, nul, behind = text.partition('\0')
    if nul and not behind.strip('\0 \t\r\n'):
        text = before
    declaration = _DECLARATION.match(text)
    if declaration is not None and not _KNOWN_DECLARATION.match(text):
        text = '\n' * declaration[0].count('\n') + text[declaration.end() :]
    used = set(_PREFIX_OF_TAG.findall(text))
    if _END_OF_PREFIXED_ATTRIBUTE.search(text):
        used.update(_PREFIX_OF_ATTRIBUTE.findall(text))
    used -= _KNOWN_PREFIXES
    if not used:
        return text
    undeclared = sorted(used.difference(_DECLARED_PREFIX.findall(text)))
    if not undeclared:
        return text
    declarations = ''.join(f' xmlns:{name}="{name}"' for name in undeclared)
    return _ROBOT.sub(lambda match: match[0] + declarations, text, count=1)
