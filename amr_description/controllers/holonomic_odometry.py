# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Planar odometry of a drive that can go sideways: mecanum and omni wheels."""

import math

from amr_description.control.samples import Frames, OdometrySample

_SMALL_TURN = 1e-6
"""rad: below it the radius of the arc is ill-conditioned."""


class HolonomicOdometry:
    """
    Integrates the pose: x, y in m, heading in rad, not wrapped.

    ``linear``, ``lateral`` (m/s) and ``angular`` (rad/s) are the latest twist, in the frame of the
    base; it is not filtered, as in the originals.
    """

    def __init__(self) -> None:
        """Start at the origin."""
        self.reset()

    def reset(self) -> None:
        """Go to the origin, at rest."""
        self.x = self.y = self.heading = 0.0
        self.linear = self.lateral = self.angular = 0.0

    def update(self, twist: tuple[float, float, float], dt: float) -> None:
        """
        Integrate a twist (m/s, m/s, rad/s) over ``dt`` (s) exactly: along an arc.

        As in omni_wheel_drive_controller 4.x.
        """
        self.linear, self.lateral, self.angular = twist
        along, across, turn = self.linear * dt, self.lateral * dt, self.angular * dt
        before = self.heading
        self.heading = before + turn
        if abs(turn) < _SMALL_TURN:
            cosine, sine = math.cos(before), math.sin(before)
        else:
            cosine = (math.sin(self.heading) - math.sin(before)) / turn
            sine = (math.cos(before) - math.cos(self.heading)) / turn
        self.x += along * cosine - across * sine
        self.y += along * sine + across * cosine

    def update_after_turn(self, twist: tuple[float, float, float], dt: float) -> None:
        """
        Integrate a twist over ``dt`` along the heading that it ends with.

        As in mecanum_drive_controller 4.x; on a turn it is off by half of the turn of one period.
        """
        self.linear, self.lateral, self.angular = twist
        self.heading += self.angular * dt
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        self.x += (self.linear * cosine - self.lateral * sine) * dt
        self.y += (self.linear * sine + self.lateral * cosine) * dt

    def sample(self, time: int, frames: Frames) -> OdometrySample:
        """Return what to publish at ``time``, ns."""
        return OdometrySample(
            stamp=time,
            x=self.x,
            y=self.y,
            heading=self.heading,
            linear=self.linear,
            angular=self.angular,
            frames=frames,
            lateral=self.lateral,
        )
