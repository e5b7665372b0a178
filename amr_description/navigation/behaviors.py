# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Simple motions with an end, as of Nav2's behavior server: turn, back up, drive on, wait, teleop.

A navigator tries some of them when a robot is stuck; each is an action of its own, too.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
import math

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.footprint import placed, Points
from amr_description.parameters import parameter

_ROTATIONAL_ACCELERATION = 3.2
"""rad/s², by which a spin ends: Nav2's ``rotational_acc_lim``."""
_LOOK_AHEAD = 1.0
"""s ahead in which assisted teleop looks for collisions: Nav2's ``projection_time`` …"""
_LOOK_STEPS = 10
"""… in steps of its ``simulation_time_step``, 0.1 s."""


@dataclass(frozen=True)
class RecoverySettings:
    """Parameters, by the names of Nav2's behavior server and of its behavior tree."""

    spin_dist: float = parameter(1.57, 'Angle of a spin', unit='rad', minimum=0.0)
    rotational_vel: float = parameter(0.8, 'Of a spin', unit='rad/s', minimum=0.01)
    wait_duration: float = parameter(5.0, 'Of a wait', unit='s', minimum=0.0)
    backup_dist: float = parameter(0.3, 'How far it backs up', unit='m', minimum=0.0)
    backup_speed: float = parameter(0.15, 'How fast', unit='m/s', minimum=0.01)
    time_allowance: float = parameter(10.0, 'Of a spin or a backup', unit='s', minimum=0.0)
    simulate_ahead_time: float = parameter(
        2.0, 'How far ahead collisions are looked for', unit='s', minimum=0.0
    )


class DriveStatus(Enum):
    """How a drive is going."""

    RUNNING = 'running'
    SUCCEEDED = 'succeeded'
    FAILED = 'failed'


@dataclass
class WheelCommand:
    """What the wheels shall do now."""

    linear: float = 0.0
    """m/s"""
    angular: float = 0.0
    """rad/s"""
    lookahead: Pose | None = None
    """What it drives to, in the frame of the map; None while it does not follow a path."""


class Behavior:
    """
    One motion.

    Attributes:
        error: Why it has ended too early; its code is the first one of the behavior's action, 1
            more where the time was over, and ``COLLISION`` more where something is in the way.
        done: How far it has come: m, rad or s.
    """

    CODE = 0
    COLLISION = 3

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        allowance: float | None = None,
    ) -> None:
        """
        Begin.

        Args:
            settings: Of all behaviors.
            outline: (n, 2), m, of the robot.
            pose: Where it is.
            now: s.
            allowance: s that it may take; 0: as long as it takes; None: that of the settings.
        """
        self.settings = settings
        self.error: NavigationError | None = None
        self.done = 0.0
        self._outline = outline
        self._allowance = settings.time_allowance if allowance is None else allowance
        self._began = now
        self._first = self._last = pose

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity, m/s and rad/s; None when it is over, or nothing more is safe."""
        raise NotImplementedError

    def _is_late(self, now: float) -> bool:
        if not self._allowance or now - self._began <= self._allowance:
            return False
        self.error = NavigationError(
            self.CODE + 1, f'exceeded the time allowance of {self._allowance:g} s'
        )
        return True

    def _is_safe(
        self, pose: Pose, linear: float, angular: float, left: float, costmap: Costmap
    ) -> bool:
        """Return whether the robot stays free for ``left`` s, as far as it is looked at."""
        seconds = min(left, self.settings.simulate_ahead_time)
        count = max(
            1, math.ceil(seconds * (abs(linear) + 0.5 * abs(angular)) / costmap.resolution)
        )
        moved = (
            pose.compose(Pose(linear * seconds * k / count, 0.0, angular * seconds * k / count))
            for k in range(1, count + 1)
        )
        if not any(costmap.is_blocked(placed(self._outline, each)) for each in moved):
            return True
        self.error = NavigationError(
            self.CODE + self.COLLISION, 'collision ahead: the robot would touch an obstacle'
        )
        return False


class Spin(Behavior):
    """Turn on the spot, which lets the lidar see anew."""

    CODE = 700

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        angle: float | None = None,
        allowance: float | None = None,
    ) -> None:
        """Begin; ``angle``: rad, counter-clockwise; None: that of the settings."""
        super().__init__(settings, outline, pose, now, allowance=allowance)
        angle = settings.spin_dist if angle is None else angle
        self._angle, self._sign = abs(angle), math.copysign(1.0, angle)

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Behavior.step`."""
        self.done += self._sign * wrapped(pose.yaw - self._last.yaw)
        self._last = pose
        left = self._angle - self.done
        rate = min(
            self.settings.rotational_vel,
            math.sqrt(2.0 * _ROTATIONAL_ACCELERATION * max(left, 0.0)),
        )
        if left <= 0.01 or self._is_late(now):
            return None
        if not self._is_safe(pose, 0.0, self._sign * rate, left / rate, costmap):
            return None
        return 0.0, self._sign * rate


