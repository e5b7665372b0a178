# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A serial port with a thread of its own, which alone reads and writes it.

The owner posts messages and looks at :attr:`SerialLink.status`, an immutable snapshot; neither
blocks. Only :meth:`SerialLink.wait_for` does, for transitions, and never longer than it is told.

The host's conversation with a motor board: who is there, ask, wait, and what to do if not.

Opening a serial port, and what to do where that cannot be.

What ``<param>`` may say in the ``<hardware>`` block of a motor board on a serial port.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
import errno
import grp
import itertools
import os
import secrets
import termios
import threading
import time
from typing import Any

import serial
from serial.tools import list_ports

from amr_description.control.contracts import Log, Severity
from amr_description.control.plugin_errors import describe
from amr_description.errors import HardwareError, ParameterError
from amr_description.hardware.serial_protocol import (
    Board,
    Disarm,
    encode,
    Error,
    Get,
    Hello,
    LineReader,
    LONGEST_WATCHDOG,
    Message,
    Question,
    Reason,
    Refused,
    Set,
    SHORTEST_WATCHDOG,
    State,
    VERSION,
)
from amr_description.model.hardware_info import HardwareInfo
from amr_description.parameters import build, parameter, Spec, specs

READ_TIMEOUT = 0.02
"""s: so long ``read`` waits for a byte."""


def open_port(port: str, baud_rate: int, write_timeout: float) -> serial.Serial:
    """Open a port for this process alone; ``write_timeout`` in s. Raises HardwareError."""
    try:
        return serial.Serial(
            port, baud_rate, timeout=READ_TIMEOUT, write_timeout=write_timeout, exclusive=True
        )
    except (OSError, ValueError, termios.error) as error:
        raise HardwareError(
            f"cannot open the serial port '{port}': {_why(port, error)}"
        ) from error


def _why(port: str, error: Exception) -> str:
    """What is wrong with the port, and what would do."""
    # pyserial passes the number of a failed open on, and that of a failed termios call not.
    is_termios = isinstance(error.__context__, termios.error)
    code = error.__context__.args[0] if is_termios else getattr(error, 'errno', None)
    if code == errno.ENOENT:
        there = ', '.join(found.device for found in list_ports.comports()) or 'none'
        return f'there is no such file; is the board connected? Ports that are there: {there}'
    if code == errno.EACCES:
        return f'permission denied; {_remedy(port)}'
    if code in (errno.EAGAIN, errno.EBUSY):
        return 'another program has it; end that one, or give another port'
    if code in (errno.ENOTTY, errno.EISDIR):
        return 'it is not a serial port'
    return str(error)


def _remedy(port: str) -> str:
    try:
        group = grp.getgrgid(os.stat(port).st_gid).gr_name
    except (OSError, KeyError):
        return 'give a port that you may read and write'
    return f'join its group and log in again: sudo usermod -aG {group} $USER'


_MOST_UNANSWERED = 2
"""``GET`` and ``SET`` on their way; two hide the latency of a USB adapter."""

_GIVEN_UP = 0.05
"""s, after which an answer does not count as on its way any more."""

_SAMPLE, _MOST_REFUSED = 100, 20
"""Of so many lines at most so many may be refused; one of 65536 bad ones passes for good."""


@dataclass(frozen=True, slots=True)
class LinkStatus:
    """What is known of the other end."""

    board: Board | None = None
    """Its last introduction."""
    state: State | None = None
    """Its last state."""
    complaint: Reason | None = None
    """Why it last refused a line, None before."""
    complaints: int = 0
    """How many lines it has refused."""
    refused: int = 0
    """How many of its lines were refused here."""
    last_refused: bytes = b''
    """The last one of them."""
    fault: str = ''
    """What ended the link, as the end of a sentence; '' while it works."""


