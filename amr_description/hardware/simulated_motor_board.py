# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulated motor board: what its firmware answers, and how its two motors turn.

Bytes in, bytes out, and time as an argument; :mod:`amr_description.nodes.motor_board` adds a
pseudo-terminal and a clock.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math

from amr_description.hardware.serial_protocol import (
    Answer,
    Arm,
    Board,
    BoardMode,
    Disarm,
    encode,
    Error,
    Hello,
    LineReader,
    LONGEST_WATCHDOG,
    Message,
    Reason,
    Refused,
    Set,
    SHORTEST_WATCHDOG,
    State,
    VERSION,
)


@dataclass(frozen=True, slots=True)
class MotorConstants:
    """
    A motor with its speed controller, and the encoder on its shaft.

    The speed follows its target: dω/dt = (target − ω) / ``time_constant``, limited to
    ``acceleration``.
    """

    time_constant: float = 0.05
    """s."""
    acceleration: float = 50.0
    """rad/s²."""
    velocity: float = 30.0
    """Greatest target, rad/s."""
    ticks: int = 4096
    """Of the encoder, per turn of the shaft."""


class Motor:
    """One side: its velocity follows ``target``."""

    def __init__(self, constants: MotorConstants) -> None:
        self._constants = constants
        self.target = self.velocity = self.position = 0.0
        """rad/s, rad/s and rad since the start."""

    def advance(self, dt: float) -> None:
        """Turn for ``dt`` s; exact for any ``dt`` unless the acceleration is limited."""
        limits = self._constants
        change = (self.target - self.velocity) * -math.expm1(-dt / limits.time_constant)
        most = limits.acceleration * dt
        before = self.velocity
        self.velocity += min(most, max(-most, change))
        self.position += (before + self.velocity) / 2.0 * dt

    @property
    def ticks(self) -> int:
        """The count of the encoder, a signed number of 32 bits."""
        count = math.floor(self.position / math.tau * self._constants.ticks)
        return (count + 2**31) % 2**32 - 2**31


class SimulatedMotorBoard:
    """The board of :mod:`amr_description.hardware.serial_protocol`."""

    def __init__(
        self,
        report: Callable[[str], None] = lambda line: None,
        constants: MotorConstants = MotorConstants(),
        name: str = 'simulated',
    ) -> None:
        """
        Start in IDLE.

        Args:
            report: called with a line for every change: armed, stopped by the watchdog, …
            constants: of both motors.
            name: of the board.
        """
        self.mode = BoardMode.IDLE
        self.left, self.right = Motor(constants), Motor(constants)
        self._report = report
        self._constants = constants
        self._name = name
        self._lines = LineReader()
        self._uptime = self._last_set = 0.0
        self._watchdog = 0

    def fail(self) -> None:
        """Go to FAULT, as when a motor takes too much current."""
        self._enter(BoardMode.FAULT, 'a fault: the motors stop')

    def advance(self, dt: float) -> None:
        """Let ``dt`` s pass for the watchdog and the motors."""
        self._uptime += dt
        if self.mode is BoardMode.ARMED and (self._uptime - self._last_set) * 1e3 > self._watchdog:
            self._enter(BoardMode.TIMEOUT, f'no SET for {self._watchdog} ms: the motors stop')
        for motor in (self.left, self.right):
            motor.advance(dt)

    def receive(self, data: bytes) -> bytes:
        """Take received bytes; return those to send."""
        return b''.join(encode(self._answer(message)) for message in self._lines.feed(data))

    def _answer(self, message: Message | Refused) -> Answer:
        """Carry out a message, if that is valid, and return the answer."""
        match message:
            case Refused(reason=reason):
                return Error(reason)
            case Hello(number):
                limits = self._constants
                return Board(number, VERSION, self._name, limits.ticks, limits.velocity)
            case Arm(watchdog=watchdog):
                if not SHORTEST_WATCHDOG <= watchdog <= LONGEST_WATCHDOG:
                    return Error(Reason.RANGE)
                self._arm(watchdog)
            case Set(left=left, right=right):
                if max(abs(left), abs(right)) > self._constants.velocity:
                    return Error(Reason.RANGE)
                self._set(left, right)
            case Disarm():
                self._enter(BoardMode.IDLE, 'disarmed')
            case Board() | State() | Error():
                return Error(Reason.MESSAGE)  # its own messages: the host echoes them
        return self._state(message.number)

    def _arm(self, watchdog: int) -> None:
        if self.mode is not BoardMode.FAULT:
            self._watchdog = watchdog
            self._last_set = self._uptime
            self._enter(BoardMode.ARMED, f'armed; the watchdog waits {watchdog} ms')

    def _set(self, left: float, right: float) -> None:
        if self.mode in (BoardMode.ARMED, BoardMode.TIMEOUT):
            self._enter(BoardMode.ARMED, 'a SET came: the motors go on')
            self._last_set = self._uptime
            self.left.target, self.right.target = left, right

    def _enter(self, mode: BoardMode, line: str) -> None:
        """Change the mode and stop the motors; a target is set afterwards."""
        if mode is not self.mode:
            self._report(line)
        self.mode = mode
        self.left.target = self.right.target = 0.0

    def _state(self, number: int) -> State:
        left, right = self.left, self.right
        return State(
            number,
            round(self._uptime * 1e3) % 2**32,
            left.ticks,
            right.ticks,
            left.velocity,
            right.velocity,
            self.mode,
        )
