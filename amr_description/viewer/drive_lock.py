# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Who drives which robot: one page at a time, and never longer than it says so.

Pure; times are s of any clock that only goes forward. Every method that ends a drive returns the
robots that are to be stopped, each by one command of zero; after it there is silence, so that
others (a joystick, Nav2) may command.

Whoever was stopped by somebody else must let go before driving on: be silent for the time-out, or
stop. A key that is still held when another page presses the big stop drives no further.
"""

from dataclasses import dataclass

DRIVE_TIMEOUT = 0.4
"""s after the last drive until the robot is stopped."""


@dataclass(slots=True)
class _Drive:
    """``until``: when it ends by itself."""

    client: str
    until: float


class DriveLock:
    """The wheel of every robot."""

    def __init__(self, timeout: float = DRIVE_TIMEOUT) -> None:
        self._timeout = timeout
        self._drives: dict[str, _Drive] = {}
        self._stopped: dict[tuple[str, str], float] = {}
        """(robot, client) that another one stopped -> until when it may not drive."""

    def driver(self, robot: str) -> str | None:
        """Return who drives a robot; None: nobody."""
        drive = self._drives.get(robot)
        return drive.client if drive else None

    def robots(self) -> list[str]:
        """Return those that are driven."""
        return list(self._drives)

    def drive(self, robot: str, client: str, time: float) -> bool:
        """Take the wheel, or keep it; False: somebody else has it, or stopped this one."""
        drive = self._drives.get(robot)
        if drive is not None and drive.client != client and time < drive.until:
            return False
        if time < self._stopped.pop((robot, client), time):
            self._stopped[robot, client] = time + self._timeout  # it has not let go yet
            return False
        self._drives[robot] = _Drive(client, time + self._timeout)
        return True

    def stop(self, robot: str, client: str, time: float) -> str | None:
        """Take the wheel from whoever has it, as ``client`` asks; return who must let go."""
        drive = self._drives.pop(robot, None)
        self._stopped.pop((robot, client), None)
        if drive is None or drive.client == client:
            return None
        self._stopped[robot, drive.client] = time + self._timeout
        return drive.client

    def leave(self, client: str) -> list[str]:
        """Take the wheel from a page that is gone."""
        self._stopped = {key: until for key, until in self._stopped.items() if key[1] != client}
        return self._end({r: d for r, d in self._drives.items() if d.client == client})

    def expire(self, time: float) -> list[str]:
        """Take the wheel from all who have been silent for too long."""
        return self._end({r: d for r, d in self._drives.items() if d.until <= time})

    def next_expiry(self) -> float | None:
        """Return when :meth:`expire` is due; None: nobody drives."""
        return min((drive.until for drive in self._drives.values()), default=None)

    def _end(self, drives: dict[str, _Drive]) -> list[str]:
        for robot in drives:
            del self._drives[robot]
        return list(drives)
