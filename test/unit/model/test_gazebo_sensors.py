# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<gazebo reference="link"><sensor …>`` of a URDF."""

import math

import pytest

from amr_description.model.frames import Transform
from amr_description.model.gazebo.sensors import robot_sensors_of
from amr_description.model.gazebo.tags import gazebo_sensors_of, GazeboSensor
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse


def robot_of(inside):
    return parse(f'<robot name="r">\n<link name="base"/>\n{inside}\n</robot>', 'r.urdf')


def posed(pose):
    return f'<gazebo reference="base"><sensor name="a"><pose>{pose}</pose></sensor></gazebo>'


def test_sensors_in_the_order_of_the_file():
    robot = robot_of("""<gazebo><plugin filename="x" name="y"/></gazebo>
      <gazebo reference="base">
        <mu1>1</mu1>
        <sensor name="imu" type="imu"><pose>1 2 3 0 0 1.5707963267948966</pose></sensor>
        <sensor name="eye" type="camera"/>
      </gazebo>""")
    quarter = Transform.from_xyz_rpy((1.0, 2.0, 3.0), (0.0, 0.0, math.pi / 2))
    assert gazebo_sensors_of(robot) == (
        GazeboSensor('imu', 'imu', 'base', quarter, 6),
        GazeboSensor('eye', 'camera', 'base', Transform(), 7),
    )


def test_no_sensor_is_none():
    assert gazebo_sensors_of(robot_of('<gazebo reference="base"/>')) == ()


@pytest.mark.parametrize(
    'inside, message',
    [
        ('<gazebo><sensor name="a"/></gazebo>', '"a": its <gazebo> has no attribute "reference"'),
        ('<gazebo reference="base"><sensor/></gazebo>', '"": it has no attribute "name"'),
        (posed('1 2 3'), '"a": <pose>: found "1 2 3", expected 6 numbers, finite'),
        (posed('1 2 3 0 0 nan'), '"a": <pose>: found "1 2 3 0 0 nan"'),
    ],
)
def test_faults_are_told_with_their_line_and_the_sensor_is_left_out(inside, message):
    robot = robot_of(inside.replace('<sensor', '<sensor type="imu"'))
    (finding,) = robot_sensors_of(robot).findings
    assert f'r.urdf:3: gazebo sensor {message}' in finding.text
    assert gazebo_sensors_of(robot) == ()
    assert not translate(robot).controllers
