# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the real stacks over DDS; those of stand-ins are in test_bringup_faults.py."""

from contextlib import contextmanager
import os
from pathlib import Path
import re
import signal
import sys
import time

from ament_index_python.packages import get_package_prefix
from fixtures.bringup.running import Bringup, ends
from motor_boards import BoardOnPty
import pytest
from running_programs import PATIENCE, Program

from amr_description.hardware.simulated_motor_board import Mode

PREFIX = Path(get_package_prefix('amr_description'))
AT_ONCE = ['create-3', 'mujoco_sim-1', 'robot_state_publisher-2']
COMMAND = '/diff_drive_controller/cmd_vel'
DRIVE = ['-r', '20', COMMAND, 'geometry_msgs/msg/TwistStamped', '{twist: {linear: {x: 0.3}}}']


@contextmanager
def stack(folder, name, *arguments, prefix=PREFIX):
    """A ready-made stack, without the page for the browser."""
    path = os.environ['AMENT_PREFIX_PATH'].replace(str(PREFIX), str(prefix))
    with Bringup(folder, name, 'viewer:=false', *arguments, AMENT_PREFIX_PATH=path) as bringup:
        yield bringup


@pytest.fixture
def held_back(tmp_path):
    """The package with a simulator that does not start before its gate, a FIFO, is opened."""
    prefix = tmp_path / 'held'
    executables = prefix / 'lib/amr_description'
    executables.mkdir(parents=True)
    (prefix / 'share').symlink_to(PREFIX / 'share')
    for executable in (PREFIX / 'lib/amr_description').iterdir():
        (executables / executable.name).symlink_to(executable)
    gate = tmp_path / 'gate'
    os.mkfifo(gate)
    simulator = executables / 'mujoco_sim'
    real = simulator.readlink()
    simulator.unlink()
    simulator.write_text(f'#!/bin/sh\nread -r go <{gate}\nexec {real} "$@"\n')
    simulator.chmod(0o755)
    return prefix, gate


def test_the_stack_comes_up_after_a_simulator_that_takes_ten_seconds_longer(tmp_path, held_back):
    prefix, gate = held_back
    with stack(tmp_path, 'simulation', prefix=prefix) as bringup:
        # Said every 5 s: the simulator is held back until the second time.
        bringup.expect(r'(?s)create-3\].*Waiting for service.*create-3\].*Waiting for service')
        assert sorted(bringup.pids()) == AT_ONCE
        gate.write_text('go\n')
        bringup.expect(r'\[launch\]: ready in')
        files, ports = shared_memory(bringup.left()), udp_ports(bringup.left())
        assert files
        assert ports
        assert bringup.end(signal.SIGINT) == 0
        assert 'escalating' not in bringup.output
        assert [path for path in files if Path(path).exists()] == []
        assert ports.isdisjoint(bound_udp_ports())


@pytest.mark.parametrize('victim', AT_ONCE)
def test_any_node_killed_before_the_simulator_is_there(tmp_path, held_back, victim):
    with stack(tmp_path, 'simulation', prefix=held_back[0]) as bringup:
        bringup.expect(r'Waiting messages on topic|Robot initialized')
        os.kill(bringup.pids()[victim], signal.SIGKILL)
        assert bringup.end() == 128 + signal.SIGKILL
        assert f'stopped because {victim} died of SIGKILL' in bringup.output.splitlines()[-1]
        assert sorted(bringup.pids()) == AT_ONCE
        assert bringup.left() == []


def test_a_simulator_that_is_killed_ends_all(tmp_path):
    with stack(tmp_path, 'simulation') as bringup:
        bringup.expect(r'\[launch\]: ready in')
        os.kill(bringup.pids()['mujoco_sim-1'], signal.SIGKILL)
        assert bringup.end() == 128 + signal.SIGKILL
        assert 'stopped because mujoco_sim-1 died of SIGKILL' in bringup.output
        assert 'escalating' not in bringup.output
        assert bringup.left() == []


def test_a_robot_that_cannot_be_created_ends_all_and_names_the_step(tmp_path):
    urdf = tmp_path / 'weightless.urdf'
    urdf.write_text('<robot name="weightless"><link name="base"/></robot>')
    with stack(tmp_path, 'simulation', f'urdf:={urdf}') as bringup:
        assert bringup.end() == 1
        last_line = bringup.output.splitlines()[-1]
        assert 'stopped because create-3 ended with exit code 1' in last_line
        assert 'never started: spawner-4' in last_line
        assert 'escalating' not in bringup.output, 'nobody is waited for'
        assert bringup.left() == []


def test_the_wheels_stop_when_the_orchestrator_is_killed(tmp_path):
    with BoardOnPty(tmp_path / 'board') as plugged:
        board = plugged.board
        with stack(tmp_path, 'serial', f'port:={tmp_path}/board') as bringup:
            bringup.expect(r'\[launch\]: ready in')
            with Program(
                sys.executable, '-m', 'amr_description.cli', 'ros2', 'topic', 'pub', *DRIVE
            ):
                assert comes(lambda: board.left.target > 0 and board.right.target > 0)
                pids = bringup.left()
                bringup.signal(signal.SIGKILL)
                assert all(ends(pid) for pid in pids)
        assert comes(lambda: board.mode is not Mode.ARMED)
        assert board.left.target == board.right.target == 0.0


def comes(condition):
    """Wait for what a thread of this process does; return whether it came."""
    deadline = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < deadline:
        os.sched_yield()
    return condition()


def shared_memory(pids):
    """The segments of Fast DDS that the processes have mapped, but ports, which others share."""
    texts = (Path(f'/proc/{pid}/maps').read_text() for pid in pids)
    return {path for text in texts for path in re.findall(r'/dev/shm/fastrtps_[0-9a-f]{16}', text)}


def udp_ports(pids):
    """The inodes of the UDP sockets that the processes hold."""
    links = (os.readlink(fd) for pid in pids for fd in Path(f'/proc/{pid}/fd').iterdir())
    sockets = {found[1] for link in links if (found := re.fullmatch(r'socket:\[(\d+)\]', link))}
    return sockets & bound_udp_ports()


def bound_udp_ports():
    """The inodes of all UDP sockets of this machine."""
    return {line.split()[9] for line in Path('/proc/net/udp').read_text().splitlines()[1:]}
