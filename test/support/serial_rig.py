# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""amr_description/SerialBaseSystem on a port, with cycles run by hand."""

import os
import threading
import time

from support.control_fakes import FakeLog, MS
from support.motor_boards import on_motor_board

from amr_description.hardware.serial_base_system import SerialBaseSystem
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse

PATIENCE = 20.0
"""s; a bound that only a broken test reaches."""


class Rig:
    """The component of the shipped robot on a port, with cycles run by hand."""

    def __init__(self, port, **parameters):
        (info,) = hardware_of(parse(on_motor_board(port, **parameters)))
        self.log = FakeLog()
        self.system = SerialBaseSystem(info, self.log)
        self.states = {s.name: s for s in self.system.state_interfaces()}
        self.commands = {c.name: c for c in self.system.command_interfaces()}

    def start(self):
        self.system.configure()
        self.system.activate()

    def answer_within(self, timeout):
        """Set the answer timeout, s, of the connected board."""
        self.system._board._link._answer_timeout = timeout

    def command(self, left, right):
        for name, command in self.commands.items():
            command.value = left if 'left' in name else right

    def turn(self):
        self.system.read(0, 10 * MS)
        if self.system._is_active:
            self.system.write(0, 10 * MS)

    def turn_until(self, condition, board=None):
        """Run cycles at the rate of the board's answers, or fast without answers."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline
            self.turn()
            if board is not None:
                board.answered.wait(0.01)
                board.answered.clear()

    def state(self, interface):
        """Return the states of the left and of the right joints."""
        values = {n: s.value for n, s in self.states.items() if n.endswith(interface)}
        sides = [{v for n, v in values.items() if side in n} for side in ('left', 'right')]
        assert [len(side) for side in sides] == [1, 1], 'joints of a side differ'
        return tuple(value for (value,) in sides)


def threads():
    return [thread for thread in threading.enumerate() if thread.name.startswith('serial')]


def descriptors():
    return len(os.listdir('/proc/self/fd'))


def drive(rig, board, left=5.0, right=-3.0):
    rig.command(left, right)
    rig.turn_until(lambda: rig.state('velocity') == (left, right), board)
