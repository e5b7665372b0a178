# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the real stacks over DDS; those of stand-ins are in test_bringup_faults.py."""

from contextlib import contextmanager
import os
from pathlib import Path
import re
import signal
import sys

from fixtures.bringup.running import Bringup, ends, STACKS
import pytest
from support.motor_boards import BoardOnPty
from support.running_programs import Program

from amr_description.hardware.simulated_motor_board import BoardMode
from amr_description.ros.udp_sockets import udp_sockets

AT_ONCE = ['create-3', 'mujoco_sim-1', 'robot_state_publisher-2']
COMMAND = '/diff_drive_controller/cmd_vel'
DRIVE = ['-r', '20', COMMAND, 'geometry_msgs/msg/TwistStamped', '{twist: {linear: {x: 0.3}}}']


@contextmanager
def stack(folder, name, *arguments):
    """A stack that uses this package."""
    path = os.environ['AMENT_PREFIX_PATH']
    with Bringup(folder, name, *arguments, AMENT_PREFIX_PATH=path) as bringup:
        yield bringup


def up(bringup, *steps):
    """Wait until the steps are done, one after the other, and then the last one."""
    for step in steps:
        bringup.expect(rf'\[{step}\]: process has finished cleanly')
    bringup.expect(r'\[launch\]: ready in')


@pytest.mark.parametrize('victim', AT_ONCE)
def test_any_node_killed_before_the_simulator_is_there(tmp_path, victim):
    os.mkfifo(tmp_path / 'gate')
    with stack(tmp_path, str(STACKS / 'late_simulator.py'), f'gate:={tmp_path}/gate') as bringup:
        bringup.expect(r'Waiting messages on topic|Robot initialized')
        os.kill(bringup.pids()[victim], signal.SIGKILL)
        assert bringup.end() == 128 + signal.SIGKILL
        assert f'stopped because {victim} died of SIGKILL' in bringup.output.splitlines()[-1]
        assert sorted(bringup.pids()) == AT_ONCE
        assert bringup.left() == []


def test_a_stack_shares_no_memory_and_leaves_no_port(tmp_path):
    with stack(tmp_path, 'simulation', 'viewer:=false') as bringup:
        up(bringup, 'create-3', 'spawner-4')
        # Programs of this package share no memory: a reader that is killed could hold them up.
        assert shared_memory(bringup.left()) == set()
        ports = udp_ports(bringup.left())
        assert ports
        assert bringup.end(signal.SIGINT) == 0
        assert 'escalating' not in bringup.output
        assert ports.isdisjoint(bound_udp_ports())


def test_a_killed_simulator_stops_the_stack(tmp_path):
    with stack(tmp_path, 'simulation', 'viewer:=false') as bringup:
        up(bringup, 'create-3', 'spawner-4')
        os.kill(bringup.pids()['mujoco_sim-1'], signal.SIGKILL)
        assert bringup.end() == 128 + signal.SIGKILL
        assert 'stopped because mujoco_sim-1 died of SIGKILL' in bringup.output
        assert 'escalating' not in bringup.output
        assert bringup.left() == []


def test_the_wheels_stop_when_the_orchestrator_is_killed(tmp_path):
    with BoardOnPty(tmp_path / 'board') as plugged:
        board = plugged.board
        with stack(tmp_path, 'serial', f'port:={tmp_path}/board', 'viewer:=false') as bringup:
            up(bringup, 'spawner-3')
            with Program(
                sys.executable, '-m', 'amr_description.cli', 'ros2', 'topic', 'pub', *DRIVE
            ):
                assert board.comes(lambda: board.left.target > 0 and board.right.target > 0)
                pids = bringup.left()
                bringup.signal(signal.SIGKILL)
                assert all(ends(pid) for pid in pids)
        assert board.comes(lambda: board.mode is not BoardMode.ARMED)
        assert board.left.target == board.right.target == 0.0


def shared_memory(pids):
    """The segments of Fast DDS that the processes have mapped, but ports, which others share."""
    texts = (Path(f'/proc/{pid}/maps').read_text() for pid in pids)
    return {path for text in texts for path in re.findall(r'/dev/shm/fastrtps_[0-9a-f]{16}', text)}


def udp_ports(pids):
    """The inodes of the UDP sockets that the processes hold."""
    links = (os.readlink(fd) for pid in pids for fd in Path(f'/proc/{pid}/fd').iterdir())
    found = (re.fullmatch(r'socket:\[(\d+)\]', link) for link in links)
    sockets = {int(socket[1]) for socket in found if socket}
    return sockets & bound_udp_ports()


def bound_udp_ports():
    """The inodes of all UDP sockets of this machine."""
    return set().union(*udp_sockets().values())
