# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Text of messages: one printable line, quoted, shortened; the known word closest to a given one."""

from collections.abc import Collection, Sequence
from difflib import get_close_matches

_LONGEST_WORD = 60
_MOST_WORDS = 300
_SHOWN_CHARACTERS = 80
_LONGEST_LINE = 200
_TAIL = 60


def one_line(text: str) -> str:
    """Return ``text`` with control characters escaped: no file may paint on the terminal."""
    return ''.join(c if c.isprintable() else c.encode('unicode_escape').decode() for c in text)


def shorten(text: str) -> str:
    """Return ``text`` as one printable line, without its middle if it is over 200 characters."""
    line = ''.join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
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
    matches = get_close_matches(word.lower(), spelt, 1, similarity)
    return spelt[matches[0]] if matches else ''


def suggestion(word: str, known: Sequence[str]) -> str:
    """Return the end of a message about an unknown word: the closest one, and all there are."""
    match = closest_match(word, known)
    guess = f"; did you mean '{match}'?" if match else ';'
    return f'{guess} known: {", ".join(known) or "none"}'
