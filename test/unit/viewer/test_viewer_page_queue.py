# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What waits for a slow page: the newest of each channel, and a bounded queue of values."""

import pytest

from amr_description.viewer import pages
from amr_description.viewer.backend import Watched
from amr_description.viewer.pages import Page, Pages
from amr_description.viewer.protocol import TimeReset
from amr_description.viewer.samples import Sample

SHOWN = Watched(
    sensors=frozenset(['/a']), messages=frozenset(['/a']), fields={'/a': frozenset(['x', 'y'])}
)


class Transport:
    """Instead of a connection: what is sent, and whether the system takes it."""

    def __init__(self):
        self.transport = self
        self.sent = []
        self.is_slow = False

    def get_write_buffer_size(self):
        return int(self.is_slow)


@pytest.fixture
def page(monkeypatch):
    monkeypatch.setattr(
        pages, 'broadcast', lambda connections, frame: connections[0].sent.append(frame)
    )
    return Page('page 1', Transport())


@pytest.fixture
def of_all(page):
    of_all = Pages()
    of_all.add(page, TimeReset(0.0))
    page.connection.sent.clear()
    of_all.show(page, SHOWN)
    return of_all


def values(*frames, topic='/a'):
    return [Sample(topic, frame, 'values') for frame in frames]


def test_of_values_all_are_sent_when_the_page_can_take_them_and_the_newest_of_the_rest(
    page, of_all
):
    page.connection.is_slow = True
    of_all.send_samples([Sample('/a', b'old scan'), Sample('/a', b'old', 'message')])
    assert of_all.wanted == frozenset()
    of_all.send_samples([*values(b'1', b'2'), Sample('/a', b'scan')])
    of_all.send_samples(
        [Sample('/a', b'new', 'message'), *values(b'3'), *values(b'0', topic='/b')]
    )
    assert page.connection.sent == []
    page.connection.is_slow = False
    of_all.send_samples([])
    assert page.connection.sent == [b'1', b'2', b'3', b'scan', b'new']
    assert of_all.wanted == {('sensor', '/a'), ('message', '/a')}


def test_the_oldest_values_give_way(page, of_all):
    page.connection.is_slow = True
    large = [bytes([number]) * 300_000 for number in range(9)]
    of_all.send_samples(values(*large))
    page.connection.is_slow = False
    of_all.send_samples([])
    assert page.connection.sent == large[-3:]


def test_what_is_shown_no_more_is_not_sent(page, of_all):
    page.connection.is_slow = True
    of_all.send_samples([*values(b'1'), Sample('/a', b'new', 'message')])
    of_all.show(page, Watched())
    page.connection.is_slow = False
    of_all.send_samples([])
    assert page.connection.sent == []


def test_what_any_page_plots_is_watched(page, of_all):
    other = Page('page 2', Transport())
    of_all.add(other, TimeReset(0.0))
    of_all.show(other, Watched(fields={'/a': frozenset(['y', 'z']), '/b': frozenset(['x'])}))
    watched = of_all.watched
    assert watched.fields == {'/a': frozenset('xyz'), '/b': frozenset('x')}
    assert (watched.sensors, watched.messages) == (SHOWN.sensors, SHOWN.messages)


def test_who_comes_later_gets_the_latest_message_and_no_old_values(page, of_all):
    of_all.send_samples([*values(b'1'), Sample('/a', b'new', 'message')])
    late = Page('page 2', Transport())
    of_all.add(late, TimeReset(0.0))
    late.connection.sent.clear()
    of_all.show(late, SHOWN)
    of_all.send_samples([])
    assert late.connection.sent == [b'new']


def test_what_lasts_is_sent_again_only_when_it_has_changed(page, of_all):
    for frame in (b'map', b'map', b'other', b'other', b'map'):
        of_all.send_samples([Sample('/a', frame, is_lasting=True)])
    assert page.connection.sent == [b'map', b'other', b'map']
    page.connection.sent.clear()
    of_all.send_samples([Sample('/a', b'scan'), Sample('/a', b'scan')])
    of_all.send_samples([Sample('/a', b'scan')])
    assert page.connection.sent == [b'scan', b'scan'], 'the newest of each time'
