# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Participants without shared memory, which a killed process cannot hold up."""

from contextlib import contextmanager
import os
from pathlib import Path
import re
import signal
from xml.etree import ElementTree

import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, qos_profile_system_default, ReliabilityPolicy
from std_msgs.msg import String
from support.running_programs import PATIENCE, Program
from support.udp_contexts import as_any_program

from amr_description.ros.discovery import PROFILE
from amr_description.ros.service_calls import wait_until
from amr_description.ros.transport import (
    is_udp_only,
    reaches_other_hosts,
    UDP,
    UDP_LOCALHOST,
    UDP_LOOPBACK,
    udp_only,
)

VARIABLES = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE')
RANGE, LOCALHOST_ONLY = 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'ROS_LOCALHOST_ONLY'
TRANSPORTS, PEERS = 'FASTDDS_BUILTIN_TRANSPORTS', 'ROS_STATIC_PEERS'


@pytest.fixture(autouse=True)
def untouched(monkeypatch):
    """Nothing set by the user but the range, this host; all is as before in the end."""
    for variable in (*VARIABLES, LOCALHOST_ONLY, TRANSPORTS, PEERS):
        monkeypatch.setenv(variable, '')  # what is deleted below comes back as it was
        monkeypatch.delenv(variable)
    monkeypatch.setenv(RANGE, 'LOCALHOST')


def test_localhost_is_kept_by_the_profile_as_rmw_would_add_shared_memory_to_it():
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP_LOOPBACK)
        assert os.environ[RANGE] == 'SYSTEM_DEFAULT'
    assert os.environ[RANGE] == 'LOCALHOST'
    with udp_only():  # what a parent of ours has left is not the user's
        assert os.environ[RANGE] == 'SYSTEM_DEFAULT'


def test_static_peers_are_taken_with_localhost(monkeypatch):
    monkeypatch.setenv(PEERS, '10.0.0.1')
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP_LOCALHOST)
        assert os.environ[RANGE] == 'SUBNET'


def test_what_a_parent_has_left_may_have_another_path(monkeypatch, tmp_path):
    (tmp_path / 'linked').symlink_to(UDP_LOCALHOST.parent)  # as colcon links to the sources
    monkeypatch.setenv(VARIABLES[0], str(tmp_path / 'linked' / UDP_LOCALHOST.name))
    monkeypatch.setenv(RANGE, 'SUBNET')
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP)


@pytest.mark.parametrize('server', ['10.0.0.1:11811', ';10.0.0.1:11811'])
def test_a_discovery_server_may_be_anywhere(monkeypatch, server):
    monkeypatch.setenv('ROS_DISCOVERY_SERVER', server)
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP_LOCALHOST)


def test_what_is_inherited_of_a_closed_parent_does_not_keep_a_child_closed(monkeypatch):
    monkeypatch.setenv(VARIABLES[0], str(UDP_LOOPBACK))
    for discovery_range, profile, passed_on in (
        ('LOCALHOST', UDP_LOOPBACK, 'SYSTEM_DEFAULT'),
        ('SUBNET', UDP, 'SUBNET'),
    ):
        monkeypatch.setenv(RANGE, discovery_range)
        with udp_only():
            assert os.environ[VARIABLES[0]] == str(profile)
            assert os.environ[RANGE] == passed_on


@pytest.mark.parametrize(
    ('variables', 'reaches'),
    [
        ({}, False),
        ({PEERS: '10.0.0.1'}, True),
        ({RANGE: 'SUBNET'}, True),
        ({RANGE: ''}, False),
        ({RANGE: '', PEERS: '10.0.0.1'}, True),
        ({'ROS_DISCOVERY_SERVER': '10.0.0.1:11811'}, True),
        ({RANGE: 'OFF', PEERS: '10.0.0.1'}, False),
        ({RANGE: 'SUBNET', LOCALHOST_ONLY: '1'}, False),
    ],
)
def test_whether_others_may_be_beyond_this_host(monkeypatch, variables, reaches):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert reaches_other_hosts() == reaches


@pytest.mark.parametrize('discovery_range', ['SUBNET', 'SYSTEM_DEFAULT', 'OFF'])
def test_another_range_stays(monkeypatch, discovery_range):
    monkeypatch.setenv(RANGE, discovery_range)
    with udp_only():
        profile = UDP_LOOPBACK if discovery_range == 'OFF' else UDP
        assert os.environ[VARIABLES[0]] == str(profile)
        assert os.environ.get(RANGE) == discovery_range


def test_nobody_has_to_close_the_network(monkeypatch):
    monkeypatch.delenv(RANGE)
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP_LOOPBACK)
        assert os.environ[RANGE] == 'SYSTEM_DEFAULT'
    assert RANGE not in os.environ


def test_the_old_variable_for_localhost_counts_as_well(monkeypatch):
    monkeypatch.delenv(RANGE)
    monkeypatch.setenv(LOCALHOST_ONLY, '1')
    monkeypatch.setenv(PEERS, '10.0.0.1')
    with udp_only():
        assert os.environ[VARIABLES[0]] == str(UDP_LOOPBACK)
        assert (os.environ[LOCALHOST_ONLY], os.environ[PEERS]) == ('0', '')
        assert os.environ[RANGE] == 'SYSTEM_DEFAULT'
    assert (os.environ[LOCALHOST_ONLY], os.environ[PEERS]) == ('1', '10.0.0.1')
    assert RANGE not in os.environ


