# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What Gazebo's plugins of single joints become: :data:`JOINTS`.
"""

from collections.abc import Callable, Mapping
import math
from typing import Any

from amr_description.model.gazebo.builder import (
    Builder,
    gz_topic,
    LEAST_RATE,
    node_name,
    origin_of,
)
from amr_description.model.gazebo.instruments import add_wrench
from amr_description.model.gazebo.plugins import PluginElement
from amr_description.text import quote, quote_all

_NONE = ''
"""An interface that ``<ros2_control>`` never offers: what has a joint there keeps it."""


def _joint_states(builder: Builder, plugin: PluginElement) -> None:
    if builder.is_controlled:
        plugin.note(
            'it is left out: the robot has <ros2_control>, whose joint_state_broadcaster '
            'publishes its joint states'
        )
        return
    asked = plugin.texts('joint_name')
    joints = [name for name in asked if builder.robot.has_joint(name)]
    if lacking := [name for name in asked if name not in joints]:
        plugin.note(f'there is no joint {quote_all(lacking)}; it publishes the others')
    rate = plugin.number('update_rate', default=float(LEAST_RATE)) if plugin.is_classic else 0.0
    if plugin.is_classic:
        topic = plugin.topic('joint_states')
    else:
        topic = gz_topic(plugin, 'topic', 'joint_states')
        topic = 'joint_states' if topic.endswith('joint_state') else topic
    builder.broadcast(plugin, joints, topic, rate)


def _joint_position(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's: a position by a PID; here by a servo as stiff as the limits allow."""
    initial = plugin.number('initial_position', default=math.nan)
    _joint_command(
        builder, plugin, 'position', 'cmd_pos', initial if math.isfinite(initial) else None
    )


def _joint_velocity(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's JointController: a velocity, or a velocity by a PID of forces."""
    _joint_command(builder, plugin, 'velocity', 'cmd_vel')


def _joint_command(
    builder: Builder,
    plugin: PluginElement,
    interface: str,
    suffix: str,
    initial: float | None = None,
) -> None:
    joints = plugin.texts('joint_name')
    if plugin.flag('use_actuator_msg', default=False):
        plugin.note('it is left out: commands as actuator_msgs/msg/Actuators are not known here')
        return
    if not builder.can_drive(plugin, joints, interface):
        return
    builder.command(joints, interface, initial=initial)
    index = plugin.text('joint_index', default='0')
    # Gazebo has a bare number there, with which no part of a name of ROS may begin.
    index = '' if interface == 'velocity' or index == '0' else f'axis_{index}/'
    inside = f'/model/{builder.robot.name}'
    default = f'{inside}/joint/{joints[0]}/{index}{suffix}'
    if sub_topic := plugin.text('sub_topic'):
        default = f'{inside}/{sub_topic}'
    builder.add(
        'amr_description/GazeboJointCommand',
        {'joints': joints, 'interface_name': interface},
        {'~/command': gz_topic(plugin, 'topic', default)},
        name=node_name(f'{joints[0]}_{interface}', f'joint_{interface}'),
        origin=origin_of(plugin),
    )


def _joint_trajectory(builder: Builder, plugin: PluginElement) -> None:
    """New Gazebo's: trajectories on a topic; here with an action too, as ros2_control has it."""
    movable = [each for each in builder.robot.joints if each.has_position and each.mimic is None]
    joints = plugin.texts('joint_name') or [each.name for each in movable]
    if not builder.can_drive(plugin, joints, 'position'):
        return
    starts = plugin.numbers('initial_position')
    for index, joint in enumerate(joints):
        initial = starts[index] if index < len(starts) else None
        builder.command([joint], 'position', initial=initial)
    parameters: dict[str, Any] = {
        'joints': joints,
        'command_interfaces': ['position'],
        'state_interfaces': ['position', 'velocity'],
        'allow_partial_joints_goal': True,
    }
    builder.add(
        'joint_trajectory_controller/JointTrajectoryController',
        parameters,
        {'~/joint_trajectory': gz_topic(plugin, 'topic', 'joint_trajectory')},
        name='joint_trajectory_controller',
        origin=origin_of(plugin),
    )


def _transmissions(builder: Builder, plugin: PluginElement) -> None:
    """
    ROS 1's host of controllers: its joints can be commanded as ``<transmission>`` says.

    Those that controllers claim, of which the interface may be another one, are left to them, and
    to other plugins what they have, and the wheels beside those that one drives, which roll: in
    Gazebo both live side by side.
    """
    found: dict[str, list[str]] = {}
    for joint in plugin.element.getroottree().iterfind('transmission/joint'):
        for each in joint.iterchildren('hardwareInterface'):
            kind = (each.text or '').strip().rpartition('/')[2].removesuffix('JointInterface')
            interfaces = found.setdefault(joint.get('name', ''), [])
            if kind.lower() in ('position', 'velocity', 'effort'):
                interfaces.append(kind.lower())
    joints = [
        name
        for name, interfaces in found.items()
        if interfaces and not builder.is_claimed(name) and not builder.is_of_drive(name)
    ]
    if not joints or not builder.can_drive(plugin, joints, _NONE):
        return
    for name in joints:
        for interface in dict.fromkeys(found[name]):
            builder.command([name], interface)
    kinds = quote_all([*dict.fromkeys(each for name in joints for each in found[name])])
    builder.remarks.append(
        f'{origin_of(plugin)} is of ROS 1; its {len(joints)} joints of <transmission> can be '
        f'commanded by ros2_control ({kinds}), by controllers of a parameter file that is given'
    )


def _force_torque(builder: Builder, plugin: PluginElement) -> None:
    """Classic's: the wrench in a joint."""
    name = plugin.text('joint_name', 'jointName')
    body = plugin.text('body_name', 'bodyName')
    above = None
    if builder.robot.has_joint(name):
        above = builder.robot.joint(name)
    elif builder.robot.has_link(body):
        above = builder.robot.parent_joint(body)
    if above is None:
        plugin.note(f'it is left out: there is no joint {quote(name or body)}')
        return
    if plugin.number('gaussian_noise', 'gaussianNoise', default=0.0):
        plugin.note('its <gaussian_noise> is left out; <noise> of a sensor is simulated')
    add_wrench(
        builder,
        node_name(plugin.name, 'force_torque_sensor'),
        above.child,
        plugin.text('frame_name', 'frameName') or above.child,
        plugin.topic('wrench', 'topicName'),
        plugin.number('update_rate', 'updateRate', default=0.0),
        plugin.namespace,
    )


JOINTS: Mapping[str, Callable[[Builder, PluginElement], None]] = {
    'gazebo-ros-control': _transmissions,
    'gazebo-ros-ft-sensor': _force_torque,
    'gazebo-ros-joint-state-publisher': _joint_states,
    'joint-controller': _joint_velocity,
    'joint-position-controller': _joint_position,
    'joint-state-publisher': _joint_states,
    'joint-trajectory-controller': _joint_trajectory,
}
"""Kind of a plugin → what adds its controllers."""

LAST = ('gazebo-ros-control',)
"""Kinds that are translated after others: they have what is left."""
