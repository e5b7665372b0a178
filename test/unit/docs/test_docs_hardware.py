# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/write_your_own_hardware.md: its class drives, its test passes, its words are true."""

from contextlib import suppress
import inspect
import os
import re
import sys
import threading
import time

import pytest
from support.control_fakes import collect, FakeLog, MS, start
from support.paths import EXECUTABLES, ROOT

from amr_description.bringup.stacks import STACKS
from amr_description.control.contracts import ControllerContext, HardwareComponent
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.hardware.serial_base_system import SerialBaseSystem
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.parameters import build

PAGE = (ROOT / 'docs' / 'write_your_own_hardware.md').read_text()
PATIENCE = 20.0
"""s; a bound that only a broken test reaches."""


def blocks(language):
    return re.findall(rf'^```{language}\n(.*?)^```$', PAGE, re.DOTALL | re.MULTILINE)


CLASS, TEST = blocks('python')
TAG, BOARD_TAG = blocks('xml')
DESCRIPTION = f"""
<robot name="mine">
  <link name="base"/><link name="left"/><link name="right"/>
  <joint name="left_wheel" type="continuous"><parent link="base"/><child link="left"/></joint>
  <joint name="right_wheel" type="continuous"><parent link="base"/><child link="right"/></joint>
  {TAG}
</robot>
"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """The reader's package, where Python finds it."""
    (tmp_path / 'my_robot').mkdir()
    (tmp_path / 'my_robot' / 'my_base.py').write_text(CLASS)
    monkeypatch.syspath_prepend(tmp_path)
    yield
    for name in [name for name in sys.modules if name.split('.')[0] == 'my_robot']:
        del sys.modules[name]


def run(block):
    """Run a block of the page; return its names."""
    names = {}
    exec(compile(block, 'write_your_own_hardware.md', 'exec'), names)
    return names


def test_the_test_of_the_page_passes(package):
    before = {*threading.enumerate()}
    run(TEST)['test_wheels_turn_as_commanded'](DESCRIPTION)
    assert {*threading.enumerate()} <= before  # one of another test may have ended


class HeldBoard:
    """Its wheels are at 0.5 rad; it gives as many answers as ``answers`` has permits."""

    def __init__(self):
        self.questions, self.answers = [], threading.Semaphore(1)  # the one of configure

    def __call__(self, end):
        with suppress(OSError), os.fdopen(end, 'rb+', 0) as line:
            while question := line.readline():
                self.questions.append(question)
                assert self.answers.acquire(timeout=PATIENCE)
                line.write(b'0.5 0.5\n')


class Driven:
    """The reader's robot under the diff_drive_controller, on the board of the page's test."""

    def __init__(self, board=None):
        end, self.port = os.openpty()
        self.motors = threading.Thread(target=board or run(TEST)['board'], args=[end])
        self.motors.start()
        (info,) = hardware_of(parse(DESCRIPTION.replace('/dev/ttyUSB0', os.ttyname(self.port))))
        info.parameters['answer_timeout'] = '60'
        self.log = FakeLog()
        self.resources = ResourceManager(self.log)
        self.resources.add(HARDWARE.find(info.plugin)(info, self.log, None))
        self.resources.set_state('MyRobot', LifecycleState.ACTIVE)
        self.manager = ControllerManager(self.resources, 100, self.log)
        self.drive = DiffDriveController(ControllerContext('drive', self.log))
        table = {
            'left_wheel_names': ['left_wheel'],
            'right_wheel_names': ['right_wheel'],
            'wheel_separation': 0.3,
            'wheel_radius': 0.1,
        }
        start(self.manager, self.drive, build(DiffDriveParameters, table))
        self.odometry = collect(self.drive.outputs()[0])
        self.time = 0

    def turn_until(self, condition):
        """Drive forward at 0.5 m/s."""
        deadline, tick = time.monotonic() + PATIENCE, threading.Event()
        while not condition():
            assert time.monotonic() < deadline, self.log.texts()
            self.time += 10 * MS
            self.drive.inputs()[0].put(TwistSample(self.time, 0.5, 0.0))
            self.manager.tick(self.time)
            tick.wait(0.002)

    @property
    def state(self):
        return self.resources.components['MyRobot'].state

    def unplug(self):
        os.close(self.port)
        self.motors.join()


@pytest.fixture
def robot(package):
    before = {*threading.enumerate()}
    robot = Driven()
    yield robot
    robot.manager.shut_down(robot.time)
    if robot.motors.is_alive():
        robot.unplug()
    assert {*threading.enumerate()} <= before  # one of another test may have ended


def test_the_class_of_the_page_drives(robot):
    robot.turn_until(lambda: robot.odometry and robot.odometry[-1].x > 0.1)
    assert robot.odometry[-1].y == 0.0


