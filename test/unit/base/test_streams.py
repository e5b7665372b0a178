# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A stderr whose reader takes nothing."""

import os
import pty
import threading

import pytest

from amr_description import streams

STDERR = 2


@pytest.fixture
def stderr():
    """Replace stderr by a descriptor, until the end of the test."""
    ours = os.dup(STDERR)
    yield lambda descriptor: os.dup2(descriptor, STDERR)
    os.dup2(ours, STDERR)
    os.close(ours)


def fill():
    """Write to stderr until it takes no more; return how much it took."""
    taken = 0
    with pytest.raises(BlockingIOError):
        while True:
            taken += os.write(STDERR, b'x' * 1024)
    return taken


@pytest.mark.parametrize('pair', [os.pipe, pty.openpty])
def test_it_fails_instead_of_waiting(stderr, pair):
    reader, writer = pair()
    stderr(writer)
    streams.never_wait_for_stderr()
    assert fill() >= 1024
    streams.print_traceback()  # raises nothing
    assert os.get_blocking(writer)  # which other processes may have, too
    os.close(reader)
    os.close(writer)


def test_a_line_waits_until_it_is_taken(stderr):
    reader, writer = os.pipe()
    stderr(writer)
    streams.never_wait_for_stderr()
    fill()
    waiting = threading.Thread(target=streams.wait_for_stderr)
    waiting.start()
    while waiting.is_alive():
        os.read(reader, 4096)
        waiting.join(0.01)
    assert os.write(STDERR, b'line\n') == 5
    os.close(reader)
    os.close(writer)


def test_a_file_is_left_alone(stderr, tmp_path):
    with (tmp_path / 'log').open('wb') as file:
        file.write(b'before')
        file.flush()
        stderr(file.fileno())
        streams.never_wait_for_stderr()
        os.write(STDERR, b' and after')
    streams.wait_for_stderr()
    assert (tmp_path / 'log').read_bytes() == b'before and after'


def test_a_closed_one_is_left_alone(stderr):
    os.close(STDERR)
    streams.never_wait_for_stderr()
    streams.wait_for_stderr()
