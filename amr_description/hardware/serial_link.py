# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The connection to a motor board: its parameters, the conversation, the thread, and the port.

:class:`SerialBoard` asks the board and waits for answers; its errors name a remedy. Below it,
:class:`SerialLink` reads and writes the port on a thread of its own. The control thread posts
messages and reads :attr:`SerialLink.status`, an immutable snapshot, without blocking. Only
:meth:`SerialLink.wait_for`, for transitions, blocks, up to its timeout.
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
    Reason,
    Refused,
    Request,
    Set,
    SHORTEST_WATCHDOG,
    State,
    VERSION,
)
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareInfo
from amr_description.parameters import build, parameter, Spec, specs
from amr_description.plugin_errors import describe

READ_TIMEOUT = 0.02
"""s: the longest wait for a byte."""

_RETRY = 0.1
"""s, about: after this time a request is repeated."""

_MOST_UNANSWERED = 2
"""``GET`` and ``SET`` without an answer yet; two hide the latency of a USB adapter."""

_ANSWER_LOST = 0.05
"""s, after which an answer counts as lost."""

_GEAR = (1e-4, 1e4)
"""Turns of the shaft for a turn of the wheel."""

_SAMPLE, _MOST_REFUSED = 100, 20
"""At most 20 of the latest 100 lines may be refused; the CRC misses 1 wrong line of 65536."""


