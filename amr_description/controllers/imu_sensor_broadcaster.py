# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
imu_sensor_broadcaster/IMUSensorBroadcaster: publishes an inertial measurement unit as ``~/imu``.

The sensor is one of the ``<ros2_control>`` block, with the ten state interfaces of
:data:`~amr_description.control.interfaces.IMU_INTERFACES`. Covariances are parameters.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from amr_description.control.contracts import Controller, Output, Port
from amr_description.control.interfaces import (
    CommandInterface,
    IMU_INTERFACES,
    InterfaceRequest,
    StateInterface,
)
from amr_description.control.samples import ImuConstants, ImuSample
from amr_description.errors import ControllerError
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


class IMUSensorBroadcaster(Controller):
    """Publishes the states of the sensor at every update."""

    parameters_type = ImuParameters

    def configure(self, parameters: ImuParameters) -> None:
        """Take over the names and the covariances."""
        self._request = InterfaceRequest.individual(
            f'{parameters.sensor_name}/{interface}' for interface in IMU_INTERFACES
        )
        self._constants = ImuConstants(
            parameters.frame_id,
            parameters.static_covariance_orientation,
            parameters.static_covariance_angular_velocity,
            parameters.static_covariance_linear_acceleration,
        )
        self._imu: Output[ImuSample] = Output(
            Port('~/imu', 'sensor_msgs/msg/Imu', sample=ImuSample)
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return the ten of the sensor."""
        return self._request

    def outputs(self) -> tuple[Output[ImuSample], ...]:
        """Return ``~/imu``."""
        return (self._imu,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces. Raises ControllerError: some are missing."""
        if len(states) != len(IMU_INTERFACES):
            raise ControllerError(
                f'Expected {len(IMU_INTERFACES)} state interfaces, got {len(states)}'
            )
        self._states = tuple(states)

    def update(self, time: int, period: int) -> None:
        """Publish the present states."""
        values = tuple([state.value for state in self._states])
        self._imu.send(ImuSample(time, values[:4], values[4:7], values[7:], self._constants))

    def deactivate(self, time: int) -> None:
        """Drop the interfaces."""
        self._states = ()
