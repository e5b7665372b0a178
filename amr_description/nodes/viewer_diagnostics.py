# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/diagnostics`` as pages show it: the last word of each name, by robot."""

from collections.abc import Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from amr_description.viewer.discovery import owner
from amr_description.viewer.protocol import DiagnosticItem, Diagnostics

_LEVELS = {
    DiagnosticStatus.OK: 'ok',
    DiagnosticStatus.WARN: 'warn',
    DiagnosticStatus.ERROR: 'error',
    DiagnosticStatus.STALE: 'stale',
}
_MOST = 500
"""Names that are remembered: nobody reads more, and a made-up publisher may invent them."""


class DiagnosticsBoard:
    """
    The last status of each name.

    A name such as ``/robot1/controller_manager: Hardware`` says whose it is; of any other, the
    first robot.
    """

    def __init__(self) -> None:
        self._items: dict[str, DiagnosticItem] = {}

    def take(self, message: DiagnosticArray, robots: Sequence[str]) -> list[Diagnostics]:
        """Take a message; return what there is to tell of each robot."""
        for status in message.status:
            if status.name in self._items or len(self._items) < _MOST:
                level = _LEVELS.get(status.level, 'stale')
                self._items[status.name] = DiagnosticItem(level, status.name, status.message)  # type: ignore[arg-type]
        return [Diagnostics(robot, self._of(robot, robots)) for robot in robots]

    def _of(self, robot: str, robots: Sequence[str]) -> tuple[DiagnosticItem, ...]:
        return tuple(
            item
            for name, item in sorted(self._items.items())
            if (owner(name, robots) or robots[0]) == robot
        )
