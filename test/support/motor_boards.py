# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulated motor board behind a pseudo-terminal, with faults; and a robot on it."""

from contextlib import ExitStack
from threading import Condition, Event, Thread

from support.paths import ROOT
from support.running_programs import PATIENCE

from amr_description.bringup.stacks.hardware import swap_hardware
from amr_description.hardware.simulated_motor_board import MotorConstants, SimulatedMotorBoard
from amr_description.nodes.motor_board import linked, PseudoTerminal, serve

AMR = (ROOT / 'urdf' / 'amr.urdf').read_text()
SIDES = {
    'left_joints': 'joint_wheel_front_left joint_wheel_back_left',
    'right_joints': 'joint_wheel_front_right joint_wheel_back_right',
}
SLOW_MACHINE = {'answer_timeout': 5.0, 'connect_timeout': 10.0}
"""s; the board is a thread or a process here, which others may delay."""
QUICK = MotorConstants(time_constant=0.001, acceleration=1e5)


def on_motor_board(port, **parameters):
    """Return the shipped description, driven by a motor board on a serial port."""
    given = {'port': port, **SIDES, **SLOW_MACHINE, **parameters}
    texts = {name: str(value) for name, value in given.items()}
    return swap_hardware(AMR, 'amr_description/SerialBaseSystem', texts)


class TamperedBoard(SimulatedMotorBoard):
    """Records what it receives; ``tamper`` changes its answers, ``is_deaf`` drops questions."""

    def __init__(self, constants=QUICK):
        self.reports = []
        super().__init__(self.reports.append, constants)
        self.received = bytearray()
        self.tamper = lambda answer: answer
        self.is_deaf = False
        self.answered = Event()
        self._moved = Condition()

    def receive(self, data):
        self.received += data
        answer = self.tamper(super().receive(b'' if self.is_deaf else data))
        if data:
            self.answered.set()
        return answer

    def advance(self, dt):
        super().advance(dt)
        with self._moved:
            self._moved.notify_all()

    def comes(self, condition):
        """Wait, without taking time from the board's thread; return whether it came."""
        with self._moved:
            return self._moved.wait_for(condition, PATIENCE)


class BoardOnPty:
    """
    The board on its port; plugged in as long as the ``with`` lasts, or until :meth:`unplug`.

    ``link``: a Path; the port is then reached by this name.
    """

    def __init__(self, link=None, board=None):
        self.board = board or TamperedBoard()
        self._exits = ExitStack()
        terminal = self._exits.enter_context(PseudoTerminal())
        self.port = terminal.port
        if link is not None:
            self._exits.enter_context(linked(link, self.port))
        unplugged = Event()
        thread = Thread(target=serve, args=(self.board, terminal.line, unplugged.is_set))
        self._exits.callback(thread.join)
        self._exits.callback(unplugged.set)
        thread.start()

    def unplug(self):
        """Gone, as when its cable is pulled; returns when it is."""
        self._exits.close()

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self.unplug()
