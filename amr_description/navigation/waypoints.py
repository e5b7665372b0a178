# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One goal after the other, each reached with its yaw or missed: Nav2's waypoint follower."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose
from amr_description.navigation.behaviors import DriveStatus, WheelCommand
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.drive import NavigationDrive, NavigationDriveSettings
from amr_description.parameters import parameter

TASK_EXECUTOR_FAILED = 601


@dataclass(frozen=True)
class WaypointSettings:
    """Parameters, by the names of Nav2's waypoint follower."""

    stop_on_failure: bool = parameter(
        False, 'Whether a waypoint that is missed ends all; false as in nav2_bringup'
    )
    waypoint_pause_duration: float = parameter(
        0.2, 'How long the robot stands at each', unit='s', minimum=0.0
    )


@dataclass
class WaypointDrive:
    """Stepped as a drive to goals is."""

    settings: WaypointSettings
    waypoints: Sequence[Pose]
    make: Callable[[Pose], NavigationDrive]
    """Begins a drive to one of them."""
    index: int = 0
    """Of the waypoint that it drives to."""
    loops: int = 0
    """How often all of them are driven to once more."""
    status: DriveStatus = DriveStatus.RUNNING
    error: NavigationError | None = None
    missed: list[tuple[int, NavigationError]] = field(default_factory=list)
    """Index of each that was not reached, and why."""
    started: float | None = None
    """s"""

    def __post_init__(self) -> None:
        self._drive = self.make(self.waypoints[self.index])
        self._plans = 0
        self._stands_until: float | None = None

    @property
    def path(self) -> list[Pose]:
        """Of the drive to this waypoint."""
        return self._drive.path

    @property
    def plans(self) -> int:
        """How many paths there have been."""
        return self._plans + self._drive.plans

    def configure(self, settings: NavigationDriveSettings) -> None:
        """Take other parameters from now on."""
        self._drive.configure(settings)

    def step(
        self, now: float, pose: Pose, speed: tuple[float, float], costmap: Costmap
    ) -> WheelCommand:
        """Return what to do until the next step; standing still at the end."""
        if self.started is None:
            self.started = now
        if self._stands_until is not None:
            if now >= self._stands_until:
                self._go_on()
            return WheelCommand()
        command = self._drive.step(now, pose, speed, costmap)
        if self._drive.status is DriveStatus.SUCCEEDED:
            self._stands_until = now + self.settings.waypoint_pause_duration
        elif self._drive.status is DriveStatus.FAILED:
            error = self._drive.error or NavigationError(TASK_EXECUTOR_FAILED, 'not reached')
            self.missed.append((self.index, error))
            if self.settings.stop_on_failure:
                self.status = DriveStatus.FAILED
                self.error = NavigationError(
                    TASK_EXECUTOR_FAILED,
                    f'failed to reach waypoint {self.index}, and stop_on_failure is set: {error}',
                )
            else:
                self._go_on()
        return command

    def _go_on(self) -> None:
        """Begin with the next waypoint."""
        self._stands_until = None
        self.index += 1
        if self.index == len(self.waypoints):
            if not self.loops:
                self.index -= 1
                self.status = DriveStatus.SUCCEEDED
                return
            self.loops -= 1
            self.index = 0
        self._plans += self._drive.plans
        self._drive = self.make(self.waypoints[self.index])
