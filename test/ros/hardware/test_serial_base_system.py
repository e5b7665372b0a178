# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/SerialBaseSystem against a board on a pseudo-terminal: connect, drive, stop.

Boards that go away: ``test_serial_base_losses.py``.
"""

from contextlib import suppress
import errno
from itertools import groupby
import math
from pathlib import Path
import threading
import time
from types import SimpleNamespace

from hypothesis import given, strategies as st
import pytest
import serial
from support.control_fakes import FakeLog, MS
from support.motor_boards import BoardOnPty, on_motor_board, SIDES, TamperedBoard
from support.serial_rig import descriptors, drive, PATIENCE, Rig, threads
from support.waiting import until

from amr_description.errors import HardwareDeactivationError, HardwareError
from amr_description.hardware import HARDWARE, serial_link
from amr_description.hardware.serial_base_system import SerialBaseSystem
from amr_description.hardware.serial_link import SerialLink
from amr_description.hardware.serial_protocol import (
    Arm,
    Board,
    BoardMode,
    Disarm,
    encode,
    Get,
    Hello,
    LineReader,
    Refused,
    Set,
    State,
)
from amr_description.hardware.simulated_motor_board import MotorConstants
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse


class Wire:
    """Replaces SerialBoard, and records the velocities that are sent."""

    description = Board(1, 1, 'none', 4096, 30.0)

    def __init__(self, _parameters, _component):
        self.sent = []

    def ask(self, _kind, *_values):
        return State(1, 0, 0, 0, 0.0, 0.0, BoardMode.ARMED)

    def post(self, _kind, left, right):
        self.sent.append((left, right))


# --- what it is ----------------------------------------------------------------------------------


def test_found_by_its_name():
    assert HARDWARE.find('amr_description/SerialBaseSystem') is SerialBaseSystem


def test_interfaces_are_those_of_the_tag_in_its_order():
    rig = Rig('/dev/nowhere')
    joints = [joint.name for joint in rig.system.info.joints]
    assert list(rig.commands) == [f'{joint}/velocity' for joint in joints]
    assert list(rig.states) == [f'{j}/{i}' for j in joints for i in ('position', 'velocity')]


@pytest.mark.parametrize(
    ('parameters', 'text'),
    [
        ({'port': ''}, "parameter 'port' must not be empty"),
        ({'baud_rate': 'fast'}, "parameter 'baud_rate' must be of type integer, found 'fast'"),
        ({'baud_rate': '0'}, "parameter 'baud_rate' must be at least 1, found 0 bit/s"),
        ({'max_velocity': '0'}, "parameter 'max_velocity' must be greater than 0, found 0.0"),
        ({'max_velocity': 'nan'}, "parameter 'max_velocity' must be a finite number, found nan"),
        ({'left_reduction': '0'}, "parameter 'left_reduction' must not be zero"),
        ({'watchdog_timeout': '6'}, "parameter 'watchdog_timeout' must be at most 5, found 6.0 s"),
        ({'left_joints': ''}, "parameter 'left_joints' must not be empty"),
        (
            {'left_joints': 'wheel'},
            r'left_joints \(wheel\) and right_joints \(joint_wheel_front_right, joint_wheel_back_r'
            r'ight\) must name each joint of the block once; it has joint_wheel_front_left, ',
        ),
        ({'left_joints': SIDES['right_joints']}, '.*must name each joint of the block once; it'),
    ],
)
def test_an_invalid_parameter_is_reported(parameters, text):
    with pytest.raises(HardwareError, match=f"^hardware component 'AmrSystem': {text}"):
        Rig(**{'port': '/dev/nowhere', **parameters})


def test_an_unknown_parameter_is_warned_of():
    (line,) = Rig('/dev/nowhere', max_velcity='3').log.texts(Severity.WARN)
    assert line.startswith("hardware component 'AmrSystem': parameter 'max_velcity' has no effect")
    assert 'Known: port, left_joints' in line


def test_lists_may_have_commas():
    rig = Rig('/dev/nowhere', left_joints='joint_wheel_front_left,joint_wheel_back_left')
    assert len(rig.commands) == 4


def test_a_sensor_of_the_tag_is_warned_of():
    sensor = '<sensor name="imu"><state_interface name="x"/></sensor></ros2_control>'
    text = on_motor_board('/dev/nowhere').replace('</ros2_control>', sensor)
    (info,) = hardware_of(parse(text))
    log = FakeLog()
    SerialBaseSystem(info, log)
    assert ["sensor 'imu' is not on the motor board" in line for line in log.texts()] == [True]


# --- connecting ----------------------------------------------------------------------------------


def fails_to_connect(match, port, **parameters):
    before = descriptors()
    with pytest.raises(HardwareError, match=match):
        Rig(port, **parameters).system.configure()
    assert threads() == []
    assert descriptors() == before


@pytest.mark.parametrize('port', ['/dev/null', '/dev', __file__])
def test_a_file_that_is_not_a_serial_port_is_refused(port):
    fails_to_connect(f"^cannot open the serial port '{port}': it is not a serial port$", port)


def test_a_port_that_is_not_there_is_refused_with_those_that_are():
    fails_to_connect("'/dev/nope': there is no such file.*Ports that are there: ", '/dev/nope')


def test_a_port_without_permission_is_refused_with_the_group_to_join(plugged, monkeypatch):
    def refuse(path, *_args, **_keywords):
        raise PermissionError(errno.EACCES, 'Permission denied')

    monkeypatch.setattr(serial.serialposix.os, 'open', refuse)  # root may open everything
    group = Path(plugged.port).group()
    match = f'permission denied; join its group.*sudo usermod -aG {group} [$]USER$'
    with pytest.raises(HardwareError, match=match):
        Rig(plugged.port).system.configure()


def test_a_port_that_another_program_has_is_refused(rig, plugged, board):
    with pytest.raises(HardwareError, match='another program has it; end that one, or give'):
        Rig(plugged.port).system.configure()
    drive(rig, board)  # undisturbed


def test_a_port_without_an_answer_is_refused(plugged, board):
    board.is_deaf = True
    fails_to_connect(
        f'no motor board answered on {plugged.port} at 9600 bit/s within 0.15 s; what came '
        'instead: nothing; check port, baud_rate and',
        plugged.port,
        connect_timeout=0.15,
        baud_rate=9600,
    )


def test_noise_at_the_port_is_shown(plugged, board, monkeypatch):
    board.tamper = lambda answer: b'$GPGGA,0*00\n' if answer else b''
    wait_for = SerialLink.wait_for

    def wait_after_noise(link, condition, timeout):
        # The thread of the board may get no processor within so short a timeout.
        until(lambda: link.status.refused)
        return wait_for(link, condition, timeout)

    monkeypatch.setattr(SerialLink, 'wait_for', wait_after_noise)
    fails_to_connect(
        r"what came instead: \d lines such as b'[$]GPGGA,0\*00'; check",
        plugged.port,
        connect_timeout=0.15,
    )


def test_a_board_of_another_version_is_refused(plugged, monkeypatch):
    monkeypatch.setattr('amr_description.hardware.simulated_motor_board.VERSION', 2)
    fails_to_connect('speaks version 2 of the protocol, version 1 is needed; upd', plugged.port)


def test_a_board_without_encoders_is_refused():
    with BoardOnPty(board=TamperedBoard(MotorConstants(ticks=0))) as plugged:
        fails_to_connect('says that its encoders have 0 ticks', plugged.port)


def test_a_board_that_is_slow_to_start_is_waited_for(plugged, board):
    answers = iter([b'ets Jul 29 2019\nrst:0x1', b'\n'])
    board.tamper = lambda answer: next(answers, answer) if answer else b''
    rig = Rig(plugged.port)
    rig.start()
    rig.system.cleanup()


def test_answers_to_an_earlier_host_are_ignored(plugged, board):
    with Path(plugged.port).open('wb') as earlier:
        for _ in range(100):
            earlier.write(encode(Hello(1, 1)) + encode(Get(1)))
    until(lambda: len(received(board)) == 200)
    board.left.position = 1000.0
    rig = Rig(plugged.port)
    rig.system.configure()
    assert rig.system._state.left_ticks == board.left.ticks
    rig.system.cleanup()


# --- driving -------------------------------------------------------------------------------------


def test_wheels_turn_as_commanded_and_have_states(rig, board):
    drive(rig, board, 5.0, -3.0)
    assert (board.left.target, board.right.target) == (5.0, -3.0)
    rig.turn_until(lambda: rig.state('position')[0] > 1.0, board)
    left, right = rig.state('position')
    assert right / left == pytest.approx(-3.0 / 5.0, rel=0.05)


def test_reads_the_encoders_while_inactive(plugged, board):
    rig = Rig(plugged.port)
    rig.system.configure()
    assert rig.state('position') == rig.state('velocity') == (0.0, 0.0)
    board.left.position += 1.0  # pushed by hand
    rig.turn_until(lambda: rig.state('position')[0] > 0.99)
    assert Set not in {type(message) for message in received(board)}
    rig.system.cleanup()


def test_a_gear_and_a_mirrored_motor_are_undone(plugged, board):
    rig = Rig(plugged.port, left_reduction=3.0, right_reduction=-2.0)
    rig.start()
    drive(rig, board, 5.0, 4.0)
    assert (board.left.target, board.right.target) == (15.0, -8.0)
    rig.system.cleanup()


def test_too_fast_keeps_the_curve(plugged, board):
    rig = Rig(plugged.port, max_velocity=10.0)
    rig.start()
    rig.command(40.0, -20.0)
    rig.turn_until(lambda: rig.state('velocity') == (10.0, -5.0), board)
    assert 'commanded 40 rad/s, they may turn at 10: both' in rig.log.texts(Severity.WARN)[0]
    rig.system.cleanup()


def test_the_board_may_allow_less(plugged, board):
    rig = Rig(plugged.port, max_velocity=1000.0, left_reduction=7.3)
    rig.start()
    rig.command(1e300, 1e300)
    expected = pytest.approx((30.0 / 7.3, 30.0 / 7.3), abs=1e-4)
    rig.turn_until(lambda: rig.state('velocity') == expected, board)
    assert rig.system._board._link.status.errors == 0
    rig.system.cleanup()


def test_no_command_is_no_command(rig, board):
    drive(rig, board, 5.0, 5.0)
    rig.command(math.nan, 2.0)
    rig.turn_until(lambda: rig.state('velocity') == (5.0, 2.0), board)


@given(
    st.lists(st.floats(), min_size=4, max_size=4),
    st.floats(0.1, 100.0),
    st.floats(0.1, 50.0) | st.floats(-50.0, -0.1),
)
def test_whatever_is_commanded_the_wire_carries_finite_and_bounded_speeds(values, most, gear):
    rig = Rig('/dev/nowhere', max_velocity=most, left_reduction=gear)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr('amr_description.hardware.serial_base_system.SerialBoard', Wire)
        rig.start()
    for wish, (name, command) in zip(values, rig.commands.items(), strict=True):
        command.value = values[0] if 'left' in name else wish
    with suppress(HardwareDeactivationError):
        rig.system.write(0, 10 * MS)
    for left, right in rig.system._board.sent:
        assert encode(Set(1, left, right))
        assert max(abs(left), abs(right)) <= 30.0 * (1 + 1e-12)
        assert max(abs(left / gear), abs(right)) <= most * (1 + 1e-12)


@pytest.mark.parametrize('bad', [math.inf, -math.inf])
def test_nothing_infinite_reaches_the_wire(rig, board, bad):
    drive(rig, board)
    rig.command(1.0, bad)
    with pytest.raises(HardwareDeactivationError, match='a finite number is needed'):
        rig.turn()
    rig.system.deactivate()
    assert board.mode is BoardMode.IDLE
    assert {(m.left, m.right) for m in received(board) if isinstance(m, Set)} <= {(5.0, -3.0)}


def test_wheels_of_a_side_must_be_commanded_alike(rig):
    rig.command(1.0, 1.0)
    rig.commands['joint_wheel_back_left/velocity'].value = 2.0
    with pytest.raises(HardwareDeactivationError, match='differ, but one motor turns both'):
        rig.turn()


def test_a_side_whose_claims_change_stops(rig, board):
    drive(rig, board, 5.0, 3.0)
    rig.system.perform_command_mode_switch([], [n for n in rig.commands if 'left' in n])
    rig.turn_until(lambda: rig.state('velocity') == (0.0, 3.0), board)


def test_a_command_from_before_an_arm_moves_nothing_after_it(rig, board):
    drive(rig, board)
    board.tamper = lambda answer: b''
    board.received.clear()
    while len(received(board)) < 2:
        rig.system.write(0, 10 * MS)
    rig.system.write(0, 10 * MS)  # waits, as two have no answer yet
    board.tamper = lambda answer: answer
    rig.system.deactivate()
    rig.system.activate()
    armed_at = board._uptime
    until(lambda: board._uptime > armed_at + 0.1)  # a lost answer is given up after 50 ms
    # A question is repeated where the answer is late.
    kinds = [kind for kind, _ in groupby(map(type, received(board)))]
    assert kinds[-2:] == [Disarm, Arm]


def test_a_line_that_is_stuck_is_not_filled_with_commands(rig, board):
    """They would arrive too late."""
    drive(rig, board)
    board.tamper = lambda answer: b''
    board.received.clear()
    rig.answer_within(0.25)
    begin = time.monotonic()
    with pytest.raises(HardwareError, match='has not told its state'):
        rig.turn_until(lambda: False)
    # At first two, then one each 50 ms until it gives up: after 250 ms, or later where it has to
    # wait for a processor.
    most = 3 + (time.monotonic() - begin) / 0.05
    until(lambda: Disarm in map(type, received(board)))  # the last that the link has sent
    assert 2 <= len([m for m in received(board) if isinstance(m, Set)]) <= most


def test_a_program_that_was_stopped_for_a_while_goes_on(plugged, board, monkeypatch):
    now = 0.0  # of the link, s: nothing else takes time
    monkeypatch.setattr(serial_link, 'time', SimpleNamespace(monotonic=lambda: now))
    rig = Rig(plugged.port)
    rig.start()
    port, has_gone_on = rig.system._board._link._serial, threading.Event()
    read = port.read

    def stop(size):
        nonlocal now
        if rig.system._board._link._asked_at is None:
            return read(size)
        now += 60.0  # more than the link waits for an answer
        port.read = go_on
        return b''

    def go_on(size):
        port.read = read
        has_gone_on.set()
        return read(size)

    port.read = stop
    rig.system.write(0, 10 * MS)
    assert has_gone_on.wait(PATIENCE)
    drive(rig, board)
    rig.system.cleanup()


def received(board):
    return [m for m in LineReader().feed(bytes(board.received)) if not isinstance(m, Refused)]


# --- stopping ------------------------------------------------------------------------------------


def test_deactivating_stops_the_motors(rig, board):
    drive(rig, board)
    rig.system.deactivate()
    assert (board.mode, board.left.target, board.right.target) == (BoardMode.IDLE, 0.0, 0.0)
    assert type(received(board)[-1]) is Disarm


def test_activating_again_begins_at_rest(rig, board):
    drive(rig, board)
    rig.system.deactivate()
    rig.system.activate()
    rig.turn_until(lambda: rig.state('velocity') == (0.0, 0.0), board)
    assert all(math.isnan(command.value) for command in rig.commands.values())


def test_a_control_thread_that_hangs_is_stopped_by_the_watchdog_and_may_go_on(plugged, board):
    rig = Rig(plugged.port, watchdog_timeout=0.05)
    rig.start()
    drive(rig, board)
    until(lambda: board.mode is BoardMode.TIMEOUT)
    assert board.left.target == 0.0
    drive(rig, board)
    rig.system.cleanup()


@pytest.mark.parametrize(
    'steps',
    [
        ['cleanup'],
        ['deactivate', 'cleanup', 'cleanup'],
        ['configure', 'cleanup'],
        ['configure', 'configure', 'cleanup'],
        ['configure', 'activate', 'cleanup'],
        ['configure', 'activate', 'deactivate', 'deactivate', 'cleanup'],
        ['configure', 'activate', 'deactivate', 'activate', 'deactivate', 'cleanup', 'shutdown'],
    ],
)
def test_nothing_is_left_whatever_the_order(plugged, steps):
    rig, before = Rig(plugged.port), descriptors()
    for step in steps:
        getattr(rig.system, step)()
    assert threads() == []
    assert descriptors() == before


@pytest.mark.parametrize('step', ['activate', 'turn'])
def test_without_a_board_read_and_write_fail(step):
    rig = Rig('/dev/nowhere')
    with pytest.raises(HardwareError, match='board on /dev/nowhere is not connected'):
        (rig.turn if step == 'turn' else rig.system.activate)()
