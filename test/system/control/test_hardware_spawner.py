# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``hardware_spawner`` as a process, beside a controller manager that runs."""

import pytest
from support.manager_host import ros_in_this_process, running_host
from support.ros_processes import run

from amr_description.nodes.hardware_spawner import parser

SERVICE = '/controller_manager/list_hardware_components'


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        yield host


def words_of(ended):
    """What it has logged, without stamps and names."""
    return [line.split(': ', 1)[1] for line in ended.stderr.splitlines() if 'RTPS' not in line]


def states(host):
    return {component.name: component.state.label for component in host.client.components()}


def test_a_component_is_configured_and_activated(host):
    for flag, action, number, label in (
        ('--configure', 'configured', 2, 'inactive'),
        ('--activate', 'activated', 3, 'active'),
        ('--activate', 'activated', 3, 'active'),
    ):
        ended = run('hardware_spawner', 'hardware', flag)
        assert (ended.returncode, ended.stdout) == (0, '')
        assert words_of(ended) == [
            f'waiting for service {SERVICE} to become available...',
            f"{action} component 'hardware'. Hardware now in state: "
            f"lifecycle_msgs.msg.State(id={number}, label='{label}').",
        ]
        assert states(host) == {'hardware': label}


def test_one_that_is_not_there_is_named_and_keeps_no_other_back(host):
    ended = run('hardware_spawner', 'nobody', 'hardware', '--configure')
    assert ended.returncode == 1
    assert words_of(ended)[1:] == [
        'Hardware Component is not loaded - state can not be changed. There is no '
        "'nobody'; /controller_manager has: hardware",
        "configured component 'hardware'. Hardware now in state: "
        "lifecycle_msgs.msg.State(id=2, label='inactive').",
        'not configured: nobody',
    ]
    assert states(host) == {'hardware': 'inactive'}


def test_a_refusal_has_its_reason(host):
    run('hardware_spawner', 'hardware', '--configure')
    host.hardware.faults['activate'] = RuntimeError('the brake is on')
    ended = run('hardware_spawner', 'hardware', '--activate')
    host.hardware.faults.clear()
    assert ended.returncode == 1
    _, warning, error = words_of(ended)
    assert warning.startswith("Could not activated component 'hardware'. Service call failed. Wro")
    assert 'the brake is on' in warning
    assert error == 'not activated: hardware'


def test_a_manager_that_does_not_come_is_explained(host):
    words = ('hardware_spawner', 'hardware', '--activate', '-c', '/left/cm')
    # Where discovery has lost a packet it finds the other one after 3 s.
    ended = run(*words, '--controller-manager-timeout', '5')
    assert ended.returncode == 1
    assert words_of(ended)[-1].startswith(
        'Could not contact service /left/cm/list_hardware_components within 5 s: there is no node '
        '/left/cm, but /controller_manager; '
    )


@pytest.mark.parametrize('words', ['', 'a', '--activate', 'a --activate --configure'])
def test_a_wrong_command_line_is_answered_with_the_usage(capsys, words):
    with pytest.raises(SystemExit) as ended:
        parser().parse_args(words.split())
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith('usage: hardware_spawner ')
