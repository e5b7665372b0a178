# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Text of messages: printable, on one line, quoted, shortened, with suggestions."""

import pytest

from amr_description.text import (
    closest_match,
    did_you_mean,
    encodable,
    one_line,
    quote,
    quote_all,
    shorten,
    suggestion,
    truth,
    unwrap,
)


def test_control_characters_are_escaped():
    assert one_line('a\n\x1b[31mä') == 'a\\n\\x1b[31mä'


def test_lines_are_joined_by_single_spaces():
    assert unwrap(' one\n\t two ') == 'one two'


def test_bytes_that_were_no_utf_8_are_written_out():
    assert encodable('a\udc80ä') == 'a\\udc80ä'


def test_long_texts_lose_their_middle_and_long_names_their_end():
    assert shorten('a' * 200) == 'a' * 200
    assert shorten('a' * 150 + 'b' * 150) == f'{"a" * 140} ... {"b" * 60}'
    assert quote('a' * 81) == f'"{"a" * 80}…"'
    assert quote_all(['a', 'b', 'c'], 2) == '"a", "b" and 1 more'
    assert quote_all([]) == 'none'


@pytest.mark.parametrize(
    ('text', 'value'),
    [('true', True), ('True', True), ('1', True), ('FALSE', False), ('0', False), ('yes', None)],
)
def test_truth_is_read_as_by_launch(text, value):
    assert truth(text) is value


def test_similar_words_are_suggested():
    assert closest_match('Base_lnik', ['odom', 'base_link']) == 'base_link'
    assert closest_match('ODOM', ['odoms', 'Odom'], similarity=1.0) == 'Odom'
    assert closest_match('x', ['odom']) == ''
    assert closest_match('a' * 61, ['a' * 60]) == ''
    assert suggestion('odm', ['odom']) == "; did you mean 'odom'? known: odom"
    assert suggestion('x', []) == '; known: none'
    assert did_you_mean('odm', ['odom', 'map'], '/') == '; did you mean /odom?'
    assert did_you_mean('odm', ['odom', 'odom']) == '; did you mean odom?'  # of two prefixes
    assert did_you_mean('x', ['odom']) == ''