class SerialLink:
    """
    An open port; ``close`` it.

    It ends with a fault when the port does, when an answer is not there ``patience`` s after its
    question, or when too many lines are refused. The board is then told to disarm, if that can be.
    """

    def __init__(self, port: str, baud_rate: int, patience: float) -> None:
        """Open the port and start the thread. Raises HardwareError."""
        self.port = port
        self.status = LinkStatus()
        self._patience = patience
        self._asked_at: float | None = None
        self._orders: deque[Question] = deque()
        self._motion: deque[Get | Set] = deque(maxlen=1)  # the latest only
        self._sent: deque[int] = deque(maxlen=_MOST_UNANSWERED)  # numbers, of _motion
        self._sent_at = 0.0
        self._lines = LineReader()
        self._recent = deque([False] * _SAMPLE, maxlen=_SAMPLE)  # True: refused
        self._changed = threading.Condition()
        self._is_ending = False
        self._serial = open_port(port, baud_rate, patience)
        # A daemon: whatever ends the process without close(), it must not wait for us.
        self._thread = threading.Thread(target=self._run, name=f'serial {port}', daemon=True)
        self._thread.start()

    def post(self, question: Question) -> None:
        """
        Have a question sent; ``GET`` and ``SET`` as soon as the line is free, the latest only.

        Dropped when the link has ended. From one thread only.
        """
        if self.status.fault:
            return
        if isinstance(question, Get | Set):
            is_news = not self._motion
            self._motion.append(question)
        else:
            is_news = True
            self._motion.clear()  # what was wanted before an ARM must not move anything after it
            self._orders.append(question)
        if is_news:
            self._serial.cancel_read()

    def wait_for(self, condition: Callable[[LinkStatus], object], timeout: float) -> LinkStatus:
        """Block until ``condition(status)``, a fault, or ``timeout`` s; return the status."""
        with self._changed:
            self._changed.wait_for(
                lambda: self.status.fault or condition(self.status), timeout=timeout
            )
            return self.status

    def close(self) -> None:
        """Send what was posted, end the thread and close the port."""
        self._is_ending = True
        self._serial.cancel_read()
        self._thread.join()
        self._serial.close()

    # --- the thread ----------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            # Ends whatever the board has heard of an earlier host, or of our opening the port.
            self._serial.write(b'\n')
            while self._orders or not self._is_ending:
                self._send()
                self._receive()
                if self.status.fault:
                    self._serial.write(encode(Disarm(0)))
                    return
        except serial.SerialTimeoutException:
            self._end('takes no more bytes')
        except (OSError, termios.error):
            self._end('is gone, as if it were unplugged')
        except Exception as error:  # a bug; the owner must not go on with the last state for ever
            self._end(f'cannot be talked to ({describe(error)})')

    def _end(self, fault: str) -> None:
        self._set(replace(self.status, fault=self.status.fault or fault))

    def _send(self) -> None:
        while self._orders:
            self._write(self._orders.popleft())
        if not self._is_free():
            return
        try:
            question = self._motion.popleft()
        except IndexError:
            return
        self._write(question)
        self._sent.append(question.number)
        self._sent_at = time.monotonic()

    def _write(self, question: Question) -> None:
        self._serial.write(encode(question))
        if self._asked_at is None and not isinstance(question, Hello):
            self._asked_at = time.monotonic()

    def _is_free(self) -> bool:
        """
        Tell whether few enough questions are on their way: on a slow line they would queue up, and
        commands arrive when nobody wants them any more.
        """
        state = self.status.state
        return (
            len(self._sent) < _MOST_UNANSWERED
            or (state is not None and state.number in self._sent)
            or time.monotonic() - self._sent_at > _GIVEN_UP
        )

    def _receive(self) -> None:
        """Wait for bytes, a little; ended at once by :meth:`post`."""
        began = time.monotonic()
        data = self._serial.read(max(1, self._serial.in_waiting))
        now = time.monotonic()
        found = self._lines.feed(data)
        if found:
            self._set(self._judged(self._taken(found)))
        if self._asked_at is None:
            return
        # While this process was stopped, it could not hear the answer.
        self._asked_at += max(0.0, now - began - READ_TIMEOUT)
        if now - self._asked_at > self._patience:
            self._end(self._silence())

    def _taken(self, found: list[Message | Refused]) -> LinkStatus:
        status = self.status
        for message in found:
            self._recent.append(isinstance(message, Refused))
            match message:
                case Board():
                    status = replace(status, board=message)
                    self._recent.extend([False] * _SAMPLE)  # what it said while it started
                case State():
                    status = replace(status, state=message)
                    self._asked_at = None
                case Error(reason):
                    complaints = status.complaints + 1
                    status = replace(status, complaint=reason, complaints=complaints)
                case Refused(line):
                    status = replace(status, refused=status.refused + 1, last_refused=line)
        return status

    def _judged(self, status: LinkStatus) -> LinkStatus:
        refused = sum(self._recent)
        if status.board is None or refused <= _MOST_REFUSED:
            return status
        return replace(
            status,
            fault=f'sends noise: {refused} of its last {_SAMPLE} lines were refused, the last one '
            f'{status.last_refused!r}',
        )

    def _silence(self) -> str:
        text = f'has not told its state for {self._patience:g} s'
        if self.status.complaints:
            text += f', but refused {self.status.complaints} lines ({self.status.complaint})'
        return text

    def _set(self, status: LinkStatus) -> None:
        with self._changed:
            self.status = status
            self._changed.notify_all()


