# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The known word that is meant by a misspelt one."""

from collections.abc import Collection
from difflib import get_close_matches

_LONGEST = 60
_MOST = 300


def nearest(word: str, known: Collection[str], similarity: float = 0.6) -> str:
    """
    Return the most similar word of ``known``; '' when none has that similarity (0..1).

    Long words, and more than 300 known ones, are not compared: a file made by hand has
    neither.
    """
    if len(word) > _LONGEST or len(known) > _MOST:
        return ''
    spelt = {each.lower(): each for each in known if len(each) <= _LONGEST}
    matches = get_close_matches(word.lower(), spelt, 1, similarity)
    return spelt[matches[0]] if matches else ''
