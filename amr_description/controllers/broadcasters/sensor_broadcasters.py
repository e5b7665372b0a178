# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The broadcasters that publish the states of one sensor at every update, and command nothing.

============================== ================== ==============================================
``IMUSensorBroadcaster``       ``~/imu``          an inertial measurement unit
``PoseBroadcaster``            ``~/pose``, /tf    a measured pose
``RangeSensorBroadcaster``     ``~/range``        a distance
``GPSSensorBroadcaster``       ``~/gps/fix``      a satellite fix
``MagnetometerBroadcaster``    ``~/magnetic_field`` a magnetic field
============================== ================== ==============================================

The sensor is one of the ``<ros2_control>`` block. Covariances are parameters.
"""

from dataclasses import dataclass
import math

from amr_description.control.contracts import Output, Port
from amr_description.control.interfaces import (
    IMU_INTERFACES,
)
from amr_description.control.samples import ImuConstants, ImuSample
from amr_description.control.sensor_samples import (
    MagneticFieldSample,
    NavSatFixSample,
    PoseSample,
    RangeConstants,
    RangeSample,
)
from amr_description.controllers.broadcasters.sensor_broadcaster import (
    axes,
    below,
    SensorBroadcaster,
)
from amr_description.log import Severity
from amr_description.parameters import group, parameter

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
    """
    Publishes an inertial measurement unit as ``~/imu``.

    The sensor has the ten states of
    :data:`~amr_description.control.interfaces.IMU_INTERFACES`.
    """

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


_UNIT = 10e-3
"""How far from 1 the square of a quaternion's norm may be, as in the original."""


@dataclass(frozen=True)
class TransformParameters:
    """How the pose is published on /tf."""

    enable: bool = parameter(True, 'Publish the pose on /tf too')
    child_frame_id: str = parameter('', 'Frame that has the pose; empty: pose_name')
    publish_rate: float = parameter(
        0.0, 'Deprecated, ignored: every update publishes', unit='Hz', minimum=0.0
    )


@dataclass(frozen=True)
class PoseParameters:
    """The table of pose_broadcaster/PoseBroadcaster."""

    frame_id: str = parameter('', 'Frame in which the pose is', not_empty=True)
    pose_name: str = parameter('', 'Name of the sensor in <ros2_control>', not_empty=True)
    tf: TransformParameters = group('tf', TransformParameters)


class PoseBroadcaster(SensorBroadcaster):
    """
    Publishes a pose on ``~/pose`` and as a transform on ``/tf``.

    The sensor has the states ``position.x`` … ``position.z``, ``orientation.x`` …
    ``orientation.w``.
    """

    parameters_type = PoseParameters

    def configure(self, parameters: PoseParameters) -> None:
        """Take over names and frames."""
        self._frame_id = parameters.frame_id
        self._child_frame_id = parameters.tf.child_frame_id or parameters.pose_name
        if parameters.tf.publish_rate != 0.0:
            self.log(
                Severity.WARN,
                '[deprecated] tf.publish_rate parameter is deprecated, please set the value to '
                '0.0. The publish rate of TF messages is no longer limited by this parameter.',
            )
        self._pose: Output[PoseSample] = Output(
            Port('~/pose', 'geometry_msgs/msg/PoseStamped', sample=PoseSample)
        )
        self._transform: Output[PoseSample] = Output(
            Port('/tf', 'tf2_msgs/msg/TFMessage', sample=PoseSample)
        )
        self._read_from(
            below(parameters.pose_name, *axes('position'), *axes('orientation', 'xyzw')),
            self._pose,
            *([self._transform] if parameters.tf.enable else []),
        )

    def update(self, time: int, period: int) -> None:
        """Publish the pose, and the transform if it is one."""
        values = self._values()
        sample = PoseSample(time, self._frame_id, self._child_frame_id, values[:3], values[3:])
        self._pose.send(sample)
        squared = sum(value * value for value in sample.orientation)
        if not all(map(math.isfinite, values)) or abs(squared - 1.0) > _UNIT:
            position, orientation = (
                ', '.join(f'{value:f}' for value in part)
                for part in (sample.position, sample.orientation)
            )
            text = f'Invalid pose [{position}], [{orientation}]'
            self.log(Severity.ERROR, text, throttle=1.0)
        else:
            self._transform.send(sample)


@dataclass(frozen=True)
class RangeParameters:
    """The table of range_sensor_broadcaster/RangeSensorBroadcaster."""

    sensor_name: str = parameter('', 'Name of the sensor in <ros2_control>', not_empty=True)
    frame_id: str = parameter('', 'Frame of the sensor, which looks along x', not_empty=True)
    radiation_type: int = parameter(0, '0: ultrasound, 1: infrared', minimum=0, maximum=255)
    field_of_view: float = parameter(0.52, 'Angle in which an object is seen', unit='rad')
    min_range: float = parameter(0.52, 'Shortest distance that is measured', unit='m')
    max_range: float = parameter(4.0, 'Longest distance that is measured', unit='m')
    variance: float = parameter(0.0, 'Variance of the distance', unit='m^2')


class RangeSensorBroadcaster(SensorBroadcaster):
    """Publishes the state ``range``, m, on ``~/range``."""

    parameters_type = RangeParameters

    def configure(self, parameters: RangeParameters) -> None:
        """Take over names and constants."""
        self._constants = RangeConstants(
            parameters.frame_id,
            parameters.radiation_type,
            parameters.field_of_view,
            parameters.min_range,
            parameters.max_range,
            parameters.variance,
        )
        self._range: Output[RangeSample] = Output(
            Port('~/range', 'sensor_msgs/msg/Range', sample=RangeSample)
        )
        self._read_from(below(parameters.sensor_name, 'range'), self._range)

    def update(self, time: int, period: int) -> None:
        """Publish the distance."""
        self._range.send(RangeSample(time, self._values()[0], self._constants))


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
    """
    Publishes a satellite fix on ``~/gps/fix``.

    The sensor has the states ``status``, ``service``, ``latitude``, ``longitude``, ``altitude``,
    and if asked for ``latitude_covariance``, ``longitude_covariance`` and
    ``altitude_covariance``. A status or service that is NaN, or beyond its type, is published as
    no fix, or as 0.
    """

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
    """
    Publishes a magnetic field on ``~/magnetic_field``.

    The sensor has the states ``magnetic_field.x``, ``magnetic_field.y``, ``magnetic_field.z``, T.
    """

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
