# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
imu_sensor_broadcaster/IMUSensorBroadcaster: publishes an inertial measurement unit as ``~/imu``.

The sensor is one of the ``<ros2_control>`` block, with the ten state interfaces of
:data:`~amr_description.control.interfaces.IMU_INTERFACES`. Covariances are parameters.
"""

from dataclasses import dataclass

from amr_description.control.contracts import Output, Port
from amr_description.control.interfaces import IMU_INTERFACES
from amr_description.control.samples import ImuConstants, ImuSample
from amr_description.controllers.sensor_broadcaster import below, SensorBroadcaster
from amr_description.parameters import parameter

_ZEROS = (0.0,) * 9


@dataclass(frozen=True)
class ImuParameters:
    """The table of imu_sensor_broadcaster/IMUSensorBroadcaster."""

    sensor_name: str = parameter('', 'Name of the sensor in <ros2_control>', not_empty=True)
    frame_id: str = parameter('', 'Frame in which the values are', not_empty=True)
    static_covariance_orientation: tuple[float, ...] = parameter(
        _ZEROS, '3 x 3 about x, y, z, by rows', unit='rad^2', length=9
    )
    static_covariance_angular_velocity: tuple[float, ...] = parameter(
        _ZEROS, '3 x 3 about x, y, z, by rows', unit='(rad/s)^2', length=9
    )
    static_covariance_linear_acceleration: tuple[float, ...] = parameter(
        _ZEROS, '3 x 3 along x, y, z, by rows', unit='(m/s^2)^2', length=9
    )


class IMUSensorBroadcaster(SensorBroadcaster):
    """Publishes the states of the sensor at every update."""

    parameters_type = ImuParameters

    def configure(self, parameters: ImuParameters) -> None:
        """Take over the names and the covariances."""
        self._constants = ImuConstants(
            parameters.frame_id,
            parameters.static_covariance_orientation,
            parameters.static_covariance_angular_velocity,
            parameters.static_covariance_linear_acceleration,
        )
        self._imu: Output[ImuSample] = Output(
            Port('~/imu', 'sensor_msgs/msg/Imu', sample=ImuSample)
        )
        self._read_from(below(parameters.sensor_name, *IMU_INTERFACES), self._imu)

    def update(self, time: int, period: int) -> None:
        """Publish the present states."""
        values = self._values()
        self._imu.send(ImuSample(time, values[:4], values[4:7], values[7:], self._constants))
