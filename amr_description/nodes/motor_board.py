# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The executable ``motor_board``: a simulated motor board behind a serial port, until Ctrl-C.

The port is a pseudo-terminal, with a link of a stable name to it, for
``amr_description/SerialBaseSystem`` to open. Ending the program is pulling the plug. It needs no
ROS: what it speaks stands in :mod:`amr_description.hardware.serial_protocol`.
"""

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
import os
from pathlib import Path
import select
import sys
import tempfile
import time
import tty

from amr_description.errors import AmrError, UsageError
from amr_description.hardware.simulated_motor_board import SimulatedMotorBoard
from amr_description.nodes.stop_requests import StopRequested, StopRequests

_STEP = 0.005
"""s: the motors move at least so often."""


def main(args: list[str] | None = None) -> int:
    """Run the board; return its exit code, 0 when it was asked to stop."""
    options = _parser().parse_args(_without_ros_arguments(sys.argv[1:] if args is None else args))
    try:
        with StopRequests(wake=lambda: None) as stop, pseudo_terminal() as (line, port):
            ended: list[bool] = []
            with linked(options.link, port), stop.on_stop(lambda: ended.append(True)):
                _say(f'on {port}, linked as {options.link}')
                serve(SimulatedMotorBoard(_say), line, until=lambda: bool(ended))
    except StopRequested:
        pass  # before it was at work
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


@contextmanager
def pseudo_terminal() -> Iterator[tuple[int, str]]:
    """Open a raw pseudo-terminal; yields the board's end of the line and the host's port."""
    line, port = os.openpty()
    try:
        # Kept open here, the port stays raw, and the line well, while no host has opened it.
        tty.setraw(port)
        os.set_blocking(line, False)
        yield line, os.ttyname(port)
    finally:
        os.close(port)
        os.close(line)


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
    """Turn the motors in real time, and answer what comes in on the file ``line``."""
    before = time.monotonic()
    while not until():
        ready, _, _ = select.select([line], [], [], _STEP)
        heard = os.read(line, 4096) if ready else b''
        now = time.monotonic()
        board.advance(now - before)
        before = now
        answer = board.hear(heard)
        if answer:
            with suppress(BlockingIOError):  # the host reads nothing: a wire keeps nothing either
                os.write(line, answer)


if __name__ == '__main__':
    raise SystemExit(main())
