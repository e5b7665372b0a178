# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When the graph counts as complete, with participants that come and go at given times."""

from dataclasses import dataclass

import pytest

from amr_description.cli import graph


@dataclass
class Times:
    """s from the start: when one starts, is found, ends, is missed; when its node is known."""

    starts: float
    found: float
    ends: float = 99.0
    missed: float = 99.0
    named: float = 0.0


class FakeSession:
    """A verb whose node has found itself, and others at the given times."""

    def __init__(self, others):
        self.others = others
        self.time = 0.0
        self.node = self.clock = self.context = self

    def now(self):
        return self.time

    def get_domain_id(self):
        return 0

    def spin(self, until, timeout):
        end = self.time + timeout
        while not until() and self.time < end:
            self.time += 0.02

    def known(self):
        return [each for each in self.others if each.found <= self.time < each.missed]

    def running(self):
        own = {(0, 100)}
        times = enumerate(self.others, start=1)
        return own | {(n, 100 + n) for n, t in times if t.starts <= self.time < t.ends}

    def get_publishers_info_by_topic(self, topic, no_mangle=False):
        return [self, *self.known()] if topic == 'ros_discovery_info' else []

    get_subscriptions_info_by_topic = get_publishers_info_by_topic

    def get_node_names(self):
        return ['verb', *(str(each) for each in self.known() if each.named <= self.time)]

    get_node_names_and_namespaces = get_node_names

    def get_topic_names_and_types(self):
        return []

    get_service_names_and_types = get_topic_names_and_types


def completed(monkeypatch, *others):
    """The time, s, at which the graph counts as complete."""
    session = FakeSession(others)
    monkeypatch.setattr(graph, 'local_participants', lambda _domain: session.running())
    monkeypatch.delenv('ROS_DISCOVERY_SERVER', raising=False)
    graph.wait_for_discovery(session, 0.0)
    return session.time


def test_it_is_complete_when_nothing_changes_any_more(monkeypatch):
    assert completed(monkeypatch) == pytest.approx(0.4, abs=0.05)
    assert completed(monkeypatch, Times(0.0, found=0.3)) == pytest.approx(0.7, abs=0.05)


def test_it_is_not_complete_before_who_is_there_is_found(monkeypatch):
    assert completed(monkeypatch, Times(0.0, found=2.0)) > 2.0
    assert completed(monkeypatch, Times(0.3, found=2.0)) > 2.0


def test_it_is_not_complete_before_the_nodes_of_all_are_known(monkeypatch):
    assert completed(monkeypatch, Times(0.0, found=0.1, named=2.0)) > 2.0


def test_one_that_has_ended_does_not_stand_for_one_that_is_not_found(monkeypatch):
    ending = Times(0.0, found=0.1, ends=1.0, missed=1.3)
    assert completed(monkeypatch, Times(0.0, found=2.0), ending) > 2.0


def test_one_that_ends_again_and_again_is_waited_for_5_s_at_most(monkeypatch):
    busy = [Times(t / 10, found=t / 10, ends=t / 10 + 0.1, missed=9.0) for t in range(90)]
    assert completed(monkeypatch, *busy) == pytest.approx(5.0, abs=0.1)
