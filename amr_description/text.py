# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Text of messages and of arguments: on one line, printable, quoted, shortened; truth values; the
known words closest to a misspelt one.
"""

from collections.abc import Collection, Iterable, Sequence
from difflib import get_close_matches
import re

_LONGEST_WORD = 60
_MOST_WORDS = 300
_SHOWN_CHARACTERS = 80
_LONGEST_LINE = 200
_TAIL = 60
_NOT_PLAIN = re.compile(r'[^A-Za-z0-9_.-]')
_TRUTH_VALUES = {'true': True, '1': True, 'false': False, '0': False}


def one_line(text: str) -> str:
    """Return ``text`` with control characters escaped: no file may paint on the terminal."""
    return ''.join(c if c.isprintable() else c.encode('unicode_escape').decode() for c in text)


def unwrap(text: str) -> str:
    """Return the lines of ``text`` as one, with single spaces between its words."""
    return ' '.join(text.split())


def encodable(text: str) -> str:
    r"""Return ``text`` as UTF-8 can encode it: bytes that were none are written as ``\udc80``."""
    return text.encode('utf-8', 'backslashreplace').decode()


def shorten(text: str) -> str:
    """Return ``text`` as one printable line, without its middle if it is over 200 characters."""
    line = one_line(text)
    if len(line) <= _LONGEST_LINE:
        return line
    return f'{line[: _LONGEST_LINE - _TAIL]} ... {line[-_TAIL:]}'


def quote(text: str) -> str:
    """Return a name or value of a file in double quotes, cut after 80 characters."""
    if len(text) > _SHOWN_CHARACTERS:
        text = f'{text[:_SHOWN_CHARACTERS]}…'
    return f'"{text}"'


def quote_all(texts: Sequence[str], limit: int = 10) -> str:
    """Return names in quotes, the first ``limit`` of them; ``none`` for an empty list."""
    if not texts:
        return 'none'
    more = f' and {len(texts) - limit} more' if len(texts) > limit else ''
    return ', '.join(quote(text) for text in texts[:limit]) + more


def plain_name(text: str) -> str:
    """Return a name with ``_`` for what is no letter of ASCII, digit, ``_``, ``.`` or ``-``."""
    return _NOT_PLAIN.sub('_', text)


def truth(text: str) -> bool | None:
    """Read ``true``, ``1``, ``false`` or ``0`` in any case, as launch does; None: another word."""
    return _TRUTH_VALUES.get(text.lower())


def closest_match(word: str, known: Collection[str], similarity: float = 0.6) -> str:
    """
    Return the word of ``known`` most similar to ``word``, case ignored; '' if there is none.

    Words over 60 characters, and more than 300 known ones, are not compared: it would take long,
    and no file made by hand has them.

    Args:
        word: as it was written.
        known: what would have been right.
        similarity: the least ratio of :mod:`difflib`, 0 to 1.
    """
    if len(word) > _LONGEST_WORD or len(known) > _MOST_WORDS:
        return ''
    spelt = {each.lower(): each for each in known if len(each) <= _LONGEST_WORD}
    if word.lower() in spelt:
        return spelt[word.lower()]  # what difflib finds too, a hundred times slower
    matches = get_close_matches(word.lower(), spelt, 1, similarity)
    return spelt[matches[0]] if matches else ''


def suggestion(word: str, known: Sequence[str]) -> str:
    """Return the end of a message about an unknown word: the closest one, and all there are."""
    match = closest_match(word, known)
    guess = f"; did you mean '{match}'?" if match else ';'
    return f'{guess} known: {", ".join(known) or "none"}'


def did_you_mean(word: str, known: Iterable[str], prefix: str = '') -> str:
    """
    Return ``; did you mean A or B?`` with up to three similar words; '' if there are none.

    Args:
        word: as it was written.
        known: what would have been right; there may be thousands, so they are not listed.
        prefix: what each of them is shown with in front.
    """
    close = [prefix + match for match in get_close_matches(word, list(dict.fromkeys(known)), 3)]
    return f'; did you mean {" or ".join(close)}?' if close else ''
