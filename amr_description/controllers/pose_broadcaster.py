# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
pose_broadcaster/PoseBroadcaster: a measured pose, on ``~/pose`` and as a transform on ``/tf``.

The sensor has the states ``position.x`` … ``position.z``, ``orientation.x`` … ``orientation.w``.
"""

from dataclasses import dataclass
import math

from amr_description.control.contracts import Output, Port
from amr_description.control.sensor_samples import PoseSample
from amr_description.controllers.sensor_broadcaster import axes, below, SensorBroadcaster
from amr_description.log import Severity
from amr_description.parameters import group, parameter

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
    """Publishes the pose at every update."""

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
