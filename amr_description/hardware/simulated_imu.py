# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An inertial measurement unit of a simulated robot: a ``<sensor>`` of the ``<ros2_control>`` block.

Its orientation is relative to the world, not to the start; with ``<localization>`` of the Gazebo
sensor, relative to the frame that is named there
(:attr:`~amr_description.model.gazebo.GazeboSensor.reference`).
"""

from collections.abc import Sequence

from amr_description.control.interfaces import IMU_INTERFACES, StateInterface
from amr_description.control.world import World
from amr_description.hardware.simulated_sensor import Mount, SimulatedSensor
from amr_description.model.frames import conjugate, multiply


class SimulatedImu(SimulatedSensor):
    """The state interfaces of a unit: unit quaternion, rad/s and m/s², gravity included."""

    interfaces = IMU_INTERFACES

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """Take a unit."""
        super().__init__(states, world, mount)
        reference = None if mount.gazebo is None else mount.gazebo.reference
        self._to_reference = None if reference is None else conjugate(reference)

    def measure(self, period: float) -> Sequence[float]:
        """Return what the unit measures; ``period``: since the previous call, s."""
        reading = self.world.imu(self.mount.link, self.mount.pose)
        orientation = reading.orientation
        if self._to_reference is not None:
            orientation = multiply(self._to_reference, orientation)
        # In the order of IMU_INTERFACES.
        return (*orientation, *reading.angular_velocity, *reading.linear_acceleration)
