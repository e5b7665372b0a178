# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the machine is quiet, and what processes take."""

import os

import pytest

from benchmarks.machine import complaints, Usage, usage, usage_of
from benchmarks.processes import descendants, name_of, processes_below, processor_time, resident

STAT = 'cpu  100 1 50 800 40 0 4 5 0 0\ncpu0 1 2 3 4 5 6 7 8 0 0\n'
QUIET = Usage(total=1000, idle=950, steal=0)


def test_usage():
    read = usage_of(STAT)
    assert read == Usage(total=1000, idle=840, steal=5)
    assert read.busy_share == pytest.approx(0.16)
    assert usage_of(STAT.replace('100', '300')).since(read) == Usage(200, 0, 0)
    assert usage().total > 0


def test_nothing_to_say_of_a_quiet_machine():
    assert complaints(QUIET, QUIET, (200.0, 190.0)) == []
    assert complaints(QUIET, Usage(1000, 100, 0), None) == []  # busy with the benchmark itself


@pytest.mark.parametrize(
    'before, during, bare, word',
    [
        (Usage(1000, 600, 0), QUIET, None, '40% of the processors'),
        (QUIET, Usage(1000, 100, 50), None, '5% of the processor time'),
        (QUIET, QUIET, (200.0, 150.0), 'at 200, and at 150'),
    ],
)
def test_what_makes_figures_worse_is_said(before, during, bare, word):
    (line,) = complaints(before, during, bare)
    assert word in line


def test_processes_below_one():
    parents = {1: 0, 2: 1, 3: 2, 4: 1, 5: 3, 9: 8}
    assert descendants(2, parents) == {2, 3, 5}
    assert os.getpid() in processes_below(os.getppid())


def test_this_process():
    assert processor_time(os.getpid()) > 0.0
    assert resident(os.getpid()) > 1e6
    assert str(os.getpid()) in name_of(os.getpid())
