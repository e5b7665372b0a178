# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What tests of launch_testing expect of an output: texts, patterns, and several in a row."""

import re

import pytest

from amr_description.launch_testing.asserts import SequentialTextChecker
from amr_description.launch_testing.text import (
    basic_output_filter,
    expect_output,
    expected_output_from_file,
    without_colours,
)

TEXT = 'starting\r\nloop 1\nloop 2\nended\n'


@pytest.mark.parametrize(
    ('expected', 'found'),
    [
        ('loop 1\nloop', True),
        ('loop 3', False),
        (re.compile(r'loop \d'), True),
        (re.compile(r'loop \d\d'), False),
        (['starting', 'loop 2', re.compile('e..ed')], True),
        (['loop 2', 'loop 1'], False),
        (['loop', 'loop', 'loop'], False),
    ],
)
def test_texts_stand_somewhere_one_after_the_other(expected, found):
    assert expect_output(TEXT, expected_text=expected) is found


@pytest.mark.parametrize(
    ('expected', 'strict', 'found'),
    [
        (['starting', 'loop'], False, True),
        (['loop 1', 'loop 2'], True, False),
        (['starting', re.compile('loop'), re.compile('loop'), 'ended'], True, True),
        (['starting', 'loop', 'loop', 'ended'], True, False),
        (['starting\nloop'], False, False),
        (re.compile('oop'), False, False),
    ],
)
def test_lines_are_whole_when_strict_and_patterns_match_from_their_beginning(
    expected, strict, found
):
    assert expect_output(TEXT, expected_lines=expected, strict=strict) is found


def test_a_strict_text_is_all_of_it():
    assert expect_output(lines=['a', 'b'], expected_text='a\nb', strict=True)
    assert not expect_output(lines=['a', 'b'], expected_text='a', strict=True)


@pytest.mark.parametrize(
    'given',
    [
        {'expected_text': 'a'},
        {'text': 'a', 'lines': ['a'], 'expected_text': 'a'},
        {'text': 'a'},
        {'text': 'a', 'expected_text': 'a', 'expected_lines': ['a']},
    ],
)
def test_one_output_and_one_expectation_have_to_be_given(given):
    with pytest.raises(ValueError, match='has to be given'):
        expect_output(**given)


def test_colours_do_not_count():
    assert without_colours('\x1b[0m[\x1b[1;31mERROR\x1b[0m] a[0]') == '[ERROR] a[0]'
    assert expect_output('a\x1b[31mb', expected_text='ab')
    assert not expect_output('a\x1b[31mb', expected_text='ab', strip_ansi_escape_sequences=False)


def test_lines_are_filtered_by_their_beginning():
    keep = basic_output_filter(filtered_patterns=[r'\d+'])
    assert keep('pid 1\n12 a\nrc 0\nkept 12\nb') == 'kept 12\nb'
    assert basic_output_filter([])('pid 1\n') == 'pid 1\n'


def test_lines_and_patterns_are_read_from_files(tmp_path):
    (tmp_path / 'a.txt').write_text('one\ntwo\n')
    (tmp_path / 'b.regex').write_text('o.e\n')
    assert expected_output_from_file(str(tmp_path / 'a')) == ['one', 'two']
    assert expected_output_from_file(str(tmp_path / 'b')) == [re.compile('o.e')]
    with pytest.raises(RuntimeError, match=r'c\.txt nor .*c\.regex'):
        expected_output_from_file(str(tmp_path / 'c'))


def test_a_sequence_goes_on_behind_what_was_found():
    checker = SequentialTextChecker(['a\nb', 'b\n', 'c\nd\ne\nf\ng\n'])
    checker.assertInStdout('b')
    checker.assertInText('b')
    checker.assertInStdout('d')
    with pytest.raises(AssertionError, match=r"'a' not found in sequence.*\nbb\nc\nd\ne\nf$"):
        checker.assertInStdout('a')
    checker.assertInStdout('g')
