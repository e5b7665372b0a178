# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How a robot that is stuck may get free: Nav2's behaviors ``spin``, ``wait`` and ``backup``."""

from dataclasses import dataclass
import math

from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.footprint import placed, Points
from amr_description.parameters import parameter


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


class Recovery:
    """One attempt."""

    def __init__(
        self, settings: RecoverySettings, outline: Points, pose: Pose, now: float
    ) -> None:
        """Begin: ``outline`` (n, 2), m, of the robot at ``pose``, at ``now``, s."""
        self.settings = settings
        self._outline = outline
        self._began = now
        self._first = self._last = pose

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity, m/s and rad/s; None when it is over, or nothing more is safe."""
        raise NotImplementedError

    def _is_late(self, now: float) -> bool:
        return now - self._began > self.settings.time_allowance

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
        return not any(costmap.is_blocked(placed(self._outline, each)) for each in moved)


class Spin(Recovery):
    """Turn on the spot, which lets the lidar see anew."""

    _turned = 0.0

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Recovery.step`."""
        self._turned += wrapped(pose.yaw - self._last.yaw)
        self._last = pose
        left = self.settings.spin_dist - self._turned
        rate = min(self.settings.rotational_vel, math.sqrt(2.0 * 3.2 * max(left, 0.0)))
        if left <= 0.01 or self._is_late(now):
            return None
        if not self._is_safe(pose, 0.0, rate, left / rate, costmap):
            return None
        return 0.0, rate


class Wait(Recovery):
    """Stand still until somebody has gone away."""

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Recovery.step`."""
        return (0.0, 0.0) if now - self._began < self.settings.wait_duration else None


class BackUp(Recovery):
    """Drive straight back."""

    def step(self, now: float, pose: Pose, costmap: Costmap) -> tuple[float, float] | None:
        """Return the velocity; see :meth:`Recovery.step`."""
        left = self.settings.backup_dist - pose.distance(self._first)
        speed = self.settings.backup_speed
        if left <= 0.0 or self._is_late(now):
            return None
        if not self._is_safe(pose, -speed, 0.0, left / speed, costmap):
            return None
        return -speed, 0.0


RECOVERIES: tuple[type[Recovery], ...] = (Spin, Wait, BackUp)
"""In the order in which they are tried."""
