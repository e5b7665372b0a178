# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Robots that are moved by Gazebo's own plugins, not by ros2_control: their plugins as hardware and
controllers of ours.

============================================ ====================================================
plugin, Gazebo Classic (ROS 2, ROS 1) or new controller
============================================ ====================================================
diff drive, skid steer                       ``amr_description/GazeboDiffDrive``
MecanumDrive                                 ``amr_description/GazeboMecanumDrive``
AckermannSteering, Ackermann drive           ``amr_description/GazeboAckermannDrive``
planar and force-based move, VelocityControl ``amr_description/GazeboPlanarMove``, on the base
p3d, OdometryPublisher, odometry of a drive  ``amr_description/GazeboOdometryPublisher``: the truth
that has the world as its source
joint state publisher                        ``joint_state_broadcaster/JointStateBroadcaster``
JointPositionController, JointController     ``amr_description/GazeboJointCommand``
JointTrajectoryController                    ``joint_trajectory_controller/…``
ros_control of ROS 1, with <transmission>    none: its joints can be commanded by ros2_control
``<sensor>``: imu, magnetometer, …           a broadcaster
                                             (:mod:`amr_description.model.gazebo.instruments`)
other sensors                                none: :mod:`amr_description.model.gazebo.sensors`
============================================ ====================================================

Parameters that are not given have Gazebo's defaults. Topics are those of the plugin: Classic's
with its ``<remapping>`` rules, new Gazebo's as they are usually bridged: ``<topic>`` without a
leading ``/model/NAME``, else ``cmd_vel``, ``odom``, ``/tf`` and ``joint_states``. New Gazebo's
frames are ``odom`` and the root link, where it would put the name of the model before them.

What the ``<ros2_control>`` blocks have stays theirs: sensors by their names, and joints that a
controller of the parameter files claims. A drive whose wheels nobody claims drives them.
"""

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from amr_description.errors import AmrError
from amr_description.model.controller_files import claimed_names
from amr_description.model.gazebo.builder import Builder, GazeboTranslation
from amr_description.model.gazebo.drives import DRIVES, FIRST
from amr_description.model.gazebo.instruments import add_instrument
from amr_description.model.gazebo.joints import JOINTS, LAST
from amr_description.model.gazebo.plugins import plugins_of, sensors_of
from amr_description.model.gazebo.sensors import read_sensors, SERVED_ELSEWHERE
from amr_description.model.gazebo.slip import KINDS as OF_WHEEL_SLIP
from amr_description.model.origins import raise_error_of
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.xml_reader import parse_xml

_TRANSLATORS = {**DRIVES, **JOINTS}


def translate(
    robot: Robot, files: Sequence[Path] | None = None, namespace: str = ''
) -> GazeboTranslation:
    """
    Return what stands for the plugins of a robot, which may be the robot alone.

    Args:
        robot: with its text.
        files: the parameter files of its controllers; None: as
            :func:`~amr_description.model.controller_files.claimed_names` finds them.
        namespace: of its controller manager; empty: that of the robot.

    Raises:
        DescriptionError: a ``<ros2_control>`` or ``<gazebo>`` block is invalid.
    """
    report = raise_error_of(robot.text, strict=False)
    xml = parse_xml(robot.text, robot.source, report)
    if xml is None:
        return GazeboTranslation(robot)

    @cache
    def claimed() -> frozenset[str]:
        try:
            return claimed_names(robot, files, namespace)
        except AmrError:  # who reads the file, or the plugin, says so
            return frozenset(joint.name for joint in robot.joints)

    builder = Builder(robot, read_hardware(xml, robot, report), claimed)
    plugins = plugins_of(xml, builder.notes, builder.faults)
    for plugin in sorted(plugins, key=lambda each: (each.kind in LAST, each.kind not in FIRST)):
        if plugin.kind in _TRANSLATORS:
            _TRANSLATORS[plugin.kind](builder, plugin)
        elif not plugin.is_world_matter and plugin.kind not in OF_WHEEL_SLIP:
            builder.lacking.append(('plugin', plugin.name or plugin.filename, plugin.library))
    seeing = read_sensors(xml, robot, builder.sensors)
    builder.lacking += [('sensor', name, kind) for name, kind in seeing.lacking]
    for sensor, link in sensors_of(xml):
        if sensor.get('name', '') in builder.sensors:
            continue  # ros2_control's, which says itself what it cannot do
        kind = sensor.get('type', '')
        if kind not in SERVED_ELSEWHERE or sensor.get('name', '').strip() in seeing.faulty:
            continue  # read above, or left out there
        if not add_instrument(builder, sensor, link):
            builder.lacking.append(('sensor', sensor.get('name', ''), kind))
    return builder.build(seeing.sensors)
