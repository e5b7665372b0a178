# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joysticks of this machine, as Linux has them in ``/dev/input`` (evdev).

Structures and requests are those of ``linux/input.h``. Imports no rclpy.
"""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
import fcntl
import os
from pathlib import Path
import struct

from amr_description.nodes.joy_node.gamepad import AxisRange

FOLDER = Path('/dev/input')
EVENT = struct.Struct('llHHi')
"""Two numbers of the time; type, code, value."""
KEY, ABSOLUTE = 1, 3
_SYNCHRONISATION, _DROPPED = 0, 3
_ABSOLUTE_INFO = struct.Struct('6i')
"""value, minimum, maximum, fuzz, flat, resolution"""
_X, _Y = 0, 1
_CODES = 0x300
"""As many codes a type has, at most."""
_JOYSTICK_BUTTONS = range(0x120, 0x140)
_ANOTHER_EVENTS = 64

Ioctl = Callable[[int, int, bytearray], int]


@dataclass(frozen=True, slots=True)
class InputEvent:
    """What happened: a type, such as :data:`KEY`, the code of a button or axis, its value."""

    type: int
    code: int
    value: int


class InputDevice:
    """
    An open device.

    Args:
        path: its file.
        ioctl: asks the kernel about it, as ``fcntl.ioctl`` does.

    Raises:
        OSError: it cannot be opened, or is no device of this kind.
    """

    def __init__(self, path: Path, ioctl: Ioctl = fcntl.ioctl) -> None:
        self._ioctl = ioctl
        self.descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        try:
            name = self._ask(0x06, 256)
            self.name = name.split(b'\0')[0].decode(errors='replace')
            self.keys = self._codes_of(KEY)
            infos = {code: self._absolute(code) for code in self._codes_of(ABSOLUTE)}
        except OSError:
            self.close()
            raise
        self.ranges = {code: AxisRange(low, high) for code, (_, low, high) in infos.items()}

    @property
    def is_joystick(self) -> bool:
        """Whether it has a stick and buttons of a joystick; mice and touchpads have others."""
        return {_X, _Y} <= self.ranges.keys() and any(
            key in _JOYSTICK_BUTTONS for key in self.keys
        )

    def present(self) -> Iterator[InputEvent]:
        """Yield an event for each button and axis as it is now. Raises OSError: it is gone."""
        down = set(_numbers_of(self._ask(0x18, _CODES // 8)))
        for code in self.keys:
            yield InputEvent(KEY, code, int(code in down))
        for code in self.ranges:
            yield InputEvent(ABSOLUTE, code, self._absolute(code)[0])

    def read(self) -> list[InputEvent]:
        """Return the events since the last call, those of :meth:`present` if some were lost."""
        try:
            data = os.read(self.descriptor, _ANOTHER_EVENTS * EVENT.size)
        except BlockingIOError:
            return []
        if not data:
            raise OSError('it is gone')
        events = [InputEvent(*words[2:]) for words in EVENT.iter_unpack(data)]
        if any((each.type, each.code) == (_SYNCHRONISATION, _DROPPED) for each in events):
            return [*self.present()]
        return events

    def close(self) -> None:
        """Let go of it."""
        os.close(self.descriptor)

    def _absolute(self, code: int) -> tuple[int, int, int]:
        """Return value, minimum and maximum of an axis."""
        value, minimum, maximum, *_ = _ABSOLUTE_INFO.unpack(
            self._ask(0x40 + code, _ABSOLUTE_INFO.size)
        )
        return value, minimum, maximum

    def _codes_of(self, kind: int) -> list[int]:
        return _numbers_of(self._ask(0x20 + kind, _CODES // 8))

    def _ask(self, number: int, size: int) -> bytes:
        """Return the answer to a request that reads ``size`` bytes: ``_IOR('E', number, …)``."""
        answer = bytearray(size)
        self._ioctl(self.descriptor, 2 << 30 | size << 16 | ord('E') << 8 | number, answer)
        return bytes(answer)


def _numbers_of(bits: bytes) -> list[int]:
    """Return the numbers of the bits that are set, from the lowest of the first byte on."""
    return [number for number in range(8 * len(bits)) if bits[number // 8] >> number % 8 & 1]


def device_files(folder: Path = FOLDER) -> list[Path]:
    """Return the files of all devices, in the order of their numbers."""
    paths = [path for path in folder.glob('event*') if path.name[5:].isdecimal()]
    return sorted(paths, key=lambda path: int(path.name[5:]))


def open_joystick(
    number: int, name: str, folder: Path = FOLDER, ioctl: Ioctl = fcntl.ioctl
) -> InputDevice | None:
    """
    Open the joystick of this name, or, without one, that of this number among all, from 0 on.

    Returns:
        It; None: there is none, or it may not be opened.
    """
    count = 0
    for path in device_files(folder):
        with suppress(OSError):
            device = InputDevice(path, ioctl)
            if device.is_joystick:
                if device.name == name if name else count == number:
                    return device
                count += 1
            device.close()
    return None


def unreadable(folder: Path = FOLDER) -> list[Path]:
    """Return the files of devices that this user may not read."""
    return [path for path in device_files(folder) if not os.access(path, os.R_OK)]
