# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many answers the server keeps for who does not read them."""

import pytest

from amr_description.viewer.http import UnreadAnswers

MB = 2**20


class Connection:
    """Which has bytes to send, and is its own transport."""

    def __init__(self, size):
        self.size, self.is_open = size, True
        self.transport = self

    def get_write_buffer_size(self):
        return self.size

    def abort(self):
        self.size, self.is_open = 0, False


@pytest.mark.parametrize(
    ('size', 'kept'),
    [(1, 64), (MB, 64), (100 * MB, 3), (255 * MB, 2), (256 * MB, 1)],
)
def test_the_oldest_go_when_there_are_too_many(size, kept):
    unread, asked = UnreadAnswers(), [Connection(size) for _ in range(100)]
    for each in asked:
        unread.make_room(each)
    assert [each.is_open for each in asked] == [False] * (100 - kept) + [True] * kept


def test_who_reads_is_never_sent_away():
    unread, asked = UnreadAnswers(), [Connection(0) for _ in range(1000)]
    for each in asked:
        unread.make_room(each)
    assert all(each.is_open for each in asked)
