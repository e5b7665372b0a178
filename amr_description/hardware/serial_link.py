# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A serial port with a thread of its own, which alone reads and writes it.

The owner posts messages and looks at :attr:`SerialLink.status`, an immutable snapshot; neither
blocks. Only :meth:`SerialLink.wait_for` does, for transitions, and never longer than it is told.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
import termios
import threading
import time

import serial

from amr_description.control.foreign_errors import describe
from amr_description.hardware.serial_lines import encode, LineReader
from amr_description.hardware.serial_port import open_port, READ_TIMEOUT
from amr_description.hardware.serial_protocol import (
    Board,
    Disarm,
    Error,
    Get,
    Hello,
    Message,
    Question,
    Reason,
    Refused,
    Set,
    State,
)

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
