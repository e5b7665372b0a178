# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which page drives which robot: one at a time, and only while it keeps sending commands.

Pure; times are s of any monotonic clock. A robot whose lock is released must be stopped with one
command of zero. After that nothing is published for it, so that others (a joystick, Nav2) can
command it.

A page whose robot was stopped by another page must let go before it drives on: send nothing for
the time-out, or a stop. So a key that is still held does not drive on after the stop button of
another page, nor does one whose page was late, so that the lock had expired before the stop.
"""

from dataclasses import dataclass

DRIVE_TIMEOUT = 0.4
"""s after the last drive message until the robot is stopped."""


@dataclass(slots=True)
class _Holder:
    client: str
    until: float
    """When the lock expires, s."""


class DriveLock:
    """The locks of all robots."""

    def __init__(self, timeout: float = DRIVE_TIMEOUT) -> None:
        self._timeout = timeout
        self._holders: dict[str, _Holder] = {}
        self._latest: dict[str, str] = {}
        """Robot -> the client that drove it last, unless that has let go or been stopped."""
        self._blocked: dict[tuple[str, str], float] = {}
        """(robot, client) that another client stopped -> until when it is refused."""

    def holder(self, robot: str) -> str | None:
        """Return the client that drives a robot; None: nobody."""
        holder = self._holders.get(robot)
        return holder.client if holder else None

    def robots(self) -> list[str]:
        """Return the robots that are being driven."""
        return list(self._holders)

    def acquire(self, robot: str, client: str, time: float) -> bool:
        """
        Acquire the lock of a robot, or extend it.

        Returns:
            False: another client holds it, or stopped this one, which has not let go since.
        """
        holder = self._holders.get(robot)
        if holder is not None and holder.client != client and time < holder.until:
            return False
        if time < self._blocked.pop((robot, client), time):
            self._blocked[robot, client] = time + self._timeout
            return False
        self._holders[robot] = _Holder(client, time + self._timeout)
        self._latest[robot] = client
        return True

    def block(self, robot: str, client: str, time: float) -> None:
        """Refuse a client until it has let go: it drives a robot that is held at rest."""
        self._blocked[robot, client] = time + self._timeout

    def stop(self, robot: str, client: str, time: float) -> str | None:
        """
        Release the lock of a robot, whoever holds it, because ``client`` stops the robot.

        Returns:
            The other client that drove it and must let go; None: nobody, or ``client`` itself.
        """
        self._holders.pop(robot, None)
        self._blocked.pop((robot, client), None)
        driver = self._latest.pop(robot, None)
        if driver is None or driver == client:
            return None
        self._blocked[robot, driver] = time + self._timeout
        return driver

    def release_all(self, client: str) -> list[str]:
        """Release the locks of a client that is gone; return their robots, to be stopped."""
        self._blocked = {key: until for key, until in self._blocked.items() if key[1] != client}
        self._latest = {key: latest for key, latest in self._latest.items() if latest != client}
        return self._release([r for r, each in self._holders.items() if each.client == client])

    def expire(self, time: float) -> list[str]:
        """Release the locks that were not extended in time; return their robots, to be stopped."""
        return self._release([r for r, each in self._holders.items() if each.until <= time])

    def next_expiry(self) -> float | None:
        """Return when :meth:`expire` is due, s; None: nobody drives."""
        return min((each.until for each in self._holders.values()), default=None)

    def _release(self, robots: list[str]) -> list[str]:
        for robot in robots:
            del self._holders[robot]
        return robots
