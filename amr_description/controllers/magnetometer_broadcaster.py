# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
magnetometer_broadcaster/MagnetometerBroadcaster: a magnetic field, on ``~/magnetic_field``.

The sensor has the states ``magnetic_field.x``, ``magnetic_field.y`` and ``magnetic_field.z``, T.
"""

from dataclasses import dataclass

from amr_description.control.contracts import Output, Port
from amr_description.control.sensor_samples import MagneticFieldSample
from amr_description.controllers.sensor_broadcaster import axes, below, SensorBroadcaster
from amr_description.parameters import parameter


@dataclass(frozen=True)
class MagnetometerParameters:
    """The table of magnetometer_broadcaster/MagnetometerBroadcaster."""

    sensor_name: str = parameter(
        '', 'Name of the sensor in <ros2_control>', not_empty=True, read_only=True
    )
    frame_id: str = parameter('', 'Frame of the sensor', not_empty=True, read_only=True)
    static_covariance: tuple[float, ...] = parameter(
        (0.0,) * 9, '3 x 3 along x, y, z, by rows', unit='T^2', length=9, read_only=True
    )


class MagnetometerBroadcaster(SensorBroadcaster):
    """Publishes the field at every update."""

    parameters_type = MagnetometerParameters

    def configure(self, parameters: MagnetometerParameters) -> None:
        """Take over names and the covariance."""
        self._parameters = parameters
        self._field: Output[MagneticFieldSample] = Output(
            Port('~/magnetic_field', 'sensor_msgs/msg/MagneticField', sample=MagneticFieldSample)
        )
        self._read_from(below(parameters.sensor_name, *axes('magnetic_field')), self._field)

    def update(self, time: int, period: int) -> None:
        """Publish the field."""
        self._field.send(
            MagneticFieldSample(
                time,
                self._parameters.frame_id,
                self._values(),
                self._parameters.static_covariance,
            )
        )