class Wait(Behavior):
    """Stand still until somebody has gone away."""

    CODE = 740

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        seconds: float | None = None,
    ) -> None:
        """Begin; ``seconds`` None: as the settings say."""
        super().__init__(settings, outline, pose, now)
        self.seconds = settings.wait_duration if seconds is None else seconds

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Behavior.step`."""
        self.done = now - self._began
        return (0.0, 0.0) if self.done < self.seconds else None


class DriveOnHeading(Behavior):
    """Drive straight ahead."""

    CODE = 720

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        distance: float | None = None,
        speed: float | None = None,
        allowance: float | None = None,
    ) -> None:
        """Begin: ``distance`` m at ``speed`` m/s, below 0: back; None: as the settings say."""
        super().__init__(settings, outline, pose, now, allowance=allowance)
        self._distance = abs(settings.backup_dist if distance is None else distance)
        self._speed = settings.backup_speed if speed is None else speed

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Behavior.step`."""
        self.done = pose.distance(self._first)
        left = self._distance - self.done
        if left <= 0.0 or self._is_late(now):
            return None
        if not self._is_safe(pose, self._speed, 0.0, left / abs(self._speed), costmap):
            return None
        return self._speed, 0.0


class BackUp(DriveOnHeading):
    """Drive straight back."""

    CODE, COLLISION = 710, 4

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        distance: float | None = None,
        speed: float | None = None,
        allowance: float | None = None,
    ) -> None:
        """Begin; whatever the signs of distance and speed."""
        back = -abs(settings.backup_speed if speed is None else speed)
        super().__init__(
            settings, outline, pose, now, distance=distance, speed=back, allowance=allowance
        )


class AssistedTeleop(Behavior):
    """Drive as somebody commands, but slower before obstacles, and into none."""

    CODE = 730

    def __init__(
        self,
        settings: RecoverySettings,
        outline: Points,
        pose: Pose,
        now: float,
        *,
        command: Callable[[], tuple[float, float] | None],
        allowance: float | None = None,
    ) -> None:
        """Begin; ``command`` returns what is wanted now, m/s and rad/s; None: an end."""
        super().__init__(settings, outline, pose, now, allowance=allowance)
        self._command = command

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Behavior.step`."""
        self.done = now - self._began
        wanted = self._command()
        if wanted is None or self._is_late(now):
            return None
        linear, angular = wanted
        for step in range(1, _LOOK_STEPS + 1):
            ahead = _LOOK_AHEAD * step / _LOOK_STEPS
            there = pose.compose(Pose(linear * ahead, 0.0, angular * ahead))
            if costmap.is_blocked(placed(self._outline, there)):
                share = 0.0 if step == 1 else (step - 1) / _LOOK_STEPS
                return linear * share, angular * share
        return wanted


RECOVERIES: tuple[type[Spin] | type[Wait] | type[BackUp], ...] = (Spin, Wait, BackUp)
"""In the order in which they are tried."""


@dataclass
class BehaviorDrive:
    """One behavior from its first step to its end, stepped as a drive to goals is."""

    make: Callable[[Pose, float], Behavior]
    """Begins it, with pose and time."""
    status: DriveStatus = DriveStatus.RUNNING
    error: NavigationError | None = None
    started: float | None = None
    """s"""
    behavior: Behavior | None = None
    """None before the first step."""
    path: list[Pose] = field(default_factory=list)
    plans: int = 0
    """It plans nothing."""

    def configure(self, settings: object) -> None:
        """Keep what it was begun with."""

    def step(
        self, now: float, pose: Pose, speed: tuple[float, float], costmap: Costmap
    ) -> WheelCommand:
        """Return what to do until the next step; standing still at the end."""
        if self.behavior is None:
            self.behavior, self.started = self.make(pose, now), now
        command = self.behavior.step(now, pose, costmap)
        if command is not None:
            return WheelCommand(*command)
        self.error = self.behavior.error
        self.status = DriveStatus.SUCCEEDED if self.error is None else DriveStatus.FAILED
        return WheelCommand()
