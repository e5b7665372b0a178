# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each process that runs tests has a ROS domain of its own: nobody is in it, nor the shell."""

from concurrent.futures import ThreadPoolExecutor
import os
import socket

import pytest
from support.paths import TESTS
from support.running_programs import Program

from amr_description.errors import SimulationError
from amr_description.ros import local_participants
from amr_description.testing import program

PARTICIPANT = """
import os, sys
os.environ |= {'ROS_DOMAIN_ID': sys.argv[1], 'ROS_AUTOMATIC_DISCOVERY_RANGE': sys.argv[2]}
import rclpy
rclpy.init()
node = rclpy.create_node('somebody')
print('there', flush=True)
rclpy.spin(node)
"""


@pytest.fixture
def taken():
    found = [program.take_domain() for _ in range(5)]
    yield [domain for domain, _ in found]
    for _, lock in found:
        os.close(lock)


@pytest.fixture
def ours(taken, monkeypatch, tmp_path):
    """Domains that no other test has, and which can be taken: with lock files of their own."""
    monkeypatch.setattr(program, 'LOCKS', tmp_path)
    monkeypatch.setattr(program, 'DOMAINS', taken)
    return taken


@pytest.fixture
def take():
    """Take a domain until the end of the test."""
    locks = []

    def take():
        domain, lock = program.take_domain()
        locks.append(lock)
        return domain

    yield take
    for lock in locks:
        os.close(lock)


def test_no_domain_is_taken_twice(taken):
    assert len({int(os.environ['ROS_DOMAIN_ID']), *taken}) == 6


def test_the_next_file_has_another_domain(pytestconfig, monkeypatch):
    conftest = pytestconfig.pluginmanager.get_plugin(str(TESTS / 'conftest.py'))
    before, lock = program.take_domain()
    monkeypatch.setenv('ROS_DOMAIN_ID', str(before))
    monkeypatch.setitem(conftest.KEPT, 'lock', lock)
    conftest.change_domain()
    assert os.environ['ROS_DOMAIN_ID'] != str(before)
    with pytest.raises(OSError, match='Bad file descriptor'):
        os.fstat(lock)
    os.close(conftest.KEPT['lock'])


def test_a_domain_given_back_can_be_taken_but_not_by_whose_shell_has_it(taken, monkeypatch):
    monkeypatch.setattr(program, 'DOMAINS', taken[:1])
    with pytest.raises(SimulationError, match='all 1 ROS domains that tests use are taken'):
        program.take_domain()
    monkeypatch.setattr(program, 'DOMAINS', [free := max(taken) + 1_000])
    domain, lock = program.take_domain()
    os.close(lock)
    (program.LOCKS / f'ros_domain_{free}.lock').unlink()
    assert domain == free
    monkeypatch.setenv('ROS_DOMAIN_ID', str(free))
    with pytest.raises(SimulationError, match='all 1 ROS domains that tests use are taken'):
        program.take_domain()


def test_of_many_who_take_one_at_once_each_gets_another(ours, monkeypatch, take):
    monkeypatch.setattr(program, 'DOMAINS', range(ours[0] + 1_000, ours[0] + 1_040))
    with ThreadPoolExecutor(40) as takers:
        found = list(takers.map(lambda _: take(), range(40)))
    assert sorted(found) == list(program.DOMAINS)
    with pytest.raises(SimulationError, match='0 by programs on this host, 40 by other tests'):
        take()


@pytest.mark.parametrize('discovery_range', ['LOCALHOST', 'SUBNET', 'OFF'])
def test_a_domain_with_a_participant_is_left_alone(ours, monkeypatch, take, discovery_range):
    occupied, free = ours[:2]
    monkeypatch.setattr(program, 'DOMAINS', [occupied, free])
    with Program.of(PARTICIPANT, str(occupied), discovery_range) as participant:
        participant.expect('there')
        assert take() == free
        with pytest.raises(SimulationError, match='1 by programs on this host, 1 by other tests'):
            take()
    assert take() == occupied


def test_a_socket_where_only_the_whole_domain_listens_is_one_too_many(ours, take):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as multicast:
        multicast.bind(('0.0.0.0', 7400 + 250 * ours[-1]))
        assert {take() for _ in ours[:-1]} == set(ours[:-1])
        with pytest.raises(SimulationError, match='1 by programs on this host') as refusal:
            take()
    assert take() == ours[-1]
    assert '\n' not in str(refusal.value)


def test_the_lock_file_of_another_user_need_only_be_readable(ours, take, monkeypatch):
    (program.LOCKS / f'ros_domain_{ours[0]}.lock').touch()
    monkeypatch.setattr(program, 'DOMAINS', ours[:1])
    before = os.open

    def open_as_another_user(path, flags, *mode):
        if flags & (os.O_RDWR | os.O_WRONLY | os.O_CREAT):
            raise PermissionError(13, 'Permission denied', str(path))
        return before(path, flags, *mode)

    monkeypatch.setattr(os, 'open', open_as_another_user)
    assert take() == ours[0]


def test_where_the_sockets_are_not_shown_none_is_taken(ours, take, monkeypatch):
    def refuse():
        raise FileNotFoundError(2, 'No such file or directory', '/proc/no_such_table')

    monkeypatch.setattr(local_participants, 'udp_sockets', refuse)
    with pytest.raises(SimulationError, match='cannot be read: /proc/no_such_table: No such file'):
        take()
