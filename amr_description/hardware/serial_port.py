# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Opening a serial port, and what to do where that cannot be."""

import errno
import grp
import os
import termios

import serial
from serial.tools import list_ports

from amr_description.errors import HardwareError

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
