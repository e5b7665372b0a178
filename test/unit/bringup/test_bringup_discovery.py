# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Discovery: the options, the environment variables, and the messages about them."""

from argparse import ArgumentParser
import os

import pytest

from amr_description.bringup.environment import (
    add_options,
    as_arguments,
    discovery_text,
    exports,
    variables,
)
from amr_description.bringup.main import main as bringup_main
from amr_description.cli import ros2
from amr_description.errors import UsageError

DOMAIN, RANGE = 'ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE'
PEERS, SERVER = 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER'


def bringup(*words):
    return bringup_main(['simulation', *words])


def ros2_launch(*words):
    return ros2.main(['launch', *words, 'amr_description', 'simulation'])


def options(*typed):
    parser = ArgumentParser()
    add_options(parser)
    return parser.parse_args(typed)


@pytest.mark.parametrize(
    ('typed', 'expected'),
    [
        ([], {}),
        (['--domain', '0'], {DOMAIN: '0'}),
        (['--domain=232'], {DOMAIN: '232'}),
        (['--discovery', 'subnet'], {RANGE: 'SUBNET'}),
        (['--peer', '127.0.0.1', '--peer', 'localhost'], {PEERS: '127.0.0.1;localhost'}),
        (['--discovery-server', '127.0.0.1'], {SERVER: '127.0.0.1:11811'}),
        (
            ['--discovery-server', 'localhost:7', '--discovery-server=UDPv4:[127.0.0.1]:8'],
            {SERVER: 'localhost:7;UDPv4:[127.0.0.1]:8'},
        ),
    ],
)
def test_each_option_stands_for_a_variable(typed, expected):
    assert variables(options(*typed), {}) == expected
    assert options(*as_arguments(options(*typed))) == options(*typed), 'ros2 launch hands them on'


def test_an_option_overrides_the_variable_which_may_be_invalid_then():
    assert variables(options('--domain', '5'), {DOMAIN: 'five', PEERS: ''}) == {DOMAIN: '5'}


@pytest.mark.parametrize(
    ('typed', 'text'),
    [
        (['--domain', '233'], '--domain 233: a ROS domain is an integer from 0 to 232'),
        (['--domain=-1'], '--domain -1: a ROS domain is'),
        (['--domain', ''], '--domain : a ROS domain is'),
        (['--discovery', 'lan'], '--discovery lan: a discovery range is one of SUBNET, LOCALHOST'),
        (['--peer', '127.0.0.1:7400'], 'a peer is the address .* without a port'),
        (['--peer', 'no.such.invalid'], "no address is known for the host 'no.such.invalid'"),
        (['--discovery-server', 'a b'], 'a discovery server is HOST or HOST:PORT, as 10.0.0.9:11'),
        (['--discovery-server', '127.0.0.1:65536'], 'a discovery server is HOST or HOST:PORT'),
        (['--discovery-server', 'x' * 70], 'no address is known for the host'),
    ],
)
def test_a_wrong_option_is_refused(typed, text):
    with pytest.raises(UsageError, match=text):
        variables(options(*typed), {})


@pytest.mark.parametrize(
    ('environment', 'text'),
    [
        ({DOMAIN: 'five'}, 'ROS_DOMAIN_ID=five: a ROS domain is'),
        ({RANGE: 'subnet'}, 'ROS_AUTOMATIC_DISCOVERY_RANGE=subnet: rcl wants capital .* SUBNET'),
        ({RANGE: 'LAN'}, 'a discovery range is one of'),
        ({PEERS: '127.0.0.1, 127.0.0.2'}, 'ROS_STATIC_PEERS=.*: a peer is'),
        ({SERVER: ';127.0.0.1:0'}, 'ROS_DISCOVERY_SERVER=;127.0.0.1:0: a discovery server is'),
    ],
)
def test_a_wrong_variable_is_refused(environment, text):
    with pytest.raises(UsageError, match=text):
        variables(options(), environment)


def test_valid_variables_are_not_changed():
    good = {DOMAIN: '7', RANGE: 'SUBNET', PEERS: '127.0.0.1;', SERVER: ';;127.0.0.1:11811'}
    assert variables(options(), good) == {}


@pytest.mark.parametrize(
    ('environment', 'text', 'lines'),
    [
        ({}, 'ROS domain 0, this host only', []),
        (
            {RANGE: 'SUBNET'},
            'ROS domain 0, the whole network: whoever is in it can drive',
            [f'export {RANGE}=SUBNET'],
        ),
        ({RANGE: 'LOCALHOST', DOMAIN: '0'}, 'ROS domain 0, this host only', []),
        ({RANGE: 'OFF'}, 'ROS domain 0, nobody is found', [f'export {RANGE}=OFF']),
        (
            {DOMAIN: '5', RANGE: 'SUBNET', PEERS: 'a;b'},
            'ROS domain 5, the whole network and a;b: whoever is in it can drive',
            [f'export {DOMAIN}=5', f'export {RANGE}=SUBNET', f"export {PEERS}='a;b'"],
        ),
        (
            {SERVER: ';a:1', RANGE: 'LOCALHOST'},
            'ROS domain 0, found through the discovery server a:1',
            [f"export {SERVER}=';a:1'"],
        ),
    ],
)
def test_discovery_in_words_and_as_exports(environment, text, lines):
    assert discovery_text(environment) == text
    assert exports(environment) == lines


@pytest.mark.parametrize('main', [bringup, ros2_launch])
def test_errors_are_reported_before_anything_starts(monkeypatch, capsys, main):
    monkeypatch.setattr('os.environ', dict(os.environ))
    assert main('--domain', '233') == 2
    assert main('--discovery', 'lan') == 2
    captured = capsys.readouterr()
    assert captured.out == ''
    said = captured.err.splitlines()
    assert len(said) == 2
    assert '--domain 233: a ROS domain is an integer from 0 to 232' in said[0]
    assert '--discovery lan: a discovery range is one of' in said[1]
