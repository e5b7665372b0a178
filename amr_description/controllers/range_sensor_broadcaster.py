# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""range_sensor_broadcaster/RangeSensorBroadcaster: the state ``range``, m, on ``~/range``."""

from dataclasses import dataclass

from amr_description.control.contracts import Output, Port
from amr_description.control.sensor_samples import RangeConstants, RangeSample
from amr_description.controllers.sensor_broadcaster import below, SensorBroadcaster
from amr_description.parameters import parameter


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
    """Publishes the distance at every update."""

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
