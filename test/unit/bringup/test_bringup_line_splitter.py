# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes into lines, however they are chunked."""

import pytest

from amr_description.bringup.process import LineSplitter

TEXT = 'one\n\ntwo ä€🤖\r\nunfinished'


@pytest.mark.parametrize('size', range(1, 12))
def test_lines_do_not_depend_on_how_the_bytes_come(size):
    data = TEXT.encode()
    splitter = LineSplitter()
    lines = [line for i in range(0, len(data), size) for line in splitter.feed(data[i : i + size])]
    assert lines == ['one', '', 'two ä€🤖']
    assert splitter.flush() == ['unfinished']
    assert splitter.flush() == []


@pytest.mark.parametrize('size', [1, 3, 10, 1000])
def test_a_long_line_is_cut_between_characters(size):
    text = 'aä€🤖' * 20
    data = text.encode()
    splitter = LineSplitter(longest=16)
    lines = []
    for i in range(0, len(data), size):
        lines += splitter.feed(data[i : i + size])
    lines += splitter.feed(b'\nnext\n')
    assert lines.pop() == 'next'
    assert ''.join(lines) == text
    assert all(len(line.encode()) <= 16 for line in lines)


def test_invalid_utf_8_is_shown():
    assert LineSplitter().feed(b'\xff\xfe ok\n') == ['\ufffd\ufffd ok']
    assert len(LineSplitter(longest=8).feed(b'\x80' * 33)) == 4