@dataclass(frozen=True, slots=True)
class SerialParameters:
    """
    The parameters of the ``<hardware>`` block; lists are separated by spaces or commas.

    A *reduction* is the number of turns of the motor shaft for one turn of the wheel, negative for
    a motor that is mounted in the opposite direction.
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
    left_reduction: float = parameter(1.0, 'Of the left gear', not_zero=True, magnitude=_GEAR)
    right_reduction: float = parameter(1.0, 'Of the right gear', not_zero=True, magnitude=_GEAR)
    max_velocity: float = parameter(
        20.0, 'Greatest velocity of a wheel', unit='rad/s', above=0.0, magnitude=(1e-3, 1e5)
    )
    baud_rate: int = parameter(
        115200, 'Of the port', unit='bit/s', minimum=1, magnitude=(1, 100_000_000)
    )
    connect_timeout: float = parameter(
        1.0,
        'Longest wait for the board to identify itself; increase it for a board that restarts '
        'when its port is opened',
        unit='s',
        above=0.0,
        maximum=10.0,
    )
    answer_timeout: float = parameter(
        0.25, 'Longest wait for any other answer', unit='s', minimum=0.05, maximum=5.0
    )
    watchdog_timeout: float = parameter(
        0.2,
        'The board stops by itself after this time without a command',
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
    """
    Return the checked parameters; unknown ones are warned of.

    Raises HardwareError: one is missing or invalid.
    """
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


@dataclass(frozen=True, slots=True)
class LinkStatus:
    """What a link has received so far."""

    board: Board | None = None
    """The last identification."""
    state: State | None = None
    """The last state."""
    last_error: Reason | None = None
    """Why the board last refused a line."""
    errors: int = 0
    """Number of lines that the board has refused."""
    refused: int = 0
    """Number of lines of the board that were refused here."""
    last_refused: bytes = b''
    """The last one of them."""
    fault: str = ''
    """What has ended the link, as the end of a sentence; '' while it works."""


class SerialBoard:
    """A board that has identified itself; ``close`` it."""

    def __init__(self, parameters: SerialParameters, component: str) -> None:
        """
        Open the port and identify the board.

        Args:
            parameters: of the connection.
            component: name of the hardware component, for the remedy in errors.

        Raises:
            HardwareError: the port is closed again.
        """
        self._parameters = parameters
        self._component = component
        # Not those of an earlier host, whose answers may still be in the line.
        self._numbers = itertools.count(secrets.randbelow(2**16))
        self._link = SerialLink(parameters.port, parameters.baud_rate, parameters.answer_timeout)
        try:
            self.description = self._identify()
        except Exception:
            self.close()
            raise

    def post(self, kind: type[Request], *values: float) -> int:
        """
        Send a request without waiting, and return its number.

        Args:
            kind: type of the message.
            values: its fields, without the number.

        Raises:
            HardwareError: the board is lost.
        """
        self._raise_if_lost(self._link.status)
        number = next(self._numbers) % 2**16
        self._link.post(kind(number, *values))  # type: ignore[arg-type]
        return number

    @property
    def state(self) -> State | None:
        """The last state, None before the first. Raises HardwareError: the board is lost."""
        status = self._link.status
        self._raise_if_lost(status)
        return status.state

    @property
    def is_lost(self) -> bool:
        """True: the link has ended by itself."""
        return bool(self._link.status.fault)

    def ask(self, kind: type[Request], *values: int) -> State:
        """
        Send a request, repeat it if the answer is lost, and block until the state arrives.

        Arguments as of :meth:`post`. Raises HardwareError: no answer within ``answer_timeout``.
        """
        timeout = self._parameters.answer_timeout
        status = self._exchange(lambda status: status.state, timeout, kind, *values)
        if status is None or status.state is None:
            raise self.failure(f'has not answered {kind.__name__.upper()} within {timeout:g} s')
        return status.state

    def failure(self, fault: str) -> HardwareError:
        """Return the error of a lost board; ``fault``: what has happened, after 'the board'."""
        return HardwareError(
            f'the motor board on {self._link.port} {fault}; check its cable and power, then: ros2 '
            f'control set_hardware_component_state {self._component} active'
        )

    def close(self) -> None:
        """Send the posted messages, and close the port."""
        self._link.close()

    def _identify(self) -> Board:
        timeout = self._parameters.connect_timeout
        status = self._exchange(lambda status: status.board, timeout, Hello, VERSION)
        if status is not None and status.board is not None:
            return self._checked(status.board)
        status = self._link.status
        lines = f'{status.refused} lines such as {status.last_refused!r}'
        raise HardwareError(
            f'no motor board answered on {self._link.port} at {self._parameters.baud_rate} bit/s '
            f'within {timeout:g} s; what came instead: {lines if status.refused else "nothing"}; '
            'check port, baud_rate and the power of the board'
        )

    def _exchange(
        self,
        answer_of: Callable[[LinkStatus], Board | State | None],
        timeout: float,
        kind: type[Request],
        *values: int,
    ) -> LinkStatus | None:
        """Repeat a request until it is answered; return None after the timeout."""
        tries = max(1, round(timeout / _RETRY))
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

    def _checked(self, board: Board) -> Board:
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
            raise self.failure(status.fault)


class SerialLink:
    """
    An open port; ``close`` it.

    It ends with a fault if the port fails, an answer is missing, or too many lines are refused. It
    then disarms the board, if it can.
    """

    def __init__(self, port: str, baud_rate: int, answer_timeout: float) -> None:
        """
        Open the port and start the thread.

        Args:
            port: its path.
            baud_rate: bit/s.
            answer_timeout: s.

        Raises:
            HardwareError: the port cannot be opened.
        """
        self.port = port
        self.status = LinkStatus()
        self._answer_timeout = answer_timeout
        self._asked_at: float | None = None
        self._commands: deque[Request] = deque()
        self._cyclic: deque[Get | Set] = deque(maxlen=1)  # the latest only
        self._sent: deque[int] = deque(maxlen=_MOST_UNANSWERED)  # numbers of _cyclic
        self._sent_at = 0.0
        self._lines = LineReader()
        self._recent = deque([False] * _SAMPLE, maxlen=_SAMPLE)  # True: refused
        self._changed = threading.Condition()
        self._is_ending = False
        self._serial = open_port(port, baud_rate, answer_timeout)
        # A daemon: a process that ends without close() must not wait for it.
        self._thread = threading.Thread(target=self._run, name=f'serial {port}', daemon=True)
        self._thread.start()

    def post(self, request: Request) -> None:
        """
        Send a request: ``GET`` and ``SET`` as soon as the line is free, only the latest one.

        It is dropped if the link has ended. Must always be called on the same thread.
        """
        if self.status.fault:
            return
        if isinstance(request, Get | Set):
            has_to_wake = not self._cyclic
            self._cyclic.append(request)
        else:
            has_to_wake = True
            self._cyclic.clear()  # a SET from before an ARM must not move anything after it
            self._commands.append(request)
        if has_to_wake:
            self._serial.cancel_read()

    def wait_for(self, condition: Callable[[LinkStatus], object], timeout: float) -> LinkStatus:
        """
        Block until a condition is true, and return the status.

        Args:
            condition: of the status.
            timeout: s; a fault ends the wait too.
        """
        with self._changed:
            self._changed.wait_for(
                lambda: self.status.fault or condition(self.status), timeout=timeout
            )
            return self.status

    def close(self) -> None:
        """Send the posted messages, end the thread and close the port."""
        self._is_ending = True
        self._serial.cancel_read()
        self._thread.join()
        self._serial.close()

    # --- the thread ----------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            # Ends a line that an earlier host, or opening the port, may have started.
            self._serial.write(b'\n')
            while self._commands or not self._is_ending:
                self._send()
                self._receive()
                if self.status.fault:
                    self._serial.write(encode(Disarm(0)))
                    return
        except serial.SerialTimeoutException:
            self._end('takes no more bytes')
        except (OSError, termios.error):
            self._end('is gone, as if it were unplugged')
        except Exception as error:  # a bug; the last state must not stay in use for ever
            self._end(f'cannot be talked to ({describe(error)})')

    def _end(self, fault: str) -> None:
        self._set(replace(self.status, fault=self.status.fault or fault))

    def _send(self) -> None:
        while self._commands:
            self._write(self._commands.popleft())
        if not self._is_free():
            return
        try:
            request = self._cyclic.popleft()
        except IndexError:
            return
        self._write(request)
        self._sent.append(request.number)
        self._sent_at = time.monotonic()

    def _write(self, request: Request) -> None:
        self._serial.write(encode(request))
        if self._asked_at is None and not isinstance(request, Hello):
            self._asked_at = time.monotonic()

    def _is_free(self) -> bool:
        """Return whether few enough questions wait for an answer; a slow line would queue them."""
        state = self.status.state
        return (
            len(self._sent) < _MOST_UNANSWERED
            or (state is not None and state.number in self._sent)
            or time.monotonic() - self._sent_at > _ANSWER_LOST
        )

    def _receive(self) -> None:
        """Wait for bytes for a short time; :meth:`post` ends the wait."""
        began = time.monotonic()
        data = self._serial.read(max(1, self._serial.in_waiting))
        now = time.monotonic()
        found = self._lines.feed(data)
        if found:
            self._set(self._checked(self._updated(found)))
        if self._asked_at is None:
            return
        # The time during which this process was stopped does not count.
        self._asked_at += max(0.0, now - began - READ_TIMEOUT)
        if now - self._asked_at > self._answer_timeout:
            self._end(self._timeout_text())

    def _updated(self, found: list[Message | Refused]) -> LinkStatus:
        status = self.status
        for message in found:
            self._recent.append(isinstance(message, Refused))
            match message:
                case Board():
                    status = replace(status, board=message)
                    self._recent.extend([False] * _SAMPLE)  # forget its output while it started
                case State():
                    status = replace(status, state=message)
                    self._asked_at = None
                case Error(reason):
                    status = replace(status, last_error=reason, errors=status.errors + 1)
                case Refused(line):
                    status = replace(status, refused=status.refused + 1, last_refused=line)
        return status

    def _checked(self, status: LinkStatus) -> LinkStatus:
        refused = sum(self._recent)
        if status.board is None or refused <= _MOST_REFUSED:
            return status
        return replace(
            status,
            fault=f'sends noise: {refused} of its last {_SAMPLE} lines were refused, the last one '
            f'{status.last_refused!r}',
        )

    def _timeout_text(self) -> str:
        text = f'has not told its state for {self._answer_timeout:g} s'
        if self.status.errors:
            text += f', but refused {self.status.errors} lines ({self.status.last_error})'
        return text

    def _set(self, status: LinkStatus) -> None:
        with self._changed:
            self.status = status
            self._changed.notify_all()


def open_port(port: str, baud_rate: int, write_timeout: float) -> serial.Serial:
    """
    Open a port for this process alone.

    Args:
        port: its path.
        baud_rate: bit/s.
        write_timeout: s.

    Raises:
        HardwareError: with the cause and a remedy.
    """
    try:
        return serial.Serial(
            port, baud_rate, timeout=READ_TIMEOUT, write_timeout=write_timeout, exclusive=True
        )
    except (OSError, ValueError, termios.error) as error:
        raise HardwareError(
            f"cannot open the serial port '{port}': {_why(port, error)}"
        ) from error


def _why(port: str, error: Exception) -> str:
    """Return why a port cannot be opened, and a remedy."""
    # pyserial passes on the error number of a failed open, but not of a failed termios call.
    cause = error.__context__
    code = cause.args[0] if isinstance(cause, termios.error) else getattr(error, 'errno', None)
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
