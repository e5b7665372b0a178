# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When the graph counts as complete, with participants that come and go at given times."""

from collections import Counter
from contextlib import contextmanager
from dataclasses import dataclass
import os
import subprocess

import pytest
from rclpy.context import Context
from rclpy.node import Node

from amr_description.cli import discovery
from amr_description.ros.endpoints import UNKNOWN_NODE_NAME
from amr_description.ros.local_participants import local_participants, may_have_made
from amr_description.ros.node_lists import NodeList, PREFIX, TOPIC

DOMAIN = int(os.environ['ROS_DOMAIN_ID'])
THIS_HOST, OTHER_HOST = b'\x01\x0f\x00\x01', b'\x01\x0f\x00\x02'


@dataclass
class Times:
    """s from the start: when one starts, is found, ends, is missed; when its node is known."""

    starts: float
    found: float
    ends: float = 99.0
    missed: float = 99.0
    named: float = 0.0
    listed: float = 0.0
    """When its list comes."""
    complete: float = 0.0
    """When the last of its endpoints is found."""
    host: bytes = THIS_HOST
    name: str = 'other'


@dataclass
class Endpoint:
    endpoint_gid: list[int]
    node_name: str
    node_namespace: str = '/'


class FakeSession:
    """A verb whose node has found itself, and others at the given times."""

    def __init__(self, others, sampling=0.0, poll=None):
        """
        ``sampling``: s that pass between a look at the sockets and one at the graph; ``poll``: s
        between two of these, if not as asked.
        """
        self.sampling = sampling
        self.poll = poll
        self.others = [Times(-1.0, found=0.0, name='verb'), *others]
        self.time = -0.01
        self.began = -0.01
        self.node = self.clock = self.context = self
        self.participants = self.running() - {(0, 100)}
        self.time = 0.0

    def now(self):
        return self.time

    monotonic = now

    def get_domain_id(self):
        return 0

    def spin(self, until, timeout, poll=0.02):
        end = self.time + timeout
        while not until() and self.time < end:
            self.time += self.poll or poll

    def known(self):
        return [each for each in self.others if each.found <= self.time < each.missed]

    def running(self):
        times = enumerate(self.others)
        return {(n, 100 + n) for n, t in times if t.starts <= self.time < t.ends}

    def look_at_sockets(self):
        there = self.running()
        self.time += self.sampling
        return there

    def runs(self, prefix, _there):
        return self.time < self.others[int.from_bytes(prefix[4:6], 'little')].ends

    def gid(self, each, number):
        prefix = each.host + self.others.index(each).to_bytes(2, 'little') + bytes(6)
        return prefix + number.to_bytes(4)

    def ends(self, number):
        for each in self.known():
            if number < 3 or each.complete <= self.time:
                is_named = number > 1 and each.named <= self.time
                name = each.name if is_named else UNKNOWN_NODE_NAME
                yield Endpoint(list(self.gid(each, number)), name)

    def get_publishers_info_by_topic(self, topic, no_mangle=False):
        return list(self.ends(0)) if topic == TOPIC else list(self.ends(3)) if no_mangle else []

    def get_subscriptions_info_by_topic(self, topic, no_mangle=False):
        return list(self.ends(1 if topic == TOPIC else 2))

    def get_name(self):
        return 'verb'

    def get_namespace(self):
        return '/'

    def get_node_names_and_namespaces(self):
        return [(each.name, '/') for each in self.known() if each.named <= self.time]

    get_node_names = get_node_names_and_namespaces

    def get_topic_names_and_types(self, no_demangle=False):
        return [('rt/chatter', [])] if no_demangle else []

    def get_service_names_and_types(self):
        return []

    def newest(self):
        return {
            self.gid(each, 0)[:12]: NodeList(
                Counter([(each.name, '/')]), frozenset({self.gid(each, 2), self.gid(each, 3)})
            )
            for each in self.known()
            if each.listed <= self.time
        }


@pytest.fixture
def quiet(monkeypatch):
    """Return the time, s, at which the graph counts as complete where not all can be counted."""
    return lambda *others, **more: completed(monkeypatch, others, is_this_host_all=False, **more)


@pytest.fixture
def counted(monkeypatch):
    """Return that time where all are on this host."""
    return lambda *others, **more: completed(monkeypatch, others, is_this_host_all=True, **more)


def completed(monkeypatch, others, *, is_this_host_all, **more):
    session = FakeSession(others, **more)

    @contextmanager
    def subscribe(_node):
        yield session

    monkeypatch.setattr(discovery, 'local_participants', lambda _domain: session.look_at_sockets())
    monkeypatch.setattr(discovery, 'may_have_made', session.runs)
    monkeypatch.setattr(discovery, 'wall', session)
    monkeypatch.setattr(discovery, 'subscribe_to_node_lists', subscribe)
    monkeypatch.setattr(discovery, '_is_this_host_all', lambda: is_this_host_all)
    monkeypatch.delenv('ROS_DISCOVERY_SERVER', raising=False)
    discovery.wait_for_discovery(session, 0.0)
    return session.time


def test_it_is_complete_when_nothing_changes_any_more(quiet):
    assert quiet() == pytest.approx(0.4, abs=0.05)
    assert quiet(Times(0.0, found=0.3)) == pytest.approx(0.7, abs=0.05)


def test_it_is_not_complete_before_who_is_there_is_found(quiet):
    assert quiet(Times(0.0, found=2.0)) > 2.0
    assert quiet(Times(0.3, found=2.0)) > 2.0


