# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages that wait for a transform: in their order, and none for ever."""

import pytest

from amr_description.model.frames import Transform
from amr_description.navigation.ros.transform_queue import transform_at, TransformQueue
from amr_description.tf2_ros.buffer import Buffer, transform_message
from amr_description.tf2_ros.buffer_core import BufferCore
from amr_description.tf2_ros.time_cache import StampedTransform

DEPTH = 3


class Bench:
    """A queue, what it has handled, and how often transforms were looked up for it."""

    def __init__(self):
        self.buffer = Buffer()
        self.handled = []
        self.queue = TransformQueue(self.buffer, self._handle, DEPTH)

    def _handle(self, item, transform):
        self.handled.append((item, transform.transform.translation.x))

    def add(self, *stamps):
        for stamp in stamps:
            self.queue.add(stamp, 'odom', 'base', stamp)

    def know(self, *stamps):
        for stamp in stamps:
            place = Transform((float(stamp), 0.0, 0.0))
            message = transform_message(StampedTransform('odom', 'base', stamp, place))
            self.buffer.set_transform(message, 'me')


@pytest.fixture
def bench():
    return Bench()


def test_items_get_the_transform_of_their_stamp_in_their_order(bench):
    bench.know(10)
    bench.add(10, 14, 18)
    assert bench.handled == [(10, 10.0)]
    bench.know(20)
    assert bench.handled == [(10, 10.0), (14, 14.0), (18, 18.0)]


def test_the_oldest_is_dropped_where_too_many_wait(bench):
    bench.add(12, 13, 14, 15)
    bench.know(10, 20)
    assert bench.handled == [(13, 13.0), (14, 14.0), (15, 15.0)]


def test_what_waits_is_dropped_as_time_goes_back(bench):
    bench.add(12, 13)
    bench.queue.clear()
    bench.know(10, 20)
    assert bench.handled == []


def test_an_item_of_before_the_first_transform_waits_no_longer_than_that(bench, monkeypatch):
    bench.add(5, 7, 10)
    bench.know(10)
    assert bench.handled == [(10, 10.0)]
    asked = []
    lookup = BufferCore.lookup_transform

    def note(core, target, source, time=0):
        asked.append(time)
        return lookup(core, target, source, time)

    monkeypatch.setattr(BufferCore, 'lookup_transform', note)
    bench.know(11, 12, 13)
    assert asked == []
    bench.know(4)  # an old transform makes it known, but it would be out of order
    assert bench.handled == [(10, 10.0)]


def test_the_latest_is_in_place_of_one_that_is_not_known(bench):
    """Stamps of others may be of before all time."""
    found = [transform_at(bench.buffer, 'odom', 'base', 15, 0)]
    bench.know(10, 20)
    for time in (15, 30, 0, -1):
        found.append(transform_at(bench.buffer, 'odom', 'base', time, 0))
    assert [each and each.translation[0] for each in found] == [None, 15.0, 20.0, 20.0, 20.0]
