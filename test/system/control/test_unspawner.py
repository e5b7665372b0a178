# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``unspawner`` as a process, beside a controller manager that runs."""

import pytest
from support.manager_host import ros_in_this_process, running_host
from support.ros_processes import run

from amr_description.errors import ControllerError

JOINTS, DRIVE = 'joint_state_broadcaster', 'diff_drive_controller'


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        yield host


@pytest.fixture(autouse=True)
def nothing_loaded(host):
    yield
    host.forget()


def said(ended):
    """What it logs, without stamp and name."""
    return [line.split(': ', 1)[1] for line in ended.stderr.splitlines() if 'RTPS' not in line][1:]


def test_active_inactive_and_unconfigured_ones_are_unloaded(host):
    host.activate(JOINTS)
    assert host.client.load(DRIVE)
    ended = run('unspawner', JOINTS, DRIVE)
    assert (ended.returncode, ended.stdout) == (0, '')
    assert said(ended) == ['Deactivated controller', 'Unloaded controller', 'Unloaded controller']
    assert host.client.states() == {}


def test_one_that_is_not_loaded_is_told_and_keeps_no_other_loaded(host):
    host.activate(JOINTS)
    ended = run('unspawner', 'nobody', JOINTS, '-c', 'controller_manager')
    assert ended.returncode == 1
    assert said(ended) == [
        'Deactivated controller',
        'Unloaded controller',
        'Failed to unload controller nobody: no controller of this name is loaded',
    ]
    assert host.client.states() == {}


def test_a_refused_deactivation_ends_it_with_the_reason(host, monkeypatch):
    host.activate(JOINTS, DRIVE)
    switch = host.running.manager.switch

    def refuse(activate, deactivate, *more):
        if DRIVE in deactivate:
            raise ControllerError('it is needed')
        return switch(activate, deactivate, *more)

    with monkeypatch.context() as patch:
        patch.setattr(host.running.manager, 'switch', refuse)
        ended = run('unspawner', DRIVE)
    assert ended.returncode == 1
    assert said(ended) == [f"Failed to deactivate controllers : ['{DRIVE}']: it is needed"]
    assert host.client.states()[DRIVE] == 'active'


@pytest.mark.parametrize('words', [(), ('a', '--switch-timeout', 'soon'), ('a', '--inactive')])
def test_a_wrong_command_line_is_answered_with_the_usage(words):
    ended = run('unspawner', *words)
    assert ended.returncode == 2
    assert 'usage: unspawner' in ended.stderr
