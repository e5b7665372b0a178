# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What Gazebo's sensors become whose values are state interfaces: hardware and a broadcaster.

================ ==================================================== =============================
type             broadcaster                                          topic, without ``<topic>``
================ ==================================================== =============================
``imu``          ``imu_sensor_broadcaster/IMUSensorBroadcaster``      ``imu``
``magnetometer`` ``magnetometer_broadcaster/MagnetometerBroadcaster`` ``magnetometer``
``force_torque`` ``force_torque_sensor_broadcaster/…``                ``NAME/force_torque``
================ ==================================================== =============================
"""

from collections.abc import Mapping, Sequence
from typing import Any

from lxml import etree

from amr_description.model.gazebo.builder import (
    Builder,
    gz_sensor_topic,
    HIGHEST_RATE,
    node_name,
)
from amr_description.model.gazebo.plugins import PluginElement
from amr_description.model.gazebo.tags import gazebo_sensors_of, Noise
from amr_description.model.hardware_info import (
    IMU_INTERFACES,
    MAGNETIC_INTERFACES,
    WRENCH_INTERFACES,
)
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import parse_number
from amr_description.text import quote

_FRAMES = ('gz_frame_id', 'ignition_frame_id')


def add_instrument(builder: Builder, sensor: etree._Element, reference: str) -> bool:
    """
    Add the broadcaster of a sensor.

    Args:
        builder: Gets it.
        sensor: The tag.
        reference: What it is on: a link, or the joint of a force-torque sensor.

    Returns:
        False if it is none of the table, or on nothing that can carry it.
    """
    name = sensor.get('name', '')
    if name in builder.instruments:
        builder.notes.append(
            f'sensor {quote(name)} stands twice; the second one is left out, give it another name'
        )
        return True
    if not name:
        return False
    match sensor.get('type'):
        case 'imu' if builder.robot.has_link(reference):
            _add_imu(builder, sensor, name, reference)
        case 'magnetometer' if builder.robot.has_link(reference):
            _add_magnetometer(builder, sensor, name, reference)
        case 'force_torque' if _joint_of(builder.robot, reference) is not None:
            _add_force_torque(builder, sensor, name, reference)
        case _:
            return False
    return True


def add_wrench(
    builder: Builder,
    name: str,
    link: str,
    frame: str,
    topic: str,
    rate: float,
    namespace: str = '',
) -> None:
    """
    Add a force-torque sensor in the joint above a link.

    Args:
        builder: Gets it.
        name: Of the sensor.
        link: Below the joint.
        frame: Of its messages.
        topic: Of these.
        rate: Hz; 0 or less: of the controller manager.
        namespace: Of the topic, if the robot is spawned without one.
    """
    builder.instruments[name] = WRENCH_INTERFACES, {'link': link}
    builder.add(
        'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster',
        {'sensor_name': name, 'frame_id': frame, **_rate(builder, name, rate)},
        {'~/wrench': topic},
        name=node_name(name, 'force_torque_sensor'),
        origin=f'sensor {quote(name)}',
        frames=('frame_id',),
        namespace=namespace,
    )


def _add_imu(builder: Builder, sensor: etree._Element, name: str, link: str) -> None:
    inside = sensor.find('plugin')
    plugin = PluginElement(inside if inside is not None else sensor, builder.notes)
    if inside is not None and plugin.is_classic:
        topic = plugin.topic('~/out', 'topicName')
        frame = plugin.text('frame_name', 'frameName')
        node = node_name(plugin.name, node_name(name, 'imu'))
    else:
        topic, node = gz_sensor_topic(sensor) or 'imu', node_name(name, 'imu')
        frame = PluginElement(sensor).text(*_FRAMES)
    noises = _noises_of(builder.robot, name)
    covariances = {
        f'static_covariance_{quantity}': matrix
        for quantity in ('angular_velocity', 'linear_acceleration')
        if (matrix := _covariance(noises, quantity))
    }
    builder.instruments[name] = IMU_INTERFACES, {}
    builder.add(
        'imu_sensor_broadcaster/IMUSensorBroadcaster',
        {
            'sensor_name': name,
            'frame_id': frame or link,
            **covariances,
            **_rate(builder, name, _update_rate(builder, sensor, name)),
        },
        {'~/imu': topic},
        name=node,
        origin=f'sensor {quote(name)}',
        frames=('frame_id',),
        namespace=plugin.namespace if inside is not None else '',
    )


def _add_magnetometer(builder: Builder, sensor: etree._Element, name: str, link: str) -> None:
    covariance = _covariance(_noises_of(builder.robot, name), 'magnetic_field')
    builder.instruments[name] = MAGNETIC_INTERFACES, {}
    builder.add(
        'magnetometer_broadcaster/MagnetometerBroadcaster',
        {
            'sensor_name': name,
            'frame_id': PluginElement(sensor).text(*_FRAMES) or link,
            **({'static_covariance': covariance} if covariance else {}),
            **_rate(builder, name, _update_rate(builder, sensor, name)),
        },
        {'~/magnetic_field': gz_sensor_topic(sensor) or 'magnetometer'},
        name=node_name(name, 'magnetometer'),
        origin=f'sensor {quote(name)}',
        frames=('frame_id',),
    )


def _add_force_torque(builder: Builder, sensor: etree._Element, name: str, reference: str) -> None:
    joint = _joint_of(builder.robot, reference)
    assert joint is not None, 'the caller has looked'
    axes = _one_of(builder, sensor, name, 'frame', ('child', 'parent', 'sensor'))
    _one_of(builder, sensor, name, 'measure_direction', ('child_to_parent', 'parent_to_child'))
    frame = PluginElement(sensor).text(*_FRAMES)
    add_wrench(
        builder,
        name,
        joint.child,
        frame or (joint.parent if axes == 'parent' else joint.child),
        gz_sensor_topic(sensor) or f'{node_name(name, "sensor")}/force_torque',
        _update_rate(builder, sensor, name),
    )


def _one_of(
    builder: Builder, sensor: etree._Element, name: str, tag: str, known: Sequence[str]
) -> str:
    """Return the text of an element of ``<force_torque>``; the first one known for another."""
    text = (sensor.findtext(f'force_torque/{tag}') or known[0]).strip()
    if text in known:
        return text
    builder.notes.append(
        f'sensor {quote(name)}: <{tag}> is {quote(text)}, which is none of {", ".join(known)}; '
        f'{known[0]} is taken'
    )
    return known[0]


def _joint_of(robot: Robot, reference: str) -> Any:
    """Return the joint of this name, else the one above the link of this name; None: neither."""
    if robot.has_joint(reference):
        return robot.joint(reference)
    return robot.parent_joint(reference) if robot.has_link(reference) else None


def _update_rate(builder: Builder, sensor: etree._Element, name: str) -> float:
    """Return the rate that a tag asks for, Hz; 0: that of the controller manager."""
    text = (sensor.findtext('update_rate') or '0').strip()
    rate = parse_number(text)
    if rate >= 0.0:
        return rate
    builder.notes.append(
        f'sensor {quote(name)}: <update_rate> is {quote(text)}, where Hz from 0 on are expected; '
        'it is published at the rate of the controller manager'
    )
    return 0.0


def _rate(builder: Builder, name: str, rate: float) -> Mapping[str, int]:
    """Return the parameter of a broadcaster's rate; of none, or 0, there is none."""
    if rate > HIGHEST_RATE:
        builder.notes.append(
            f'sensor {quote(name)} asks for {rate:g} Hz, and is published at {HIGHEST_RATE} Hz, '
            'the most that sensors have here'
        )
    return {'update_rate': max(1, round(min(rate, HIGHEST_RATE)))} if rate > 0.0 else {}


def _noises_of(robot: Robot, name: str) -> Mapping[str, Noise]:
    """Return the noises of a sensor by state interface."""
    return next((dict(each.noise) for each in gazebo_sensors_of(robot) if each.name == name), {})


def _covariance(noises: Mapping[str, Noise], quantity: str) -> Sequence[float]:
    """Return the variances of a vector's noise by rows, as Gazebo's plugins fill them in."""
    axes = [noises.get(f'{quantity}.{axis}') for axis in 'xyz']
    deviations = [0.0 if noise is None else noise.stddev for noise in axes]
    if not any(deviations):
        return []
    matrix = [0.0] * 9
    matrix[0], matrix[4], matrix[8] = (value * value for value in deviations)
    return matrix
