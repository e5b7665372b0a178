# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf``: what the drive plugins of Gazebo believe of the robot, and what it is."""

import re

from fixtures.sim.ackermann import ackermann
from fixtures.sim.plugin_robot import cart, classic_drive, gz_drive, JOINTS, plugin
import pytest

from amr_description.cli import check_urdf
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse

DRIVES = ('drive:', 'diff_drive:', 'mecanum_drive:', 'ackermann_steering:')
REAR = JOINTS.replace('>left', '>rear_left').replace('>right', '>rear_right')
SWAPPED = classic_drive().replace('>left', '>x').replace('>right', '>left').replace('>x', '>right')


def gz(library, name, inside):
    return plugin(f'gz-sim-{library}-system', f'gz::sim::systems::{name}', inside)


def four_wheels(*plugins):
    """The cart with two more wheels, 0.3 m behind its own."""
    text = cart(*plugins)
    begin, end = text.index('<link name="left_wheel">'), text.index('<gazebo>')
    behind = text[begin:end].replace('left_', 'rear_left_').replace('right_', 'rear_right_')
    return text[:end] + behind.replace('xyz="0 ', 'xyz="-0.3 ') + text[end:]


@pytest.fixture
def check(tmp_path, capsys):
    """Check a description; give the lines about its drive."""

    def run(text, begin=DRIVES):
        path = tmp_path / 'robot.urdf'
        path.write_text(text)
        assert check_urdf.main([str(path)]) == 0
        lines = capsys.readouterr().err.replace(f'{path}:', '').splitlines()
        texts = [line.split(': ', 2)[2] for line in lines]
        return [text for text in texts if text.startswith(begin)]

    return run


def test_plugins_that_are_right_pass(check):
    assert check(cart(classic_drive())) == []
    assert check(cart(gz_drive())) == []


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        (
            cart(classic_drive()).replace('diameter>0.1<', 'diameter>0.05<'),
            'drive: <wheel_diameter> is not that of "left_joint": found 0.05 m, expected 0.1 m, '
            'the diameter of its collision shape; write <wheel_diameter>0.1</wheel_diameter>',
        ),
        (
            cart(gz_drive()).replace('radius>0.05<', 'radius>0.06<'),
            'diff_drive: <wheel_radius> is not that of "left_joint": found 0.06 m, expected '
            '0.05 m, the radius of its collision shape; write <wheel_radius>0.05</wheel_radius>',
        ),
        (
            cart(classic_drive()).replace('separation>0.3<', 'separation>0.5<'),
            'drive: <wheel_separation> is not that of the wheels: found 0.5 m, expected 0.3 m '
            'between the joints on the left and on the right; write '
            '<wheel_separation>0.3</wheel_separation>',
        ),
        (
            cart(SWAPPED),
            'drive: left and right wheels are swapped: turns are inverted: found the left wheels '
            'at y = -0.15 m, the right ones at y = 0.15 m, expected the left wheels at the '
            'greater y; swap <left_joint> and <right_joint>',
        ),
        (
            four_wheels(classic_drive(REAR)),
            'drive: wheels one behind the other scrub in a turn; the robot turns less than told: '
            'found <wheel_separation> of 0.3 m, expected about 0.6 m, 1 + (L/W)² = 2.00 times as '
            'much; write <wheel_separation>0.6</wheel_separation>, then measure a full turn',
        ),
    ],
    ids=['diameter', 'radius', 'separation', 'swapped', 'scrubbing'],
)
def test_a_size_that_is_wrong_is_named_at_its_line(check, text, said):
    assert check(text) == [said]


def test_a_separation_that_accounts_for_scrubbing_passes(check):
    wide = classic_drive(REAR).replace('separation>0.3<', 'separation>0.55<')
    assert check(four_wheels(wide)) == []
    (said,) = check(four_wheels(wide.replace('>0.55<', '>0.4<')))  # a third of what it takes
    assert 'found <wheel_separation> of 0.4 m, expected about 0.6 m' in said


def mecanum():
    """Return a robot with new Gazebo's mecanum drive, the wheels of which it believes larger."""
    corners = ('front_left', 'front_right', 'back_left', 'back_right')
    wheels = ('left', 'right', 'rear_left', 'rear_right')
    drive = ''.join(
        f'<{corner}_joint>{wheel}_joint</{corner}_joint>'
        for corner, wheel in zip(corners, wheels, strict=True)
    )
    drive += '<wheel_separation>0.3</wheel_separation><wheelbase>0.5</wheelbase>'
    drive += '<wheel_radius>0.08</wheel_radius>'
    return four_wheels(gz('mecanum-drive', 'MecanumDrive', drive))


def test_a_mecanum_drive_is_held_against_the_robot(check):
    radius, reach = check(mecanum())
    assert radius == (
        'mecanum_drive: <wheel_radius> is not that of the robot: found 0.08 m, expected 0.05 m, '
        'the radius of the collision shape; write <wheel_radius>0.05</wheel_radius>'
    )
    assert reach.startswith(
        'mecanum_drive: <wheel_separation> and <wheelbase> is not that of the robot: found 0.8 m, '
        'expected 0.6 m, 2 times half of the wheelbase and half of the track'
    )


def car():
    """Return a car of new Gazebo, which believes its axles further apart."""
    text = ackermann()
    text = text[: text.index('<ros2_control')]
    sides = ''.join(
        f'<{side}_joint>rear_{side}</{side}_joint>'
        f'<{side}_steering_joint>steer_{side}</{side}_steering_joint>'
        for side in ('left', 'right')
    )
    sizes = (
        '<wheel_base>0.5</wheel_base><wheel_separation>0.3</wheel_separation>'
        '<kingpin_width>0.3</kingpin_width><wheel_radius>0.06</wheel_radius>'
    )
    drive = plugin(
        'gz-sim-ackermann-steering-system', 'gz::sim::systems::AckermannSteering', sides + sizes
    )
    return f'{text}<gazebo>{drive}</gazebo></robot>'


def test_a_car_is_held_against_the_robot(check):
    assert check(car()) == [
        'ackermann_steering: <wheel_base> is not that of the robot: found 0.5 m, expected 0.4 m, '
        'from axle to axle; write <wheel_base>0.4</wheel_base>'
    ]


@pytest.mark.parametrize('size', ['-0.1', '0', 'nan', 'inf', '1e300', '1e-320', 'abc', '0.1 0.1'])
@pytest.mark.parametrize(
    ('text', 'tag', 'per'),
    [
        (cart(classic_drive()), 'wheel_diameter', 2),
        (cart(classic_drive()), 'wheel_separation', 1),
        (cart(gz_drive()), 'wheel_radius', 1),
        (mecanum(), 'wheelbase', 1),
        (car(), 'kingpin_width', 1),
    ],
)
def test_a_size_that_is_none_is_one_line_and_its_plugin_is_left_out(check, text, tag, per, size):
    robot = re.sub(f'<{tag}>[^<]*<', f'<{tag}>{size}<', text)
    said = f'<{tag}> is "{size}"; a number from {per * 0.001:g} to {per * 100} m will do'
    (line,) = check(robot, 'plugin ')
    assert line.endswith(f'it cannot work: {said}')
    assert check(robot) == []
    assert translate(parse(robot)).controllers == ()
