# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whom discovery has yet to find, from the UDP ports in use."""

import os
import socket

import pytest

from amr_description.ros.local_participants import count_local_participants, participant_ids


@pytest.mark.parametrize('domain', [0, 33, 101])
def test_the_port_tells_domain_and_participant(domain):
    discovery, user, multicast = (7400 + 250 * domain + offset for offset in (10, 11, 0))
    ports = {discovery, user, discovery + 4, user + 4, multicast, 53}
    assert participant_ids(ports, domain) == {0, 2}
    assert participant_ids(ports, domain + 1) == set()


def test_a_lone_port_is_not_a_participant():
    discovery = 7400 + 250 * 101 + 10
    assert participant_ids({discovery + 8, discovery + 21}, 101) == set()


def test_ports_in_use_count():
    domain = int(os.environ['ROS_DOMAIN_ID'])  # nobody else's, during the tests
    before = count_local_participants(domain)
    first = 7400 + 250 * domain + 10 + 2 * 77
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as discovery,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as user,
    ):
        discovery.bind(('127.0.0.1', first))
        user.bind(('127.0.0.1', first + 1))
        assert count_local_participants(domain) == before + 1
    assert count_local_participants(domain) == before
