# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""amr_description/SerialBaseSystem with boards that fall silent, are unplugged or send noise."""

import pytest
import serial
from support.control_fakes import MS
from support.motor_boards import BoardOnPty
from support.serial_rig import drive, Rig, threads
from support.waiting import until

from amr_description.errors import HardwareError

REMEDY = 'check its cable and power, then: ros2 control set_hardware_component_state AmrSystem act'


# --- a board that goes away ----------------------------------------------------------------------


def is_lost(rig, board, match):
    """The fault is reported once, and the manager can bring the component down."""
    with pytest.raises(HardwareError, match=match) as caught:
        rig.turn_until(lambda: False, board)
    assert REMEDY in str(caught.value)
    assert '\n' not in str(caught.value)
    with pytest.raises(HardwareError, match=match):
        rig.system.read(0, 10 * MS)
    rig.system.deactivate()
    rig.system.cleanup()
    assert threads() == []


def test_unplugged(rig, board, plugged):
    drive(rig, board)
    plugged.unplug()
    is_lost(rig, board, f'^the motor board on {plugged.port} is gone, as if it were unplugged; ch')


def test_a_lost_board_cannot_be_written(rig, board, plugged):
    plugged.unplug()
    until(lambda: rig.system._board.is_lost)
    with pytest.raises(HardwareError, match='is gone, as if it were unplugged'):
        rig.system.write(0, 10 * MS)


def test_silent(rig, board):
    drive(rig, board)
    board.tamper = lambda answer: b''
    rig.answer_within(0.25)
    is_lost(rig, board, 'has not told its state for 0.25 s; check')


def test_deaf(rig, board):
    drive(rig, board)
    board.is_deaf = True
    rig.answer_within(0.25)
    is_lost(rig, board, 'has not told its state for 0.25 s; check')


def test_receives_only_noise(rig, board, monkeypatch):
    drive(rig, board)
    noise = b'$NOISE*0000\n'
    receive = board.receive
    monkeypatch.setattr(board, 'receive', lambda data: receive(noise if data else b''))
    rig.turn_until(lambda: rig.system._board._link.status.errors, board)
    rig.answer_within(0.25)
    is_lost(rig, board, r'has not told its state for 0.25 s, but refused \d+ lines \(CHECKSUM\);')


@pytest.mark.parametrize(
    ('error', 'text'),
    [
        (serial.SerialTimeoutException('Write timeout'), 'takes no more bytes; check'),
        (
            RuntimeError('a bug'),
            r'cannot be talked to \(RuntimeError: a bug \(test_ser.*\)\); check',
        ),
    ],
)
def test_cannot_be_written_to(rig, board, monkeypatch, error, text):
    def fail(_data):
        raise error

    drive(rig, board)
    monkeypatch.setattr(rig.system._board._link._serial, 'write', fail)
    is_lost(rig, board, text)


def test_sends_much_noise(rig, board):
    drive(rig, board)
    board.tamper = lambda answer: b'\x00noise\n' + answer if answer else b''
    is_lost(rig, board, r"sends noise: 2. of its last 100 lines were refused, the last one b'.x00")


def test_sends_noise_without_end(rig, board):
    drive(rig, board)
    board.tamper = lambda answer: b'x' * 10
    rig.answer_within(0.25)
    is_lost(rig, board, 'has not told its state for 0.25 s; check')


def test_sends_a_little_noise(rig, board):
    count = iter(range(10**9))
    board.tamper = lambda answer: answer + b'noise\n' * (next(count) % 10 == 0) if answer else b''
    rig.turn_until(lambda: rig.system._board._link.status.refused > 30, board)


def test_restarted(rig, board):
    drive(rig, board)
    last = 1000.0  # s, more than its thread may have to wait for a processor

    def set_uptime(answer):  # on the thread of the board, which counts on
        board._uptime = board._last_set = last
        board.tamper = lambda answer: answer
        return answer

    board.tamper = set_uptime
    rig.turn_until(lambda: rig.system._board.state.uptime >= last * 1000, board)
    last = 0.0
    board.tamper = set_uptime
    is_lost(rig, board, 'has restarted by itself, as after a power failure; check')


def test_the_clock_of_the_board_may_wrap(plugged, board):
    board._uptime = 2**32 / 1000 - 0.05
    rig = Rig(plugged.port)
    rig.start()
    rig.turn_until(lambda: board._uptime > 2**32 / 1000 + 0.05, board)
    rig.system.cleanup()


def test_disarms_its_motors(rig, board):
    drive(rig, board)
    board.fail()
    is_lost(rig, board, 'has let go of its motors: it is in the mode FAULT')


def test_a_board_with_a_fault_is_not_activated(plugged, board):
    rig = Rig(plugged.port)
    rig.system.configure()
    board.fail()
    with pytest.raises(
        HardwareError, match='does not arm its motors: it is in the mode FAULT; check'
    ):
        rig.system.activate()
    rig.system.cleanup()


def test_comes_back_and_positions_go_on(tmp_path):
    link = tmp_path / 'board'
    with BoardOnPty(link) as first:
        rig = Rig(link)
        rig.start()
        drive(rig, first.board)
        rig.turn_until(lambda: rig.state('position')[0] > 1.0, first.board)
        first.unplug()
        is_lost(rig, first.board, 'is gone')
    before = rig.state('position')
    with pytest.raises(HardwareError, match=f"'{link}': there is no such file"):
        rig.system.configure()
    with BoardOnPty(link) as second:
        second.board.left.position = second.board.right.position = 123.0
        rig.start()
        assert rig.state('position') == before
        drive(rig, second.board, 2.0, 2.0)
        rig.turn_until(lambda: rig.state('position')[0] > before[0] + 0.1, second.board)
        assert rig.state('position')[0] < before[0] + 2.0
        rig.system.cleanup()
