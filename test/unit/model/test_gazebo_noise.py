# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``<noise>`` of the ``<imu>`` of a Gazebo sensor."""

import pytest

from amr_description.errors import DescriptionError
from amr_description.model.checks import require_sound
from amr_description.model.gazebo.sensors import robot_sensors_of
from amr_description.model.gazebo.tags import gazebo_sensors_of, Noise
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse


def robot_of(inside):
    text = f"""<robot name="r">
    <link name="base"/>
    <gazebo reference="base"><sensor name="imu" type="imu">
    <imu>{inside}</imu></sensor></gazebo></robot>"""
    return parse(text, 'r.urdf')


def noise_of(inside):
    (sensor,) = gazebo_sensors_of(robot_of(inside))
    return dict(sensor.noise)


def on_x(inside, kind='gaussian'):
    return f'<angular_velocity><x><noise type="{kind}">{inside}</noise></x></angular_velocity>'


def test_each_axis_has_its_own():
    found = noise_of("""<angular_velocity>
          <x><noise type="gaussian"><mean>0.1</mean><stddev> 2e-4 </stddev></noise></x>
          <z><noise type="none"/></z></angular_velocity>
        <linear_acceleration><y><noise type="gaussian"><stddev>1.7e-2</stddev>
          <bias_mean>0.1</bias_mean><bias_stddev>0.001</bias_stddev>
          <dynamic_bias_stddev>0.2</dynamic_bias_stddev>
          <dynamic_bias_correlation_time>400</dynamic_bias_correlation_time>
          </noise></y></linear_acceleration>""")
    assert found == {
        'angular_velocity.x': Noise(mean=0.1, stddev=2e-4),
        'linear_acceleration.y': Noise(0.0, 0.017, 0.1, 0.001, 0.2, 400.0),
    }


def test_precision_is_that_of_quantized_noise():
    assert noise_of(on_x('<precision>0.1</precision>')) == {'angular_velocity.x': Noise()}
    quantized = noise_of(on_x('<precision>0.1</precision>', 'gaussian_quantized'))
    assert quantized == {'angular_velocity.x': Noise(precision=0.1)}


def test_each_unit_is_published_with_the_covariance_of_its_own_noise():
    def unit(name, deviation):
        noise = on_x(f'<stddev>{deviation}</stddev>')
        return f'<sensor name="{name}" type="imu"><imu>{noise}</imu></sensor>'

    inside = unit('rear', 0.5) + unit('front', 0.1)
    robot = parse(
        f'<robot name="r"><link name="base"/><gazebo reference="base">{inside}</gazebo></robot>'
    )
    found = {
        each.parameters['sensor_name']: each.parameters['static_covariance_angular_velocity'][0]
        for each in translate(robot).controllers
    }
    assert found == pytest.approx({'rear': 0.25, 'front': 0.01})


def test_without_noise_there_is_none():
    assert noise_of('') == {}


@pytest.mark.parametrize(
    'inside, message',
    [
        (
            on_x('', 'perlin'),
            'r.urdf:4: gazebo sensor "imu": angular_velocity.x: type of <noise>: found "perlin", '
            'expected one of none, gaussian, gaussian_quantized',
        ),
        (on_x('<stddev>-1</stddev>'), '<stddev>: found "-1", expected a finite number from 0 on'),
        (on_x('<mean>inf</mean>'), '<mean>: found "inf", expected a finite number'),
        (on_x('<bias_mean/>'), '<bias_mean>: found "", expected a finite number'),
    ],
)
def test_what_cannot_be_is_one_line_and_the_unit_is_left_out(inside, message):
    robot = robot_of(inside)
    (finding,) = robot_sensors_of(robot).findings
    assert message in finding.text and '\n' not in finding.text
    assert finding.as_taken().text.endswith('; the sensor is left out')
    assert gazebo_sensors_of(robot) == ()
    assert not translate(robot).controllers


def test_a_unit_of_ros2_control_that_cannot_be_is_refused():
    control = """<ros2_control name="c" type="sensor"><hardware><plugin>p</plugin></hardware>
      <sensor name="imu"><state_interface name="orientation.x"/></sensor></ros2_control>"""
    robot = robot_of(on_x('<mean>inf</mean>'))
    text = robot.text.replace('</robot>', f'{control}</robot>')
    with pytest.raises(DescriptionError, match='<mean>: found "inf", expected a finite number'):
        require_sound(text, strict=False)
