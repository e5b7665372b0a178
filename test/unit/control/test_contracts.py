# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The queue of an input port, between other threads and the control thread."""

import threading

import pytest

from amr_description.control.contracts import Input, Port

PORT = Port('~/input', 'std_msgs/msg/Empty', 'nowhere:nothing')


@pytest.fixture
def queue():
    queue = Input(PORT)
    queue.open()
    return queue


def test_a_closed_input_takes_nothing():
    queue = Input(PORT)
    assert not queue.put(1)
    queue.open()
    assert queue.drain() == []


def test_samples_come_once_and_oldest_first(queue):
    assert all(queue.put(sample) for sample in (1, 2, 3))
    assert queue.drain() == [1, 2, 3]
    assert queue.drain() == []


def test_the_oldest_of_too_many_are_dropped():
    queue = Input(PORT, capacity=3)
    queue.open()
    for sample in range(10):
        queue.put(sample)
    assert queue.drain() == [7, 8, 9]


def test_samples_that_wait_at_a_close_are_dropped(queue):
    queue.put(1)
    queue.close()
    assert not queue.put(2)
    queue.open()
    assert queue.drain() == []


def test_nothing_is_lost_or_doubled_between_threads():
    queue = Input(PORT, capacity=100_000)
    queue.open()
    writer = threading.Thread(target=lambda: [queue.put(k) for k in range(50_000)])
    writer.start()
    received = []
    while writer.is_alive():
        received += queue.drain()
    writer.join()
    assert received + queue.drain() == list(range(50_000))
