# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Expected texts: found in what a process has written, in their order."""

from collections.abc import Callable, Iterable, Sequence
import os
import re
from typing import TypeAlias

Expected: TypeAlias = str | re.Pattern[str] | Iterable[str | re.Pattern[str]]
"""A text, a pattern, or several that come one after the other."""
Filter: TypeAlias = Callable[[str], str]

_ANSI = re.compile(r'\x1b(?:\[[0-?]*[ -/]*[@-~]|[@-Z\\^_])')


def without_colours(text: str) -> str:
    """Return a text without escape sequences of terminals."""
    return _ANSI.sub('', text)


def is_in_text(expected: Expected, text: str, *, strict: bool = False) -> bool:
    """
    Return whether a text has what is expected.

    Args:
        expected: One or several.
        text: With line ends of any system.
        strict: Whether nothing else may stand before, between and behind texts.
    """
    text = text.replace('\r\n', '\n')
    at = 0
    for each in _several(expected):
        if isinstance(each, str):
            begin, length = text.find(each, at), len(each)
        else:
            found = each.search(text, at)
            begin, length = (found.start(), found.end() - found.start()) if found else (-1, 0)
        if begin < 0 or (strict and begin != at):
            return False
        at = begin + length
    return not strict or not isinstance(expected, str) or at == len(text)


def is_in_lines(expected: Expected, lines: Sequence[str], *, strict: bool = False) -> bool:
    """As :func:`is_in_text`, each in a line of its own; strict: in the line right behind."""
    at = 0
    for each in _several(expected):
        matches = each.match if isinstance(each, re.Pattern) else each.__eq__ if strict else None
        numbers = range(at, len(lines))
        if matches is None:
            found = next((n for n in numbers if each in lines[n]), None)  # type: ignore[operator]
        else:
            found = next((n for n in numbers if matches(lines[n])), None)
        if found is None or (strict and found != at):
            return False
        at = found + 1
    return not strict or at == len(lines)


def _several(expected: Expected) -> list[str | re.Pattern[str]]:
    return [expected] if isinstance(expected, str | re.Pattern) else list(expected)


def expected_output_from_file(path: str, encoding: str | None = None) -> Sequence[Expected]:
    """Return the lines of ``path.txt``, or the patterns of ``path.regex``. Raises OSError."""
    if os.path.isfile(f'{path}.txt'):
        with open(f'{path}.txt', encoding=encoding) as file:
            return file.read().splitlines()
    try:
        with open(f'{path}.regex', encoding=encoding) as file:
            return [re.compile(line) for line in file.read().splitlines()]
    except FileNotFoundError:
        raise RuntimeError(f'there is neither {path}.txt nor {path}.regex') from None


def expect_output(
    text: str | None = None,
    *,
    lines: Sequence[str] | None = None,
    expected_text: Expected | None = None,
    expected_lines: Expected | None = None,
    strip_ansi_escape_sequences: bool = True,
    strict: bool = False,
) -> bool:
    """
    Return whether an output is as expected.

    Args:
        text: The output; or
        lines: its lines.
        expected_text: What stands somewhere in it; or
        expected_lines: in lines of their own.
        strip_ansi_escape_sequences: Whether colours do not count.
        strict: Whether there may be nothing else.

    Raises:
        ValueError: not one of the first two, or not one of the second two was given.
    """
    if (text is None) == (lines is None):
        raise ValueError('either text or lines has to be given')
    if (expected_text is None) == (expected_lines is None):
        raise ValueError('either expected_text or expected_lines has to be given')
    whole = text if text is not None else '\n'.join(lines or ())
    if strip_ansi_escape_sequences:
        whole = without_colours(whole)
    if expected_text is not None:
        return is_in_text(expected_text, whole, strict=strict)
    return is_in_lines(expected_lines or (), whole.splitlines(), strict=strict)


def basic_output_filter(
    filtered_prefixes: Sequence[str] | None = None,
    filtered_patterns: Sequence[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Filter:
    """
    Return a function that leaves lines out of an output.

    Args:
        filtered_prefixes: What such lines begin with; None: 'pid' and 'rc'.
        filtered_patterns: Regular expressions that match them, from their beginning.
        filtered_rmw_implementation: As in launch_testing_ros; those of PyPI write nothing.
    """
    prefixes = ('pid', 'rc') if filtered_prefixes is None else tuple(filtered_prefixes)
    patterns = [re.compile(each) for each in filtered_patterns or ()]

    def keep(output: str) -> str:
        return ''.join(
            line
            for line in output.splitlines(keepends=True)
            if not line.startswith(prefixes) and not any(each.match(line) for each in patterns)
        )

    return keep
