# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of a shell, a disk and processes, made on purpose: each is found, and its fix works."""

from contextlib import contextmanager
import os
import resource
import signal
import subprocess
import sys

import pytest
from support.doctor_hosts import BUSY_MACHINE
from support.running_programs import PATIENCE

from amr_description.doctor.host import read_host
from amr_description.doctor.observations import Observations
from amr_description.doctor.table import examine

LISTENER = """\
import socket, sys
ports = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
for offset, each in enumerate(ports):
    each.bind(('', int(sys.argv[1]) + offset))
print(flush=True)
sys.stdin.read()
"""
"""It has the ports of a participant, by which a process of ROS is known, and starts at once."""

UNUSED_PARTICIPANT = 77
MIDDLEWARE = 'rmw_fastrtps_cpp'


@pytest.fixture
def domain():
    return int(os.environ['ROS_DOMAIN_ID'])


@contextmanager
def participant(domain, **variables):
    """A process that listens as a participant of a domain does."""
    port = 7400 + 250 * domain + 10 + 2 * UNUSED_PARTICIPANT
    process = subprocess.Popen(
        [sys.executable, '-I', '-S', '-c', LISTENER, str(port)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, **variables},
    )
    with process:
        assert process.stdout.readline() == b'\n'
        try:
            yield process
        finally:
            process.kill()


def findings(variables=os.environ):
    """What the rules find of this host, errors first, but that it is busy with other tests."""
    found = examine(Observations(**read_host(variables)))
    return [each for each in found if each.rule not in BUSY_MACHINE]


def after(fix, variables):
    """The variables of a shell after the first way of a fix was typed there."""
    line = f'{fix.partition("; or ")[0]}; env -0'
    done = subprocess.run(
        ['sh', '-c', line], env=variables, stdout=subprocess.PIPE, timeout=PATIENCE, check=True
    )
    pairs = (each.partition('=') for each in done.stdout.decode().split('\0') if each)
    return {name: value for name, _, value in pairs}


def typed(fix):
    """Type the first way of a fix."""
    subprocess.run(['sh', '-c', fix.partition('; or ')[0]], timeout=PATIENCE, check=True)


def rules(found):
    return {finding.rule for finding in found}


FAULTS = {
    'domain': {'ROS_DOMAIN_ID': '300'},
    'discovery_range': {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'localhost'},
    'discovery_range off': {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'},
    'localhost_only': {'ROS_LOCALHOST_ONLY': '1', 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'},
    'static_peers': {'ROS_STATIC_PEERS': '10.0.0.2,10.0.0.3'},
    'rmw_implementation': {'RMW_IMPLEMENTATION': 'rmw_cyclonedds_cpp'},
    'discovery_server': {'ROS_DISCOVERY_SERVER': '127.0.0.1:49199'},
    'profiles_file': {'FASTRTPS_DEFAULT_PROFILES_FILE': '/not/there.xml'},
    'profiles_file no XML': {'FASTRTPS_DEFAULT_PROFILES_FILE': __file__},
    'mixed_installations': {'LD_LIBRARY_PATH': '/opt/ros/jazzy/lib'},
    'python_path': {'PYTHONPATH': '/ws/install/a/lib/python3.10/site-packages'},
    'security': {'ROS_SECURITY_ENABLE': 'true', 'ROS_SECURITY_STRATEGY': 'Enforce'},
    'log_folder': {'ROS_LOG_DIR': f'{__file__}/log'},
}
OTHER_WAY = {'discovery_server'}
"""Whose fix begins with another way, which starts a program."""


@pytest.mark.parametrize('fault', FAULTS)
def test_a_variable_is_named_first_and_its_fix_works(fault):
    variables = {**os.environ, **FAULTS[fault]}
    first, *_ = findings(variables)
    assert first.rule == fault.partition(' ')[0]
    fix = first.fix.rpartition('; or ')[2] if first.rule in OTHER_WAY else first.fix
    assert first.rule not in rules(findings(after(fix, variables)))


def test_conda_is_named_first_and_left(tmp_path):
    (tmp_path / 'lib').mkdir()
    library = f'{tmp_path}/lib'
    variables = {**os.environ, 'CONDA_PREFIX': str(tmp_path), 'LD_LIBRARY_PATH': library}
    first, *_ = findings(variables)
    assert first.rule == 'conda'
    shell = f'conda() {{ unset CONDA_PREFIX; }}; {first.fix}'
    assert 'conda' not in rules(findings(after(shell, variables)))


def test_a_sourced_distribution_is_named_first():
    variables = {**os.environ, 'AMENT_PREFIX_PATH': '/opt/ros/humble', 'ROS_DISTRO': 'humble'}
    first, *_ = findings(variables)
    assert (first.rule, '/opt/ros/humble' in first.what) == ('other_distribution', True)
    assert 'other_distribution' not in rules(findings())


def test_a_stopped_process_is_named_first_and_goes_on(domain):
    with participant(domain) as process:
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED)
        first, *_ = findings()
        assert (first.rule, f'pid {process.pid}' in first.what) == ('stopped_process', True)
        typed(first.fix)
        os.waitid(os.P_PID, process.pid, os.WCONTINUED)
        assert 'stopped_process' not in rules(findings())


def test_what_is_left_of_a_killed_run_is_named_first_and_ended(domain):
    supervisor = subprocess.Popen(['true'])
    supervisor.wait()
    with participant(domain, AMR_BRINGUP_RUN=f'today-host-{supervisor.pid}') as process:
        first, *_ = findings()
        assert (first.rule, f'pid {process.pid}' in first.what) == ('orphaned_process', True)
        typed(first.fix)
        process.wait(PATIENCE)
        assert 'orphaned_process' not in rules(findings())


def test_a_run_whose_supervisor_lives_is_no_orphan(domain):
    with participant(domain, AMR_BRINGUP_RUN=f'today-host-{os.getpid()}'):
        assert 'orphaned_process' not in rules(findings())


@pytest.mark.parametrize(
    ('rule', 'name', 'value', 'good'),
    [
        ('undiscoverable_process', 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'OFF', 'LOCALHOST'),
        ('other_middleware', 'RMW_IMPLEMENTATION', 'rmw_zenoh_cpp', MIDDLEWARE),
    ],
)
def test_a_process_that_was_started_otherwise_is_named_first(domain, rule, name, value, good):
    with participant(domain, **{name: value}):
        first, *_ = findings()
    assert first.rule == rule
    assert f'{name}={good}' in first.fix
    with participant(domain, **{name: good}):
        assert rule not in rules(findings())


def test_a_process_near_its_limit_of_files_is_named(domain):
    with participant(domain) as process:
        resource.prlimit(process.pid, resource.RLIMIT_NOFILE, (5, 1024))
        assert 'open_files' in rules(findings())
        resource.prlimit(process.pid, resource.RLIMIT_NOFILE, (1024, 1024))
        assert 'open_files' not in rules(findings())
