# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The mailbox between other threads and the owner."""

import threading

import pytest

from amr_description.control.contracts import Input, Port

PORT = Port('~/heard', 'std_msgs/msg/Empty', 'nowhere:nothing')


@pytest.fixture
def mailbox():
    mailbox = Input(PORT)
    mailbox.open()
    return mailbox


def test_closed_it_takes_nothing():
    mailbox = Input(PORT)
    assert not mailbox.put(1)
    mailbox.open()
    assert mailbox.drain() == []


def test_samples_come_once_and_oldest_first(mailbox):
    assert all(mailbox.put(sample) for sample in (1, 2, 3))
    assert mailbox.drain() == [1, 2, 3]
    assert mailbox.drain() == []


def test_of_too_many_the_oldest_go():
    mailbox = Input(PORT, capacity=3)
    mailbox.open()
    for sample in range(10):
        mailbox.put(sample)
    assert mailbox.drain() == [7, 8, 9]


def test_what_waits_at_a_close_is_not_heard_after_the_next_open(mailbox):
    mailbox.put(1)
    mailbox.close()
    assert not mailbox.put(2)
    mailbox.open()
    assert mailbox.drain() == []


def test_nothing_is_lost_or_doubled_between_threads():
    mailbox = Input(PORT, capacity=100_000)
    mailbox.open()
    writer = threading.Thread(target=lambda: [mailbox.put(k) for k in range(50_000)])
    writer.start()
    heard = []
    while writer.is_alive():
        heard += mailbox.drain()
    writer.join()
    assert heard + mailbox.drain() == list(range(50_000))