def test_what_the_page_says_of_errors_is_true(robot):
    robot.turn_until(lambda: robot.odometry)
    hardware = robot.resources.components['MyRobot'].component
    hardware._fault = 'the board is lost (test); reconnect it'
    robot.turn_until(lambda: robot.state is LifecycleState.UNCONFIGURED)
    assert [line for line in robot.log.texts(Severity.ERROR) if 'reconnect it' in line]
    assert robot.manager._controllers['drive'].state is LifecycleState.INACTIVE
    robot.manager.set_component_state('MyRobot', LifecycleState.ACTIVE, robot.time)
    assert robot.state is LifecycleState.ACTIVE


@pytest.fixture
def held(package):
    """A robot whose board was asked for the second time and does not answer: (robot, board)."""
    board = HeldBoard()
    robot = Driven(board)
    robot.turn_until(lambda: len(board.questions) == 2)
    yield robot, board
    board.answers.release(1000)
    robot.manager.shut_down(robot.time)
    if robot.motors.is_alive():
        robot.unplug()


def test_a_late_answer_is_not_a_lost_board(held):
    robot, board = held
    before = robot.time
    robot.turn_until(lambda: robot.time == before + 500 * MS)  # 50 cycles that do not wait
    assert robot.state is LifecycleState.ACTIVE
    board.answers.release()
    robot.turn_until(lambda: len(board.questions) == 3)  # it goes on where it was
    assert robot.state is LifecycleState.ACTIVE
    assert robot.log.texts(Severity.WARN) == []


def test_a_silent_board_is_lost_and_the_error_says_how_long_it_was_silent(held):
    robot, board = held
    robot.resources.components['MyRobot'].component._serial.timeout = 0.01  # of the next answer
    board.answers.release()
    robot.turn_until(lambda: robot.state is LifecycleState.UNCONFIGURED)
    (line,) = [line for line in robot.log.texts(Severity.ERROR) if 'the board is lost' in line]
    assert 'the board is lost (silent for 0.01 s); reconnect it' in line


def test_bringing_it_down_stops_the_motors_and_does_not_wait_for_a_silent_board(held):
    robot, board = held
    robot.resources.set_state('MyRobot', LifecycleState.UNCONFIGURED)
    assert len(board.questions) == 2  # it has not answered
    board.answers.release(2)
    robot.unplug()
    assert board.questions[-1] == b'0 0\n'


def test_a_board_has_a_second_to_answer(package, monkeypatch):
    end, port = os.openpty()
    (info,) = hardware_of(parse(DESCRIPTION.replace('/dev/ttyUSB0', os.ttyname(port))))
    my_base = HARDWARE.find(info.plugin)
    monkeypatch.setattr(my_base, '_exchange', lambda self: None)  # the machine may be slower
    hardware = my_base(info, FakeLog(), None)
    hardware.configure()
    assert hardware._serial.timeout == 1.0
    hardware.cleanup()
    os.close(port)
    os.close(end)


def test_a_port_without_a_board_is_told(package):
    (info,) = hardware_of(parse(DESCRIPTION.replace('/dev/ttyUSB0', '/dev/nope')))
    with pytest.raises(HardwareError, match="no board on '/dev/nope' .*; is it plugged in"):
        HARDWARE.find(info.plugin)(info, FakeLog(), None).configure()


def test_the_class_is_short():
    assert CLASS.count('\n') < 80


def test_every_method_of_the_table_is_one_of_the_contract():
    named = re.findall(r'^\| `(\w+)` \|', PAGE, re.MULTILINE)
    assert len(named) == 7
    assert all(inspect.isfunction(getattr(HardwareComponent, name)) for name in named)


def test_every_file_of_the_page_is_there():
    links = re.findall(r'\]\((\.\./[^)]+)\)', PAGE)
    assert links
    assert all((ROOT / 'docs' / link).is_file() for link in links)


def test_every_executable_of_the_page_is_there():
    used = re.findall(r'ros2 run amr_description (\w+)', PAGE)
    assert used
    assert {*used} <= EXECUTABLES.keys()


def test_every_stack_of_the_page_is_there():
    assert (
        set(re.findall(r'ros2 launch amr_description (\w+)', PAGE)) == {'serial'} <= STACKS.keys()
    )


def test_the_block_for_the_shipped_robot_is_right():
    text = (ROOT / 'urdf' / 'amr.urdf').read_text()
    swapped = re.sub('<hardware>.*?</hardware>', BOARD_TAG, text, flags=re.DOTALL)
    (info,) = hardware_of(parse(swapped))
    log = FakeLog()
    assert isinstance(HARDWARE.find(info.plugin)(info, log, None), SerialBaseSystem)
    assert log.lines == []
