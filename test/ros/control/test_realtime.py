# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The time slices of threads, as Linux has them."""

import ctypes
import os
import platform
import struct
import threading

import pytest

from amr_description.control.ros.realtime import (
    set_cpu_affinity,
    set_time_slice,
    SHORT_SLICE,
    USUAL_SLICE,
)
from amr_description.log import Severity

GETATTR = {'x86_64': 315, 'aarch64': 275}


def time_slice():
    """Of the calling thread, ns; Linux before 6.12 says 0."""
    data = ctypes.create_string_buffer(48)
    assert ctypes.CDLL(None).syscall(GETATTR[platform.machine()], 0, data, len(data), 0) == 0
    return struct.unpack('=IIQiIQQQ', data)[5]


def in_thread(work):
    results = []
    thread = threading.Thread(target=lambda: results.append(work()))
    thread.start()
    thread.join()
    return results[0]


@pytest.fixture
def usual():
    found = in_thread(time_slice) if platform.machine() in GETATTR else 0
    if not found or os.sched_getscheduler(0) != os.SCHED_OTHER:
        pytest.skip('this Linux knows no time slices of threads, or this is no usual thread')
    return found


def test_a_thread_has_a_short_slice_and_others_keep_theirs(usual):
    def short():
        return set_time_slice(SHORT_SLICE), time_slice()

    assert in_thread(short) == (True, SHORT_SLICE)
    assert usual > SHORT_SLICE
    assert in_thread(time_slice) == usual


def test_a_thread_that_one_of_short_slices_starts_goes_back_to_usual_ones(usual):
    def started():
        return time_slice(), set_time_slice(USUAL_SLICE), time_slice()

    def start():
        set_time_slice(SHORT_SLICE)
        return in_thread(started)

    assert in_thread(start) == (SHORT_SLICE, True, usual)


def test_the_niceness_of_the_thread_stays(usual):
    higher = min(os.getpriority(os.PRIO_PROCESS, 0) + 1, 19)

    def nice():
        os.setpriority(os.PRIO_PROCESS, 0, higher)
        set_time_slice(SHORT_SLICE)
        return os.getpriority(os.PRIO_PROCESS, 0)

    assert in_thread(nice) == higher


def test_a_thread_of_another_policy_keeps_it():
    def batch():
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
        return set_time_slice(SHORT_SLICE), os.sched_getscheduler(0)

    assert in_thread(batch) == (False, os.SCHED_BATCH)


@pytest.mark.parametrize('core', [-1, 4096, 2**70])
def test_cores_that_are_not_there_are_named_and_all_may_be_used(core):
    before, said = os.sched_getaffinity(0), []
    set_cpu_affinity([core], lambda *line: said.append(line))
    ((severity, text),) = said
    assert severity == Severity.WARN
    assert text.startswith(f'Could not set the CPU affinity [{core}]: ')
    assert os.sched_getaffinity(0) == before
