# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/GazeboOdometryPublisher: the true pose of a link as odometry, without errors.

So Gazebo's p3d and OdometryPublisher publish it, and drives of Gazebo Classic whose odometry has
the world as its source. The pose is that in the world, not from where the robot was spawned::

    transform = T_link T_offset              (OdometryPublisher)
    position  = p_link + p_offset,  orientation = q_offset q_link       (p3d: offset.in_world)
"""

from collections.abc import Sequence
from dataclasses import dataclass

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller, Output, Port
from amr_description.control.interfaces import CommandInterface, InterfaceRequest, StateInterface
from amr_description.control.samples import BodyOdometrySample, Frames
from amr_description.controllers.drives.diff_drive_controller import PublishGate
from amr_description.model.base_interfaces import TRUTH, truth_prefix
from amr_description.model.frames import (
    multiply,
    quaternion_from_yaw,
    rotate,
    Transform,
    Vector,
    yaw_of,
)
from amr_description.parameters import group, parameter

_SIX_ZEROS = (0.0,) * 6
_ZEROS = (0.0, 0.0, 0.0)
_FLAT = 2


@dataclass(frozen=True)
class OffsetParameters:
    """What is added to the pose."""

    xyz: tuple[float, ...] = parameter(_ZEROS, 'Translation', unit='m', length=3)
    rpy: tuple[float, ...] = parameter(_ZEROS, 'Roll, pitch, yaw', unit='rad', length=3)
    in_world: bool = parameter(False, "Along the world's axes, not the link's")


@dataclass(frozen=True)
class GazeboOdometryPublisherParameters:
    """The table of amr_description/GazeboOdometryPublisher."""

    link: str = parameter('', 'The link whose motion is published', not_empty=True)
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given')
    base_frame_id: str = parameter('base_footprint', 'Frame whose pose is given')
    publish_rate: float = parameter(
        50.0, 'Rate of odometry and transform', unit='Hz', above=0.0, magnitude=(1e-3, 1e5)
    )
    publish_odom: bool = parameter(True, 'Publish odometry on ~/odom')
    enable_odom_tf: bool = parameter(True, 'Publish the transform on /tf')
    dimensions: int = parameter(3, '2: z, roll and pitch are zero', minimum=_FLAT, maximum=3)
    twist_in_world: bool = parameter(False, "The twist along the world's axes, not the link's")
    offset: OffsetParameters = group('offset', OffsetParameters)
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of x, y, z, roll, pitch, yaw', unit='m², rad²', length=6
    )
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the twist, in the same order', unit='m²/s², rad²/s²', length=6
    )


class GazeboOdometryPublisher(Controller):
    """Publishes the states of one link; see the module."""

    parameters_type = GazeboOdometryPublisherParameters

    def configure(self, parameters: GazeboOdometryPublisherParameters) -> None:
        """Take over the names and the offset."""
        self._parameters = parameters
        roll, pitch, yaw = parameters.offset.rpy
        self._offset = Transform.from_xyz_rpy(_vector(parameters.offset.xyz), (roll, pitch, yaw))
        self._frames = Frames(
            parameters.odom_frame_id,
            parameters.base_frame_id,
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        self._gate = PublishGate(int(NANOSECONDS / parameters.publish_rate))
        self._states: Sequence[StateInterface] = ()
        self._odom: Output[BodyOdometrySample] = Output(
            Port('~/odom', 'nav_msgs/msg/Odometry', sample=BodyOdometrySample)
        )
        self._transform: Output[BodyOdometrySample] = Output(
            Port('/tf', 'tf2_msgs/msg/TFMessage', sample=BodyOdometrySample)
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return pose and velocity of the link."""
        prefix = truth_prefix(self._parameters.link)
        return InterfaceRequest.individual(f'{prefix}/{each}' for each in TRUTH)

    def outputs(self) -> tuple[Output[BodyOdometrySample], ...]:
        """Return those of ``~/odom`` and ``/tf`` that are wanted."""
        wanted = (
            (self._odom, self._parameters.publish_odom),
            (self._transform, self._parameters.enable_odom_tf),
        )
        return tuple(output for output, is_wanted in wanted if is_wanted)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the states. Raises ControllerError: some are missing."""
        self.state_interfaces().require_all(states, 'state')
        self._states = states
        self._gate.reset()

    def update(self, time: int, period: int) -> None:
        """Publish the present states, if they are due."""
        if not self._gate.passes(time):
            return
        values = [state.value for state in self._states]
        x, y, z, w = values[3:7]
        pose = self._moved(Transform(_vector(values[:3]), (x, y, z, w)))
        linear, angular = _vector(values[7:10]), _vector(values[10:])
        if self._parameters.twist_in_world:
            linear, angular = rotate((x, y, z, w), linear), rotate((x, y, z, w), angular)
        if self._parameters.dimensions == _FLAT:
            pose = _flat(pose)
            linear, angular = (linear[0], linear[1], 0.0), (0.0, 0.0, angular[2])
        sample = BodyOdometrySample(time, pose, linear, angular, self._frames)
        for output in self.outputs():
            output.send(sample)

    def deactivate(self, time: int) -> None:
        """Drop the interfaces."""
        self._states = ()

    def reset(self, time: int) -> None:
        """Publish at the next update."""
        self._gate.reset()

    def _moved(self, pose: Transform) -> Transform:
        offset = self._offset
        if not self._parameters.offset.in_world:
            return pose @ offset
        translation = [a + b for a, b in zip(pose.translation, offset.translation, strict=True)]
        return Transform(_vector(translation), multiply(offset.rotation, pose.rotation))


def _flat(pose: Transform) -> Transform:
    """Return a pose without height, roll and pitch."""
    x, y, _ = pose.translation
    return Transform((x, y, 0.0), quaternion_from_yaw(yaw_of(pose.rotation)))


def _vector(values: Sequence[float]) -> Vector:
    x, y, z = values
    return x, y, z
