# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
gps_sensor_broadcaster/GPSSensorBroadcaster: a satellite fix, on ``~/gps/fix``.

The sensor has the states ``status``, ``service``, ``latitude``, ``longitude``, ``altitude``, and
if asked for ``latitude_covariance``, ``longitude_covariance`` and ``altitude_covariance``. A
status or service that is NaN, or beyond its type, is published as no fix, or as 0.
"""

from dataclasses import dataclass
import math

from amr_description.control.contracts import Output, Port
from amr_description.control.sensor_samples import NavSatFixSample
from amr_description.controllers.sensor_broadcaster import below, SensorBroadcaster
from amr_description.parameters import parameter

_FIX = ('status', 'service', 'latitude', 'longitude', 'altitude')
_VARIANCES = ('latitude_covariance', 'longitude_covariance', 'altitude_covariance')
_DIAGONAL_KNOWN, _KNOWN = 2, 3
"""Of sensor_msgs/NavSatFix."""
_NO_FIX = -1


@dataclass(frozen=True)
class GpsParameters:
    """The table of gps_sensor_broadcaster/GPSSensorBroadcaster."""

    sensor_name: str = parameter('', 'Name of the sensor in <ros2_control>', not_empty=True)
    frame_id: str = parameter('', 'Frame of the antenna', not_empty=True)
    static_position_covariance: tuple[float, ...] = parameter(
        (0.0,) * 9, '3 x 3 of the position, by rows', unit='m^2', length=9
    )
    read_covariance_from_interface: bool = parameter(
        False, 'Read the variances of latitude, longitude and altitude from the sensor'
    )


class GPSSensorBroadcaster(SensorBroadcaster):
    """Publishes the fix at every update."""

    parameters_type = GpsParameters

    def configure(self, parameters: GpsParameters) -> None:
        """Take over names and covariances."""
        self._parameters = parameters
        reads_variances = parameters.read_covariance_from_interface
        self._fix: Output[NavSatFixSample] = Output(
            Port('~/gps/fix', 'sensor_msgs/msg/NavSatFix', sample=NavSatFixSample)
        )
        interfaces = (*_FIX, *(_VARIANCES if reads_variances else ()))
        self._read_from(below(parameters.sensor_name, *interfaces), self._fix)

    def update(self, time: int, period: int) -> None:
        """Publish the fix."""
        status, service, latitude, longitude, altitude, *variances = self._values()
        covariance, kind = self._parameters.static_position_covariance, _KNOWN
        if variances:
            zeros = (0.0, 0.0, 0.0)
            covariance = (variances[0], *zeros, variances[1], *zeros, variances[2])
            kind = _DIAGONAL_KNOWN
        self._fix.send(
            NavSatFixSample(
                time,
                self._parameters.frame_id,
                _whole(status, -128, 127, _NO_FIX),
                _whole(service, 0, 65535, 0),
                latitude,
                longitude,
                altitude,
                covariance,
                kind,
            )
        )


def _whole(value: float, least: int, greatest: int, otherwise: int) -> int:
    if not math.isfinite(value) or not least <= value <= greatest:
        return otherwise
    return int(value)
