# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What Gazebo's plugins of single joints become, :data:`JOINTS`, and its sensors: :func:`add_imu`.
"""

from collections.abc import Callable, Mapping
import math
from typing import Any

from lxml import etree

from amr_description.model.gazebo import gazebo_sensors_of
from amr_description.model.gazebo_builder import (
    Builder,
    gz_topic,
    HIGHEST_RATE,
    LEAST_RATE,
    node_name,
    origin_of,
)
from amr_description.model.gazebo_plugins import PluginElement
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import parse_number
from amr_description.text import quote, quote_all


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
    if not builder.can_drive(plugin, joints):
        return
    builder.command(joints, interface, initial=initial)
    index = '' if interface == 'velocity' else f'{plugin.text("joint_index", default="0")}/'
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
    if not builder.can_drive(plugin, joints):
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
    """ROS 1's host of controllers: its joints can be commanded as ``<transmission>`` says."""
    found: dict[str, list[str]] = {}
    for joint in plugin.element.getroottree().iterfind('transmission/joint'):
        for each in joint.iterchildren('hardwareInterface'):
            kind = (each.text or '').strip().rpartition('/')[2].removesuffix('JointInterface')
            interfaces = found.setdefault(joint.get('name', ''), [])
            if kind.lower() in ('position', 'velocity', 'effort'):
                interfaces.append(kind.lower())
    joints = [name for name, interfaces in found.items() if interfaces]
    if not joints or not builder.can_drive(plugin, joints):
        return
    for name in joints:
        for interface in dict.fromkeys(found[name]):
            builder.command([name], interface)
    kinds = quote_all([*dict.fromkeys(each for name in joints for each in found[name])])
    builder.remarks.append(
        f'{origin_of(plugin)} is of ROS 1; its {len(joints)} joints of <transmission> can be '
        f'commanded by ros2_control ({kinds}), by controllers of a parameter file that is given'
    )


def add_imu(builder: Builder, sensor: etree._Element, link: str) -> bool:
    """Add the broadcaster of a unit; return False if it is no sound one."""
    name = sensor.get('name', '')
    if name in builder.imus or not builder.robot.has_link(link):
        return False
    builder.imus.append(name)
    inside = sensor.find('plugin')
    plugin = PluginElement(inside if inside is not None else sensor, builder.notes)
    if inside is not None and plugin.is_classic:
        topic = plugin.topic('~/out', 'topicName')
        frame = plugin.text('frame_name', 'frameName')
        node = node_name(plugin.name, node_name(name, 'imu'))
    else:
        topic, node = gz_topic(PluginElement(sensor), 'topic', 'imu'), node_name(name, 'imu')
        frame = PluginElement(sensor).text('gz_frame_id', 'ignition_frame_id')
        topic = 'imu' if topic == '__default_topic__' else topic
    rate = parse_number((sensor.findtext('update_rate') or '').strip())
    parameters: dict[str, Any] = {
        'sensor_name': name,
        'frame_id': frame or link,
        **_imu_covariances(builder.robot, name),
    }
    if rate > 0.0:
        parameters['update_rate'] = max(1, round(min(rate, HIGHEST_RATE)))
    if rate > HIGHEST_RATE:
        builder.notes.append(
            f'sensor {quote(name)} asks for {rate:g} Hz, and is published at {HIGHEST_RATE} Hz, '
            'the most that sensors have here'
        )
    builder.add(
        'imu_sensor_broadcaster/IMUSensorBroadcaster',
        parameters,
        {'~/imu': topic},
        name=node,
        origin=f'sensor {quote(name)}',
        namespace=plugin.namespace if inside is not None else '',
    )
    return True


def _imu_covariances(robot: Robot, name: str) -> dict[str, list[float]]:
    """Return the variances of a unit's noise, as Gazebo's plugins fill them in."""
    noises = next((dict(each.noise) for each in gazebo_sensors_of(robot) if each.name == name), {})
    found = {}
    for quantity in ('angular_velocity', 'linear_acceleration'):
        axes = [noises.get(f'{quantity}.{axis}') for axis in 'xyz']
        deviations = [0.0 if noise is None else noise.stddev for noise in axes]
        if any(deviations):
            matrix = [0.0] * 9
            matrix[0], matrix[4], matrix[8] = (value * value for value in deviations)
            found[f'static_covariance_{quantity}'] = matrix
    return found


JOINTS: Mapping[str, Callable[[Builder, PluginElement], None]] = {
    'gazebo-ros-control': _transmissions,
    'gazebo-ros-joint-state-publisher': _joint_states,
    'joint-controller': _joint_velocity,
    'joint-position-controller': _joint_position,
    'joint-state-publisher': _joint_states,
    'joint-trajectory-controller': _joint_trajectory,
}
"""Kind of a plugin → what adds its controllers."""