@dataclass(frozen=True, slots=True)
class SerialParameters:
    """
    One row a ``<param>``; lists are written with spaces or commas between the names.

    A *reduction* is how many turns of the motor shaft make one turn of the wheel, negative where a
    motor is mounted the other way round.
    """

    port: str = parameter(
        '', 'Path of the serial port; best one of /dev/serial/by-id', not_empty=True
    )
    left_joints: tuple[str, ...] = parameter(
        (), 'Joints that the left motor turns', not_empty=True
    )
    right_joints: tuple[str, ...] = parameter(
        (), 'Joints that the right motor turns', not_empty=True
    )
    left_reduction: float = parameter(1.0, 'Of the left gear', not_zero=True)
    right_reduction: float = parameter(1.0, 'Of the right gear', not_zero=True)
    max_velocity: float = parameter(
        20.0, 'No wheel is told to turn faster', unit='rad/s', above=0.0
    )
    baud_rate: int = parameter(115200, 'Of the port', unit='bit/s', minimum=1)
    connect_timeout: float = parameter(
        1.0,
        'Longest wait for the board to introduce itself; more for one that restarts when its port '
        'is opened',
        unit='s',
        above=0.0,
        maximum=10.0,
    )
    answer_timeout: float = parameter(
        0.25, 'Longest wait for any other answer', unit='s', minimum=0.05, maximum=5.0
    )
    watchdog_timeout: float = parameter(
        0.2,
        'The board stops by itself when it has heard no command for so long',
        unit='s',
        minimum=SHORTEST_WATCHDOG / 1000,
        maximum=LONGEST_WATCHDOG / 1000,
    )


_READERS: dict[str, Callable[[str], Any]] = {
    'string': str,
    'integer': int,
    'double': float,
    'string_array': lambda text: tuple(text.replace(',', ' ').split()),
}


def read_parameters(info: HardwareInfo, log: Log) -> SerialParameters:
    """Return the checked parameters; one that is not known is warned of. Raises HardwareError."""
    table = {spec.name: spec for spec in specs(SerialParameters)}
    for name in info.parameters.keys() - table.keys():
        log(
            Severity.WARN,
            f"hardware component '{info.name}': parameter '{name}' has no effect. Known: "
            f'{", ".join(table)}',
        )
    try:
        given = {n: _read(table[n], text) for n, text in info.parameters.items() if n in table}
        return build(SerialParameters, given)
    except ParameterError as error:
        raise HardwareError(f"hardware component '{info.name}': {error}") from error


def _read(spec: Spec, text: str) -> Any:
    try:
        return _READERS[spec.type](text)
    except ValueError:
        raise ParameterError(
            f"parameter '{spec.name}' must be of type {spec.type}, found '{text}'"
        ) from None


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
