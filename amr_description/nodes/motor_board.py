# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The executable ``motor_board``: a simulated motor board behind a serial port, until Ctrl-C.

The port is a pseudo-terminal, with a link of a stable name to it, for
``amr_description/SerialBaseSystem`` to open. It needs no ROS: what it speaks stands in
:mod:`amr_description.hardware.serial_protocol`.

Ending the program is pulling the plug. On SIGINT, which Ctrl-C sends to a whole bring-up, it lasts
until the host has closed the port, two seconds at most: a robot that is shut down is not
unplugged.
"""

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
import os
from pathlib import Path
import select
import signal
import sys
import tempfile
import threading
import time
import tty
from typing import Self

from amr_description.errors import AmrError, UsageError
from amr_description.hardware.simulated_motor_board import SimulatedMotorBoard
from amr_description.ownership import changed_by_others
from amr_description.ros.signals import StopRequested, StopRequests

_STEP = 0.005
"""s: the motors move at least so often."""
_GRACE = 2.0
"""s: so long a host may take to close the port after SIGINT."""


def main(args: list[str] | None = None) -> int:
    """Run the board; return its exit code, 0 when it was asked to stop."""
    options = _parser().parse_args(_without_ros_arguments(sys.argv[1:] if args is None else args))
    try:
        with StopRequests(wake=lambda: None) as stop, PseudoTerminal() as terminal:
            asked = threading.Event()
            with linked(options.link, terminal.port), stop.on_stop(asked.set):
                _say(f'on {terminal.port}, linked as {options.link}')
                board = SimulatedMotorBoard(_say)
                serve(board, terminal.line, until=asked.is_set)
                if stop.signum == signal.SIGINT:
                    terminal.let_go()
                    deadline = time.monotonic() + _GRACE
                    serve(board, terminal.line, until=lambda: time.monotonic() > deadline)
    except StopRequested:
        pass  # before it was at work, or in haste
    except AmrError as error:
        print(f'motor_board: {error}', file=sys.stderr)
        return error.exit_code
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='motor_board',
        description='Simulate a two-sided motor board on a serial port, until Ctrl-C.',
    )
    parser.add_argument(
        '--link',
        type=Path,
        default=default_link(),
        metavar='PATH',
        help='name of the port, a symbolic link that is made (default: %(default)s)',
    )
    return parser


def _without_ros_arguments(args: list[str]) -> list[str]:
    """A bring-up gives every program ROS arguments; this one has no use for them."""
    return args[: args.index('--ros-args')] if '--ros-args' in args else args


def _say(line: str) -> None:
    with suppress(OSError):  # whoever read it is gone; the motors turn on
        print(f'motor_board: {line}', flush=True)


def default_link() -> Path:
    """Return the port's name where the user gives none: one a user, gone with the session."""
    base = os.environ.get('XDG_RUNTIME_DIR')
    if base:
        return Path(base, 'amr_description', 'motor_board')
    return Path(tempfile.gettempdir(), f'amr_description-{os.getuid()}', 'motor_board')


class PseudoTerminal:
    """
    A raw line with two ends; close it by leaving its ``with``.

    ``line``: the board's end, a file. ``port``: the path of the host's end.
    """

    def __init__(self) -> None:
        self.line, slave = os.openpty()
        self.port = os.ttyname(slave)
        # Kept open here, the port stays raw, and the line well, while no host has opened it.
        self._slave: int | None = slave
        tty.setraw(slave)
        os.set_blocking(self.line, False)

    def let_go(self) -> None:
        """Have the line hang up when no host has it open (any more)."""
        if self._slave is not None:
            os.close(self._slave)
        self._slave = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.let_go()
        os.close(self.line)


@contextmanager
def linked(link: Path, port: str) -> Iterator[None]:
    """
    Have ``link`` point to ``port``; removed in the end, unless another board has taken it over.

    What is there already is replaced if it is such a link. Raises UsageError.
    """
    if os.path.lexists(link) and not (link.is_symlink() and _is_terminal(os.readlink(link))):
        raise UsageError(f"'{link}' is there, and no link of a motor board; give another --link")
    new = link.with_name(f'{link.name}.{os.getpid()}')
    try:
        link.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if reason := changed_by_others(link.parent):
            raise UsageError(
                f"cannot make the link '{link}': {reason}, who could put another port in its "
                'place; give another --link, or remove that folder'
            )
        new.symlink_to(port)
        new.replace(link)
    except OSError as error:
        raise UsageError(
            f"cannot make the link '{link}' ({error.strerror}); give another --link"
        ) from error
    try:
        yield
    finally:
        with suppress(OSError):
            if os.readlink(link) == port:
                link.unlink()


def _is_terminal(target: str) -> bool:
    return target.startswith('/dev/pts/')


def serve(board: SimulatedMotorBoard, line: int, until: Callable[[], bool]) -> None:
    """
    Turn the motors in real time, and answer what comes in on the file ``line``.

    Returns when ``until()``, which is asked every few ms, or when the line is hung up.
    """
    before = time.monotonic()
    with suppress(OSError):  # EIO: hung up
        while not until():
            ready, _, _ = select.select([line], [], [], _STEP)
            data = os.read(line, 4096) if ready else b''
            now = time.monotonic()
            board.advance(now - before)
            before = now
            answer = board.receive(data)
            if answer:
                with suppress(BlockingIOError):  # nobody reads it; a wire keeps nothing either
                    os.write(line, answer)


if __name__ == '__main__':
    raise SystemExit(main())
