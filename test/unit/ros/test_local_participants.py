# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who is in a domain on this host, from the UDP ports in use."""

from contextlib import ExitStack, suppress
import os
import socket

import pytest

from amr_description.errors import SimulationError
from amr_description.ros.local_participants import (
    discovery_sockets,
    foreign_sockets,
    is_on_the_network,
    local_participants,
    owner_of,
    participant_ids,
)
from amr_description.testing import program
from amr_description.testing.program import take_domain


def has_ipv6():
    try:
        with socket.socket(socket.AF_INET6, socket.SOCK_DGRAM) as user:
            user.bind(('::1', 0))
    except OSError:
        return False
    return True


ADDRESSES = ['0.0.0.0', '127.0.0.1', *(['::', '::1'] if has_ipv6() else [])]


@pytest.mark.parametrize('domain', [0, 33, 101])
def test_the_port_tells_domain_and_participant(domain):
    discovery, user, multicast = (7400 + 250 * domain + offset for offset in (10, 11, 0))
    ports = {discovery, user, discovery + 4, user + 4, multicast, 53}
    assert participant_ids(ports, domain) == {0, 2}
    assert participant_ids(ports, domain + 1) == set()


def test_a_lone_port_is_not_a_participant():
    discovery = 7400 + 250 * 101 + 10
    assert participant_ids({discovery + 8, discovery + 21}, 101) == set()


@pytest.fixture
def first_port():
    """Of a domain without participants."""
    domain, lock = take_domain()
    yield 7400 + 250 * domain
    os.close(lock)


def test_ports_in_use_count(first_port):
    domain = (first_port - 7400) // 250
    first = first_port + 10 + 2 * 77
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as discovery,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as user,
    ):
        discovery.bind(('127.0.0.1', first))
        user.bind(('127.0.0.1', first + 1))
        inode = os.fstat(discovery.fileno()).st_ino
        assert local_participants(domain) == {(77, inode)}
    assert local_participants(domain) == set()


@pytest.mark.parametrize('address', ADDRESSES)
@pytest.mark.parametrize('offset', [0, 10, 12, 248])
def test_a_socket_where_a_participant_listens_is_seen(first_port, address, offset):
    domain, port = (first_port - 7400) // 250, first_port + offset
    assert discovery_sockets(domain) == {}
    family = socket.AF_INET6 if ':' in address else socket.AF_INET
    with socket.socket(family, socket.SOCK_DGRAM) as listener:
        listener.bind((address, port))
        inode = os.fstat(listener.fileno()).st_ino
        assert discovery_sockets(domain) == {port: {inode}}
        assert is_on_the_network(domain) == (offset == 0)
        assert foreign_sockets(domain, [os.getpid()]) == {}
        assert foreign_sockets(domain, [os.getppid()]) == {port: {inode}}
        assert owner_of({inode}).startswith(f'pid {os.getpid()} "')
    assert discovery_sockets(domain) == {}


@pytest.fixture
def between(monkeypatch):
    """
    The port of a domain without participants; those on both sides are taken too.

    Tests that have them would find a socket of this one in theirs, or have its port.
    """
    for domain in program.DOMAINS[1:-1]:
        if locks := take_three(domain, monkeypatch):
            with locks:
                yield 7400 + 250 * domain
            return
    raise AssertionError('no three domains side by side are free')


def take_three(middle, monkeypatch):
    """Take a domain and those on both sides; return what gives them back, or None."""
    with ExitStack() as locks, suppress(SimulationError):
        for domain in (middle - 1, middle, middle + 1):
            monkeypatch.setattr(program, 'DOMAINS', [domain])
            locks.callback(os.close, take_domain()[1])
        return locks.pop_all()
    return None


@pytest.mark.parametrize('offset', [-2, 1, 11, 249, 250])
def test_a_socket_elsewhere_is_nobodys(between, offset):
    domain = (between - 7400) // 250
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(('127.0.0.1', between + offset))
        assert discovery_sockets(domain) == {}


def test_a_socket_of_nobody_has_no_owner():
    assert owner_of({0}) == ''