def test_it_is_not_complete_before_the_nodes_of_all_are_known(quiet):
    assert quiet(Times(0.0, found=0.1, named=2.0)) > 2.0


def test_one_that_has_ended_does_not_stand_for_one_that_is_not_found(quiet):
    ending = Times(0.0, found=0.1, ends=1.0, missed=1.3)
    assert quiet(Times(0.0, found=2.0), ending) > 2.0


def test_one_that_comes_while_all_are_counted_does_not_stand_for_another(quiet):
    late = Times(-9.0, found=4.0)
    for begin in (0.43, 0.57, 0.8):
        come = Times(begin, found=begin + 0.01, named=begin + 0.01)
        assert quiet(late, come, sampling=0.1) > 4.0


def test_one_that_ends_again_and_again_is_waited_for_5_s_at_most(quiet):
    busy = [Times(t / 10, found=t / 10, ends=t / 10 + 0.1, missed=9.0) for t in range(90)]
    assert quiet(*busy) == pytest.approx(5.0, abs=0.1)


def test_on_this_host_it_is_complete_as_soon_as_all_have_been_counted(counted):
    assert counted() == pytest.approx(0.0, abs=0.02)
    assert counted(Times(0.0, found=0.1), Times(-9.0, found=0.2)) == pytest.approx(0.2, abs=0.02)


@pytest.mark.parametrize('late', ['found', 'named', 'listed', 'complete'])
def test_on_this_host_it_is_complete_with_the_last_of_what_there_is(counted, late):
    times = {'found': 0.1, late: 2.0}
    assert counted(Times(-9.0, **times), Times(-9.0, found=0.1)) == pytest.approx(2.0, abs=0.03)


@pytest.mark.parametrize('missed', [0.3, 20.0])
def test_on_this_host_one_that_has_ended_does_not_hide_another(counted, missed):
    ending = Times(-9.0, found=0.1, ends=0.2, missed=missed)
    assert counted(Times(-9.0, found=0.6), ending) == pytest.approx(0.6, abs=0.03)


def test_on_this_host_one_of_before_does_not_hide_another(counted):
    """It was there before the verb was, is found, and has just been killed."""
    killed = Times(-9.0, found=0.0, ends=0.0)
    assert counted(Times(-9.0, found=0.6), killed) == pytest.approx(0.6, abs=0.03)


def test_on_this_host_one_that_comes_while_all_are_counted_does_not_hide_another(counted):
    """As on a busy machine, which takes its time between two looks."""
    late = Times(-9.0, found=2.0)
    for begin in (0.03, 0.12, 0.31):
        assert counted(late, Times(begin, found=begin + 0.01), sampling=0.1) > 2.0


def test_on_this_host_one_that_came_and_went_unseen_does_not_hide_another(counted):
    """As where the verb did not have a processor for so long."""
    late = Times(-9.0, found=2.0)
    unseen = Times(0.05, found=0.1, ends=0.25, missed=0.5)
    assert counted(late, unseen, poll=0.3) > 2.0


def test_on_this_host_one_of_another_host_does_not_hide_another(counted):
    stranger = Times(99.0, found=0.1, host=OTHER_HOST)
    assert counted(Times(-9.0, found=0.6), stranger) == pytest.approx(0.6, abs=0.03)


def test_on_this_host_one_that_has_ended_unfound_is_not_waited_for(counted):
    ended = Times(-9.0, found=99.0, ends=0.1)
    assert counted(ended, Times(-9.0, found=0.1)) == pytest.approx(0.3, abs=0.03)
    assert counted(ended, Times(-9.0, found=1.0)) == pytest.approx(1.0, abs=0.03)


def test_on_this_host_one_that_was_killed_half_found_is_not_waited_for(counted):
    killed = Times(-9.0, found=0.1, ends=0.2, listed=99.0, complete=99.0, named=99.0)
    assert counted(killed, Times(-9.0, found=0.6)) == pytest.approx(0.6, abs=0.03)


def test_on_this_host_one_whose_process_is_not_seen_is_waited_for(counted, monkeypatch):
    """As in a container that has the network of this host, and processes of its own."""
    monkeypatch.setattr(FakeSession, 'runs', lambda _session, _prefix, _there: False)
    late = Times(-9.0, found=0.1, complete=2.0)
    ended = Times(-9.0, found=99.0, ends=0.1)
    assert counted(ended, late) == pytest.approx(2.0, abs=0.03)


def test_on_this_host_one_that_is_never_found_leaves_it_to_quiet(counted):
    assert counted(Times(-9.0, found=99.0)) == pytest.approx(5.0, abs=0.05)


def test_a_participant_of_this_host_is_known_by_its_gid():
    before = local_participants(DOMAIN)
    context = Context()
    context.init(args=[], domain_id=DOMAIN)
    node = Node('one', context=context)
    try:
        (own, *_) = node.get_publishers_info_by_topic(TOPIC, no_mangle=True)
        prefix = bytes(own.endpoint_gid[:PREFIX])
        assert int.from_bytes(prefix[4:6], 'little') == os.getpid() & 0xFFFF
        there = local_participants(DOMAIN)
        assert may_have_made(prefix, there - before)
        assert not may_have_made(prefix, {(number, inode + 10**9) for number, inode in there})
        ended = subprocess.Popen(['true'])
        os.waitid(os.P_PID, ended.pid, os.WEXITED | os.WNOWAIT)
        of_ended = prefix[:4] + (ended.pid & 0xFFFF).to_bytes(2, 'little') + prefix[6:]
        assert not may_have_made(of_ended, there)
        ended.wait()
    finally:
        node.destroy_node()
        context.try_shutdown()
