# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of ROS → samples of the shipped controllers, and the table of these converters.

They read attributes only, so that a message may be of rclpy, or a plain one.
"""

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import ActionPort, Port, ServicePort
from amr_description.control.dof_samples import DofCommandSample, GripperGoal, SetBoolRequest
from amr_description.control.samples import CommandsSample, EmptySample, FlagSample, TwistSample
from amr_description.control.sensor_samples import InterfaceGroup, InterfaceGroupsSample
from amr_description.control.trajectory_samples import (
    FollowTrajectoryGoal,
    JointTolerance,
    QueryStateRequest,
    SpeedScalingSample,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.errors import ControllerError
from amr_description.registry import resolve

Function = TypeVar('Function')
Key = tuple[type | None, str]
"""Type of a port's samples, and of its messages."""


def twist_sample(message: Any) -> TwistSample:
    """Keep the raw stamp (zero stays zero) and the planar part."""
    return TwistSample(
        stamp=_nanoseconds(message.header.stamp),
        linear=message.twist.linear.x,
        angular=message.twist.angular.z,
        frame_id=message.header.frame_id,
        lateral=message.twist.linear.y,
    )


def unstamped_twist_sample(message: Any) -> TwistSample:
    """Keep the planar part; there is no stamp."""
    return TwistSample(
        stamp=0, linear=message.linear.x, angular=message.angular.z, lateral=message.linear.y
    )


def empty_sample(request: Any) -> EmptySample:
    """Return a request without fields."""
    return EmptySample()


def commands_sample(message: Any) -> CommandsSample:
    """Keep the numbers; a plain list needs no layout."""
    return CommandsSample(tuple(message.data))


def command_sample(message: Any) -> CommandsSample:
    """Keep the number."""
    return CommandsSample((message.data,))


def flag_sample(message: Any) -> FlagSample:
    """Keep the flag."""
    return FlagSample(message.data)


def dof_command_sample(message: Any) -> DofCommandSample:
    """Keep names and values."""
    return DofCommandSample(
        tuple(message.dof_names), tuple(message.values), tuple(message.values_dot)
    )


def switch_request(message: Any) -> SetBoolRequest:
    """Keep what is asked for."""
    return SetBoolRequest(message.data)


def gripper_goal(message: Any) -> GripperGoal:
    """Keep the position and the greatest effort."""
    command = message.command
    return GripperGoal((command.position,), (), (command.max_effort,))


def parallel_gripper_goal(message: Any) -> GripperGoal:
    """Keep all values."""
    command = message.command
    return GripperGoal(tuple(command.position), tuple(command.velocity), tuple(command.effort))


def interface_groups_sample(message: Any) -> InterfaceGroupsSample:
    """Keep names and values. Raises ValueError: they are not equally many groups."""
    return InterfaceGroupsSample(
        _nanoseconds(message.header.stamp),
        tuple(
            InterfaceGroup(name, tuple(below.interface_names), tuple(below.values))
            for name, below in zip(message.interface_groups, message.interface_values, strict=True)
        ),
    )


def trajectory_sample(message: Any) -> TrajectorySample:
    """Keep all of it but the frame."""
    return TrajectorySample(
        _nanoseconds(message.header.stamp),
        tuple(message.joint_names),
        tuple(map(_point, message.points)),
        tuple(_nanoseconds(point.time_from_start) for point in message.points),
    )


def follow_goal(message: Any) -> FollowTrajectoryGoal:
    """Keep what is about single joints; multi-DOF joints are not followed, as in the original."""
    return FollowTrajectoryGoal(
        trajectory_sample(message.trajectory),
        tuple(map(_tolerance, message.path_tolerance)),
        tuple(map(_tolerance, message.goal_tolerance)),
        _nanoseconds(message.goal_time_tolerance) / NANOSECONDS,
    )


def speed_scaling(message: Any) -> SpeedScalingSample:
    """Keep the factor."""
    return SpeedScalingSample(message.factor)


def query_request(message: Any) -> QueryStateRequest:
    """Keep the time."""
    return QueryStateRequest(_nanoseconds(message.time))


def _point(message: Any) -> TrajectoryPoint:
    return TrajectoryPoint(
        tuple(message.positions),
        tuple(message.velocities),
        tuple(message.accelerations),
        tuple(message.effort),
    )


def _tolerance(message: Any) -> JointTolerance:
    return JointTolerance(message.name, message.position, message.velocity, message.acceleration)


def _nanoseconds(time: Any) -> int:
    """Return a time or a duration as integer nanoseconds."""
    return int(time.sec * NANOSECONDS + time.nanosec)


_GRIPPER = 'control_msgs/action/GripperCommand'
_PARALLEL = 'control_msgs/action/ParallelGripperCommand'
READERS: Mapping[Key, Callable[[Any], Any]] = {
    (CommandsSample, 'std_msgs/msg/Float64'): command_sample,
    (CommandsSample, 'std_msgs/msg/Float64MultiArray'): commands_sample,
    (DofCommandSample, 'control_msgs/msg/MultiDOFCommand'): dof_command_sample,
    (EmptySample, 'std_srvs/srv/Empty_Request'): empty_sample,
    (FlagSample, 'std_msgs/msg/Bool'): flag_sample,
    (FollowTrajectoryGoal, 'control_msgs/action/FollowJointTrajectory_Goal'): follow_goal,
    (GripperGoal, f'{_GRIPPER}_Goal'): gripper_goal,
    (GripperGoal, f'{_PARALLEL}_Goal'): parallel_gripper_goal,
    (InterfaceGroupsSample, 'control_msgs/msg/DynamicInterfaceGroupValues'): (
        interface_groups_sample
    ),
    (QueryStateRequest, 'control_msgs/srv/QueryTrajectoryState_Request'): query_request,
    (SetBoolRequest, 'std_srvs/srv/SetBool_Request'): switch_request,
    (SpeedScalingSample, 'control_msgs/msg/SpeedScalingFactor'): speed_scaling,
    (TrajectorySample, 'trajectory_msgs/msg/JointTrajectory'): trajectory_sample,
    (TwistSample, 'geometry_msgs/msg/Twist'): unstamped_twist_sample,
    (TwistSample, 'geometry_msgs/msg/TwistStamped'): twist_sample,
}


def part_of(port: ServicePort | ActionPort, part: str) -> Port:
    """
    Return a part of a service or an action as the port whose converter it needs.

    Args:
        port: Of the service or action.
        part: ``request`` or ``response``; ``goal``, ``feedback`` or ``result``.
    """
    kind = port.service if isinstance(port, ServicePort) else port.action
    converter, message = getattr(port, part), f'{kind}_{part.capitalize()}'
    if isinstance(converter, str):
        return Port(port.name, message, convert=converter)
    return Port(port.name, message, sample=converter)


def reader_of(port: Port) -> Callable[[Any], Any]:
    """Return ``(message) -> sample`` of an input. Raises whatever finding it raises."""
    if port.convert:
        found: Callable[[Any], Any] = resolve(port.convert)
        return found
    return find(READERS, port)


def find(table: Mapping[Key, Function], port: Port) -> Function:
    """Return the converter of a port. Raises ControllerError: there is none."""
    try:
        return table[port.sample, port.message]
    except KeyError:
        sample = 'no type of sample' if port.sample is None else port.sample.__name__
        raise ControllerError(
            f"There is no converter for '{port.name}' ({port.message}, {sample}); name one as "
            "convert='module:function' of its Port"
        ) from None
