# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The executable motor_board, and the shipped robot driven by it, without ROS."""

import math
import os
from pathlib import Path
import signal
import stat
import tempfile
import threading
import time

import pytest
from support.control_fakes import collect, FakeLog, LEFT, MS, RIGHT, start
from support.motor_boards import on_motor_board
from support.needs import need
from support.running_programs import PATIENCE, Program

from amr_description.control.contracts import ControllerContext
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.samples import TwistSample
from amr_description.control.switching import Strictness
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.nodes import motor_board
from amr_description.parameters import build

NAME = 'AmrSystem'


# The program, but it waits for its host, which may have to wait for a processor.
PATIENT = f"""
import sys
from amr_description.nodes import motor_board
motor_board._GRACE = {PATIENCE}
sys.exit(motor_board.main())
"""


def run_board(link):
    """Run the program; wait for its port."""
    return at_work(Program.module('motor_board', '--link', str(link)), link)


def at_work(program, link):
    """Wait for its port."""
    program.expect(f'motor_board: on /dev/pts/[0-9]+, linked as {link}\n')
    return program


# --- the program ---------------------------------------------------------------------------------


@pytest.mark.parametrize('signum', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_ends_on_request_and_removes_its_link(tmp_path, signum):
    link = tmp_path / 'folder' / 'board'
    with run_board(link) as program:
        assert stat.S_ISCHR(link.stat().st_mode)
        assert program.end(signum) == 0
        assert len(program.lines) == 1
    assert list(link.parent.iterdir()) == []


def test_replaces_what_a_killed_one_left(tmp_path):
    link = tmp_path / 'board'
    with run_board(link) as program:
        program.end(signal.SIGKILL)
    assert link.is_symlink()
    with run_board(link) as program:
        assert link.exists()
        assert program.end(signal.SIGINT) == 0
    assert list(tmp_path.iterdir()) == []


def test_leaves_a_link_that_another_board_has_taken_over(tmp_path):
    link = tmp_path / 'board'
    with motor_board.linked(link, '/dev/pts/1'):
        with motor_board.linked(link, '/dev/pts/2'):
            assert os.readlink(link) == '/dev/pts/2'
            link.unlink()
            link.symlink_to('/dev/pts/3')
        assert os.readlink(link) == '/dev/pts/3'


@pytest.mark.parametrize(
    'make', [Path.touch, Path.mkdir, lambda path: path.symlink_to('/dev/ttyS0')]
)
def test_replaces_nothing_that_is_not_its_own(tmp_path, make, capsys):
    link = tmp_path / 'board'
    make(link)
    assert motor_board.main(['--link', str(link)]) == 2
    assert capsys.readouterr().err == (
        f"motor_board: '{link}' is there, and no link of a motor board; give another --link\n"
    )
    assert os.path.lexists(link)


def test_a_link_that_cannot_be_made_is_reported(capsys):
    assert motor_board.main(['--link', '/proc/board']) == 2
    assert "cannot make the link '/proc/board' (" in capsys.readouterr().err


@pytest.mark.parametrize(
    ('owner', 'mode', 'reason'),
    [
        (None, 0o777, 'others may write to'),
        (65534, 0o777, 'belongs to the user 65534'),
        (65534, 0o700, 'belongs to the user 65534'),
    ],
)
def test_a_folder_that_another_user_may_change_is_refused(
    tmp_path, monkeypatch, capsys, owner, mode, reason
):
    """He could replace the link, and be the motor board."""
    need(owner is None or os.geteuid() == 0, 'only root can give folders to another user')
    monkeypatch.delenv('XDG_RUNTIME_DIR', raising=False)
    monkeypatch.setattr(tempfile, 'gettempdir', lambda: str(tmp_path))
    folder = motor_board.default_link().parent
    folder.mkdir()
    folder.chmod(mode)
    if owner is not None:
        os.chown(folder, owner, owner)
    assert motor_board.main([]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"motor_board: cannot make the link '{motor_board.default_link()}': ")
    assert reason in line
    assert str(folder) in line
    assert not os.path.lexists(motor_board.default_link())


def test_the_port_has_a_name_without_being_given_one(monkeypatch):
    monkeypatch.setenv('XDG_RUNTIME_DIR', '/run/user/1')
    assert str(motor_board.default_link()) == '/run/user/1/amr_description/motor_board'
    monkeypatch.delenv('XDG_RUNTIME_DIR')
    assert motor_board.default_link().parent.name == f'amr_description-{os.getuid()}'


def test_takes_the_arguments_of_a_bring_up(tmp_path):
    command = ['--link', str(tmp_path / 'board'), '--ros-args', '-r', '__node:=board']
    with Program.module('motor_board', *command) as program:
        program.expect('linked as')
        assert program.end(signal.SIGINT) == 0


# --- the robot on it -----------------------------------------------------------------------------


class Robot:
    """The shipped robot with its drive controller and other hardware; cycles in real time."""

    period = 10 * MS

    def __init__(self, port):
        (info,) = hardware_of(parse(on_motor_board(port)))
        self.log = FakeLog()
        self.resources = ResourceManager(self.log)
        self.resources.add(HARDWARE.find(info.plugin)(info, self.log, None))
        self.resources.set_state(NAME, LifecycleState.ACTIVE)
        self.manager = ControllerManager(self.resources, 100, self.log)
        self.drive = DiffDriveController(ControllerContext('drive', self.log))
        parameters = build(
            DiffDriveParameters,
            {
                'left_wheel_names': LEFT,
                'right_wheel_names': RIGHT,
                'wheel_separation': 0.3,
                'wheel_radius': 0.1,
                'publish_rate': 1000.0,
            },
        )
        start(self.manager, self.drive, parameters)
        self.odometry = collect(self.drive.outputs()[0])
        self.time = 0

    def states(self):
        """Return the distinct velocities of the wheels, rad/s."""
        cells = self.resources.components[NAME].states
        return {round(cell.value, 3) for name, cell in cells.items() if name.endswith('velocity')}

    def commands(self):
        return [cell.value for cell in self.resources.components[NAME].commands.values()]

    def pose(self):
        return self.odometry[-1].x, self.odometry[-1].y, self.odometry[-1].heading

    def turn_until(self, condition, linear=0.0, angular=0.0):
        """Hold a twist (m/s, rad/s), at 100 Hz, until the condition holds."""
        deadline, tick = time.monotonic() + PATIENCE, threading.Event()
        while not condition():
            assert time.monotonic() < deadline, self.log.texts()
            self.time += self.period
            self.drive.inputs()[0].put(TwistSample(self.time, linear, angular))
            self.manager.tick(self.time)
            tick.wait(self.period / 1e9)

    @property
    def hardware(self):
        return self.resources.components[NAME].state

    @property
    def controller(self):
        return self.manager._controllers['drive'].state


@pytest.fixture
def robot(tmp_path):
    """Driving at 0.5 m/s on the program; ``robot.board`` is that."""
    link = tmp_path / 'board'
    with at_work(Program.of(PATIENT, '--link', str(link)), link) as program:
        robot = Robot(link)
        robot.board, robot.link = program, link
        robot.turn_until(lambda: any(o.x > 0.1 for o in robot.odometry), 0.5)
        yield robot
        robot.manager.shut_down(robot.time)
    assert not [thread for thread in threading.enumerate() if thread.name.startswith('serial')]


def test_drives_as_commanded(robot):
    wheels = {3.5, 6.5}  # (0.5 ∓ 1.0 · 0.3 / 2) / 0.1
    robot.turn_until(lambda: robot.states() == wheels, 0.5, 1.0)
    robot.turn_until(lambda: robot.pose()[2] > 0.5, 0.5, 1.0)
    assert robot.pose()[0] > 0.0 < robot.pose()[1]


def test_an_inactive_component_lets_the_board_disarm(robot):
    robot.manager.set_component_state(NAME, LifecycleState.INACTIVE, robot.time)
    robot.board.expect('motor_board: disarmed')
    robot.turn_until(lambda: robot.states() == {0.0})
    assert robot.controller is LifecycleState.INACTIVE


def test_a_control_thread_that_hangs_is_stopped_by_the_watchdog_and_may_go_on(robot):
    robot.board.expect('motor_board: no SET for 200 ms: the motors stop')
    far = robot.pose()[0] + 0.05
    robot.turn_until(lambda: robot.pose()[0] > far, 0.5)
    robot.board.expect('motor_board: a SET came: the motors go on')
    assert robot.controller is LifecycleState.ACTIVE


def test_is_not_unplugged_from_a_robot_that_is_shut_down_with_it(robot):
    """Ctrl-C goes to all programs of a bring-up at once."""
    robot.board.signal(signal.SIGINT)
    far = robot.pose()[0] + 0.05
    robot.turn_until(lambda: robot.pose()[0] > far, 0.5)
    robot.manager.shut_down(robot.time)
    assert robot.board.end() == 0
    assert robot.log.texts(Severity.ERROR) == []
    assert not robot.link.is_symlink()


@pytest.fixture
def port_number(robot):
    """
    Keep the number of the pseudo-terminal from others, while and after the board has it.

    The link of a board that was killed would lead to theirs.
    """
    port = os.open(robot.link, os.O_RDWR | os.O_NOCTTY)
    yield
    os.close(port)


@pytest.mark.usefixtures('port_number')
@pytest.mark.parametrize('signum', [signal.SIGTERM, signal.SIGKILL])
def test_unplugged_while_driving_and_plugged_in_again(robot, signum):
    robot.board.end(signum)
    robot.turn_until(lambda: robot.hardware is LifecycleState.UNCONFIGURED, 0.5)
    assert robot.controller is LifecycleState.INACTIVE
    assert all(math.isnan(command) or command == 0.0 for command in robot.commands())
    errors = [text for text in robot.log.texts(Severity.ERROR) if 'motor board' in text]
    assert [text.endswith(f'set_hardware_component_state {NAME} active') for text in errors] == [
        True
    ]
    pose = robot.pose()

    with pytest.raises(HardwareError, match='is no such file'):
        robot.manager.set_component_state(NAME, LifecycleState.ACTIVE, robot.time)
    with run_board(robot.link):
        robot.manager.set_component_state(NAME, LifecycleState.ACTIVE, robot.time)
        robot.manager.switch(['drive'], [], Strictness.STRICT, robot.time)
        robot.turn_until(lambda: len(robot.odometry) > 0)
        assert robot.pose() == pytest.approx(pose, abs=1e-3)  # its encoders began at zero
        robot.turn_until(lambda: robot.pose()[0] > pose[0] + 0.05, 0.5)
