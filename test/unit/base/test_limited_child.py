# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A program that works on a file of others ends by its limits."""

import sys

import pytest

from amr_description.errors import LimitError
from amr_description.limited_child import Ended, Limits, run_limited


def run(code, **limits):
    return run_limited([sys.executable, '-c', code], Limits(**{'seconds': 5, **limits}))


def test_what_it_says_is_returned():
    code = 'import sys; print("text"); print("why", file=sys.stderr); sys.exit(3)'
    assert run(code) == Ended(3, 'text\n', 'why\n')


def test_one_that_computes_for_ever_is_ended():
    with pytest.raises(LimitError, match='^no end after 1 s$'):
        run('while True: pass', seconds=1)


def test_one_that_waits_for_ever_is_ended():
    with pytest.raises(LimitError, match=r'^no end after 0\.5 s$'):
        run('import time; time.sleep(1000)', wall=0.5)


def test_one_that_wants_too_much_memory_is_told():
    ended = run('bytearray(2**30)', memory=2**29)
    assert ended.code == 1
    assert 'MemoryError' in ended.log
