# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The attributes of XML elements, read with a clear word on every fault."""

from dataclasses import dataclass, replace
import math
import re

from lxml import etree

from amr_description.model.findings import Finding, quote, Report

# What urdfdom reads as a number; Python's float() would also take 1_000, nan and Arabic digits.
_NUMBER = re.compile(r'[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?', re.ASCII)
_NOT_FINITE = re.compile(r'[+-]?(?:nan|inf|infinity)', re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class ElementReader:
    """
    Reads attributes; a fault goes to ``report`` and a neutral value comes back, should ``report``
    return.

    ``label`` names the part being read (``joint "j1"``), ``urdfdom`` holds urdfdom's words where
    it refuses the file for a fault in this part.
    """

    source: str
    report: Report
    label: str = ''
    urdfdom: str = ''

    def of(self, label: str) -> 'ElementReader':
        """Return the reader of a part."""
        return replace(self, label=label)

    def refused_as(self, urdfdom: str) -> 'ElementReader':
        """Return the same reader for an element whose faults urdfdom calls ``urdfdom``."""
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
        """Return the text of an attribute that must not be missing or empty; '' if it is."""
        value = element.get(attribute, '').strip()
        if not value:
            self.error(element, f'<{element.tag}> has no attribute "{attribute}"', **details)
        return value

    def number(
        self, element: etree._Element, attribute: str, default: float | None = None
    ) -> float:
        """Return one finite number, or the default if there is one; NaN on a fault."""
        fallback = None if default is None else (default,)
        return self.numbers(element, attribute, 1, fallback)[0]

    def numbers(
        self,
        element: etree._Element,
        attribute: str,
        count: int,
        default: tuple[float, ...] | None = None,
    ) -> tuple[float, ...]:
        """Return ``count`` finite numbers, or the default if there is one; NaNs on a fault."""
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
        if len(words) != count or not all(map(math.isfinite, values)):
            finite = f'{expected}, finite' if any(map(_not_finite, words)) else expected
            self.error(
                element, f'{attribute} of <{element.tag}>', found=quote(text), expected=finite
            )
            return (math.nan,) * count
        return tuple(values)

    def flag(self, element: etree._Element, attribute: str, default: bool) -> bool:
        """Return a truth value, ``true`` or ``false``; the default on a fault."""
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
    """Return the number that a text writes, NaN when it writes none."""
    return float(text) if _NUMBER.fullmatch(text) else math.nan


def _not_finite(text: str) -> bool:
    return bool(_NOT_FINITE.fullmatch(text)) or math.isinf(parse_number(text))
