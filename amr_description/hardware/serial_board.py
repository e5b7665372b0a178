# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The host's conversation with a motor board: who is there, ask, wait, and what to do if not."""

from collections.abc import Callable
import itertools
import secrets

from amr_description.errors import HardwareError
from amr_description.hardware.serial_link import LinkStatus, SerialLink
from amr_description.hardware.serial_parameters import SerialParameters
from amr_description.hardware.serial_protocol import Board, Hello, Question, State, VERSION

_TRY = 0.1
"""s, about: after so long a question is asked again."""


class SerialBoard:
    """
    A board that has answered; ``close`` it.

    ``component``: the name of the hardware component, for the remedy that errors tell.
    """

    def __init__(self, parameters: SerialParameters, component: str) -> None:
        """Open the port and make the acquaintance. Raises HardwareError, the port closed."""
        self._parameters = parameters
        self._component = component
        # Not the numbers of the host before us, whose answers may wait in the line.
        self._numbers = itertools.count(secrets.randbelow(2**16))
        self._link = SerialLink(parameters.port, parameters.baud_rate, parameters.answer_timeout)
        try:
            self.description = self._meet()
        except Exception:
            self.close()
            raise

    def post(self, kind: type[Question], *values: float) -> int:
        """
        Have a question of this kind sent, without waiting; return its number.

        Raises HardwareError if the board is lost.
        """
        self._raise_if_lost(self._link.status)
        number = next(self._numbers) % 2**16
        self._link.post(kind(number, *values))
        return number

    @property
    def state(self) -> State | None:
        """The last state that it told, None before the first. Raises HardwareError if lost."""
        status = self._link.status
        self._raise_if_lost(status)
        return status.state

    @property
    def is_lost(self) -> bool:
        """True when the link has ended by itself."""
        return bool(self._link.status.fault)

    def ask(self, kind: type[Question], *values: int) -> State:
        """
        Ask, again where an answer got lost, and block until the state is told.

        Raises HardwareError where it is not within ``answer_timeout``.
        """
        timeout = self._parameters.answer_timeout
        status = self._exchange(lambda status: status.state, timeout, kind, *values)
        if status is None:
            raise self.lost(f'has not answered {kind.__name__.upper()} within {timeout:g} s')
        return status.state

    def lost(self, fault: str) -> HardwareError:
        """Return the error that says so; ``fault`` is the end of its sentence."""
        return HardwareError(
            f'the motor board on {self._link.port} {fault}; check its cable and power, then: ros2 '
            f'control set_hardware_component_state {self._component} active'
        )

    def close(self) -> None:
        """Send what was posted, and close the port."""
        self._link.close()

    def _meet(self) -> Board:
        timeout = self._parameters.connect_timeout
        status = self._exchange(lambda status: status.board, timeout, Hello, VERSION)
        if status is not None:
            return self._accepted(status.board)
        status = self._link.status
        came = f'{status.refused} lines such as {status.last_refused!r}'
        raise HardwareError(
            f'no motor board answered on {self._link.port} at {self._parameters.baud_rate} bit/s '
            f'within {timeout:g} s; what came instead: {came if status.refused else "nothing"}; '
            'check port, baud_rate and the power of the board'
        )

    def _exchange(
        self,
        answer_of: Callable[[LinkStatus], Board | State | None],
        timeout: float,
        kind: type[Question],
        *values: int,
    ) -> LinkStatus | None:
        """Ask again and again until there is the answer; None when there is none in time."""
        tries = max(1, round(timeout / _TRY))
        for _ in range(tries):
            number = self.post(kind, *values)

            def is_answered(status: LinkStatus, number: int = number) -> bool:
                answer = answer_of(status)
                return answer is not None and answer.number == number

            status = self._link.wait_for(is_answered, timeout / tries)
            self._raise_if_lost(status)
            if is_answered(status):
                return status
        return None

    def _accepted(self, board: Board) -> Board:
        if board.version != VERSION:
            raise HardwareError(
                f'the motor board on {self._link.port} speaks version {board.version} of the '
                f'protocol, version {VERSION} is needed; update its firmware or this package'
            )
        if not (board.ticks > 0 and board.velocity > 0.0):
            raise HardwareError(
                f'the motor board on {self._link.port} says that its encoders have {board.ticks} '
                f'ticks and its motors turn at {board.velocity} rad/s at most; both must be '
                'positive: set up its firmware'
            )
        return board

    def _raise_if_lost(self, status: LinkStatus) -> None:
        if status.fault:
            raise self.lost(status.fault)
