# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sonars of ``<gazebo>`` blocks, by themselves and for a range finder of ``<ros2_control>``."""

import math

import pytest

from amr_description.model.gazebo.sensors import range_finder_of, robot_sensors_of
from amr_description.model.urdf import parse


def robot(inside, control=''):
    sensor = f'<sensor name="ping" type="sonar">{inside}</sensor>'
    return parse(
        f"""<robot name="r"><link name="base"/><gazebo reference="base">{sensor}</gazebo>
        {control}</robot>""",
        'r.urdf',
    )


SONAR = '<sonar><min>0.2</min><max>4</max><radius>1</radius></sonar>'


def test_a_sonar_publishes_the_nearest_range_in_its_cone():
    (sonar,) = robot_sensors_of(robot(SONAR)).sensors
    assert sonar.topics == (('ping/range', 'sensor_msgs/msg/Range'),)
    assert (sonar.range_min, sonar.range_max, sonar.radiation_type) == (0.2, 4.0, 0)
    for axis in (sonar.horizontal, sonar.vertical):
        assert (axis.lower, axis.upper) == pytest.approx((-math.atan(0.25), math.atan(0.25)))
        assert axis.samples % 2 == 1, 'one looks along x'


def test_a_sonar_without_an_end_is_told():
    found = robot_sensors_of(robot('<sonar><min>0.2</min></sonar>'))
    (finding,) = found.findings
    assert not found.sensors and '<range> has no <max>' not in finding.text
    assert '<sonar> has no <max>' in finding.text


def test_a_range_finder_has_the_limits_of_the_sonar_of_its_name():
    control = """<ros2_control name="c" type="sensor"><hardware><plugin>p</plugin></hardware>
      <sensor name="ping"><state_interface name="range"/></sensor></ros2_control>"""
    both = robot(SONAR, control)
    assert robot_sensors_of(both).sensors == ()
    sonar = range_finder_of(both, 'ping')
    assert (sonar.range_min, sonar.range_max) == (0.2, 4.0)
    assert range_finder_of(both, 'pong') is None