@pytest.mark.parametrize('variable', VARIABLES)
def test_a_profile_of_the_users_stays(monkeypatch, variable):
    monkeypatch.setenv(variable, '/their/profile.xml')
    with udp_only():
        assert os.environ[RANGE] == 'LOCALHOST'
        assert {os.environ.get(each) for each in VARIABLES} == {'/their/profile.xml', None}


def test_transports_of_the_users_stay(monkeypatch):
    monkeypatch.setenv(TRANSPORTS, 'LARGE_DATA')
    with udp_only():
        assert os.environ[RANGE] == 'LOCALHOST'
        assert os.environ[VARIABLES[0]] == str(PROFILE)


@pytest.mark.parametrize(
    ('variables', 'is_udp'),
    [
        ({}, True),
        ({RANGE: 'SUBNET'}, True),
        ({TRANSPORTS: 'SHM'}, False),
        ({VARIABLES[0]: '/of/mine.xml'}, False),
        ({VARIABLES[1]: '/of/mine.xml'}, False),
    ],
)
def test_whether_it_is_udp_alone(monkeypatch, variables, is_udp):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    with udp_only():
        assert is_udp_only() == is_udp
    assert is_udp_only() == is_udp


@pytest.mark.parametrize('profile', [PROFILE, UDP, UDP_LOCALHOST, UDP_LOOPBACK])
def test_every_profile_listens_before_it_announces(profile):
    assert '<throughputController>' in profile.read_text(encoding='utf-8')


@pytest.mark.parametrize('profile', [PROFILE, UDP, UDP_LOCALHOST, UDP_LOOPBACK])
def test_every_writer_asks_soon_whether_something_is_lost(profile):
    text = profile.read_text(encoding='utf-8')
    writers = re.findall('<data_writer .*?</data_writer>', text, re.DOTALL)
    assert any('is_default_profile="true"' in each for each in writers)
    for each in writers:  # a profile of its own takes nothing from the default one
        assert '<heartbeatPeriod><sec>0</sec><nanosec>200000000</nanosec>' in each


@pytest.mark.parametrize('discovery_range', ['LOCALHOST', 'SUBNET'])
def test_a_program_maps_no_shared_memory_and_fast_dds_has_no_complaint(discovery_range):
    with Program.module('talker', env={RANGE: discovery_range}) as talker:
        talker.expect('Hello World: 0')
        assert 'XML' not in talker.output
        maps = Path(f'/proc/{talker.process.pid}/maps').read_text(encoding='utf-8')
        assert 'librmw_fastrtps_cpp' in maps
        assert '/dev/shm/fastrtps' not in maps


def test_the_two_profiles_of_this_host_differ_in_where_they_listen_alone():
    def content(profile):
        return profile.read_text(encoding='utf-8').partition('<dds')[2].split('\n')

    added = set(content(UDP_LOOPBACK)) - set(content(UDP_LOCALHOST))
    assert len(content(UDP_LOOPBACK)) == len(content(UDP_LOCALHOST)) + 1
    assert {line.strip() for line in added} == {
        '<interfaceWhiteList><address>127.0.0.1</address></interfaceWhiteList>',
        '<participant profile_name="udp_loopback" is_default_profile="true">',
    }


def test_programs_with_shared_memory_are_reached():
    with as_any_program():
        rclpy.init(args=[])
    try:
        node, heard = Node('any_program'), []
        assert '/dev/shm/fastrtps' in Path('/proc/self/maps').read_text(encoding='utf-8')
        node.create_subscription(String, 'topic', heard.append, 10)
        with Program.module('talker'):
            assert wait_until(node, lambda: heard or None, timeout=PATIENCE)
        node.destroy_node()
    finally:
        rclpy.try_shutdown()


def test_ports_that_killed_processes_left_half_made_hold_nobody_up():
    with half_made_ports(), Program.module('talker') as talker:
        talker.expect('Hello World: 1')
        assert talker.end(signal.SIGINT) == 0


@contextmanager
def half_made_ports():
    """
    The ports of the next participants of the domain, as one that is killed may leave them.

    Whoever has shared memory waits for good, as for somebody who is about to fill them.
    """
    first = 7400 + 250 * int(os.environ['ROS_DOMAIN_ID']) + 11
    paths = [Path(f'/dev/shm/fastrtps_port{first + 2 * number}') for number in range(16)]
    made = [path for path in paths if not path.exists()]
    for path in made:
        path.write_bytes(bytes(52400))
    try:
        yield
    finally:
        for path in made:
            path.unlink()


def test_all_profiles_have_the_times_of_discovery():
    def times(profile):
        root = ElementTree.parse(profile).getroot()
        space = root.tag.partition('}')[0] + '}'
        parts = ('throughputController', 'data_reader', 'data_writer')
        found = [each for part in parts for each in root.iter(space + part)]
        return [ElementTree.tostring(each).split() for each in found]

    assert len(times(PROFILE)) == 5
    for profile in (UDP, UDP_LOCALHOST, UDP_LOOPBACK):
        assert times(profile) == times(PROFILE)


def test_the_default_profiles_change_no_qos():
    context = rclpy.Context()
    with udp_only():
        rclpy.init(context=context)
    node = Node('reader', context=context)
    try:
        node.create_subscription(String, 'of_the_profile', print, qos_profile_system_default)
        [info] = node.get_subscriptions_info_by_topic('of_the_profile')
        assert info.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT
        assert info.qos_profile.durability is DurabilityPolicy.VOLATILE
        node.create_publisher(String, 'of_the_profile', qos_profile_system_default)
        [info] = node.get_publishers_info_by_topic('of_the_profile')
        assert info.qos_profile.reliability is ReliabilityPolicy.RELIABLE
        assert info.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)
