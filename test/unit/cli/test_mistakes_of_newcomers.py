# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The mistakes that people make in their first robot: ``check_urdf`` names the cause, with a remedy.

The robot is a rover of two wheels and a caster, a xacro file with macros in a second one, and a
parameter file. The first line is about the mistake, not about what follows from it.
"""

from typing import NamedTuple

import pytest
from support.paths import ROOT

from amr_description.cli import check_urdf

ROVER = ROOT / 'test/fixtures/rover'
ROBOT, INERTIALS, YAML = 'urdf/rover.urdf.xacro', 'urdf/inertials.xacro', 'config/rover.yaml'


class Mistake(NamedTuple):
    """``file``: with ``old`` written as ``new``; what the first line begins with and holds."""

    file: str
    old: str
    new: str
    place: str
    cause: str
    remedy: str


CASTER = '<origin xyz="-0.13 0 ${caster_radius - wheel_radius}"/>'
CASTER_JOINT = f"""\
  <joint name="caster_joint" type="fixed">
    <parent link="base_link"/>
    <child link="caster"/>
    {CASTER}
  </joint>
"""
WHEEL_INERTIAL = (
    '<xacro:cylinder_inertial mass="0.5" radius="${wheel_radius}" length="${wheel_width}"/>'
)
SIDES = """["left_wheel_joint"]
    right_wheel_names: ["right_wheel_joint"]"""
SWAPPED = """["right_wheel_joint"]
    right_wheel_names: ["left_wheel_joint"]"""
IN_WHEEL = '(in macro "wheel", called at urdf/rover.urdf.xacro:73)'

MISTAKES = {
    # What a link or a joint is.
    'an element is not closed': Mistake(
        ROBOT, '<link name="base_footprint"/>', '<link name="base_footprint">',
        'error: urdf/rover.urdf.xacro:112: ',
        '</robot> stands where <link> of line 22 is still open',
        'write </link> before it',
    ),
    'a name without quotes': Mistake(
        ROBOT, '<link name="base_link">', '<link name=base_link>',
        'error: urdf/rover.urdf.xacro:30: ',
        'not well-formed XML: AttValue: " or \' expected',
        'write the value of the attribute in quotes',
    ),
    'a link that is not there': Mistake(
        ROBOT, '<child link="base_link"/>', '<child link="base_lnk"/>',
        'error: urdf/rover.urdf.xacro:24: ',
        'joint "base_joint": its child link is not defined: found "base_lnk"',
        'add <link name="base_lnk"> or correct the name',
    ),
    'two links of one name': Mistake(
        ROBOT, '<xacro:wheel side="right"', '<xacro:wheel side="left"',
        'error: urdf/rover.urdf.xacro:51: ',
        'link "left_wheel" is not unique: found the first at urdf/rover.urdf.xacro:73',
        'give every link a name of its own',
    ),
    'a link that hangs on nothing': Mistake(
        ROBOT, CASTER_JOINT, '',
        'error: urdf/rover.urdf.xacro:76: ',
        'the robot has 2 roots: found "base_footprint", "caster"',
        'join "caster" to the others by a joint',
    ),
    'a misspelt type of joint': Mistake(
        ROBOT, 'type="continuous"', 'type="continous"',
        'error: urdf/rover.urdf.xacro:65: ',
        'joint "left_wheel_joint": unknown joint type: found "continous"',
        f'write type="continuous" {IN_WHEEL}',
    ),
    'a joint without limits': Mistake(
        ROBOT, 'type="continuous"', 'type="revolute"',
        'error: urdf/rover.urdf.xacro:65: ',
        'joint "left_wheel_joint": a revolute joint needs limits',
        'add <limit lower="…" upper="…" effort="…" velocity="…"/>',
    ),
    'no inertial': Mistake(
        ROBOT, WHEEL_INERTIAL, '',
        'warning: urdf/rover.urdf.xacro:51: ',
        'link "left_wheel" has a collision shape and no <inertial>',
        'add <inertial> with <mass value="…"/>',
    ),
    'a mass of 0': Mistake(
        ROBOT, 'mass="4.0"', 'mass="0"',
        'warning: urdf/inertials.xacro:5: ',
        'link "base_link": mass: found 0 kg',
        'expected more than 0',
    ),
    'an inertia that no body has': Mistake(
        INERTIALS, '"${mass / 12 * (x * x + y * y)}"', '"${mass * (x * x + y * y)}"',
        'warning: urdf/inertials.xacro:5: ',
        'link "base_link": no body has this inertia',
        'expected none above the sum of the two others (triangle inequality)',
    ),
    'a mesh that is not there': Mistake(
        ROBOT, '<sphere radius="${caster_radius}"/>', '<mesh filename="meshes/ball.stl"/>',
        'warning: urdf/rover.urdf.xacro:79: ',
        'the mesh of link "caster" is not there: found "meshes/ball.stl"',
        'expected package://<package>/<path>, or a path from the folder of this file',
    ),
    'a colour of 255': Mistake(
        ROBOT, '0.9 0.5 0.1 1.0', '230 128 26 255',
        'warning: urdf/rover.urdf.xacro:16: ',
        'material "orange": color: found "230 128 26 255"',
        'expected red, green, blue and opacity, each from 0 to 1',
    ),
    'a box of two sides': Mistake(
        ROBOT, ' ${body_height}"', '"',
        'error: urdf/rover.urdf.xacro:34: ',
        'link "base_link": size of <box>: found "0.34 0.24"',
        'expected 3 numbers',
    ),
    # How the wheels stand.
    'an axle along x': Mistake(
        ROBOT, '<axis xyz="0 0 1"/>', '<axis xyz="1 0 0"/>',
        'error: urdf/rover.urdf.xacro:65: ',
        'the axle points ahead, so that the wheel rolls sideways',
        'write <axis xyz="0 0 1"/>',
    ),
    'an axle along y': Mistake(
        ROBOT, '<axis xyz="0 0 1"/>', '<axis xyz="0 1 0"/>',
        'error: urdf/rover.urdf.xacro:65: ',
        'the axle is vertical, so that the wheel cannot roll',
        'write <axis xyz="0 0 1"/>',
    ),
    'degrees': Mistake(
        ROBOT, 'rpy="-1.5708 0 0"', 'rpy="-90 0 0"',
        'error: urdf/rover.urdf.xacro:65: ',
        'the rpy="-90 0 0" of its <origin> looks like degrees',
        'write rpy="-1.5708 0 0" in its <origin>',
    ),
    'no rpy': Mistake(
        ROBOT, ' rpy="-1.5708 0 0"', '',
        'error: urdf/rover.urdf.xacro:65: ',
        'the axle is vertical, so that the wheel cannot roll',
        'write rpy="-1.5708 0 0" in its <origin>',
    ),
    'a caster too deep': Mistake(
        ROBOT, CASTER, '<origin xyz="-0.13 0 -0.08"/>',
        'warning: urdf/rover.urdf.xacro:90: ',
        'link "caster" reaches below the driven wheels, which hang in the air: found 30 mm below',
        'raise it by 0.03 m in the <origin> of joint "caster_joint"',
    ),
    'millimetres': Mistake(
        ROBOT, 'name="wheel_radius" value="0.08"', 'name="wheel_radius" value="160"',
        'warning: urdf/rover.urdf.xacro:58: ',
        'link "left_wheel": the radius of its cylinder is 160 m: millimetres?',
        'write radius="0.16"',
    ),
    # <ros2_control>.
    'a joint of <ros2_control> that is not there': Mistake(
        ROBOT, '<joint name="right_wheel_joint">', '<joint name="rigth_wheel_joint">',
        'error: urdf/rover.urdf.xacro:105: ',
        "Joint 'rigth_wheel_joint' not found in URDF",
        'write name="right_wheel_joint"',
    ),
    'no command interface': Mistake(
        ROBOT, '      <command_interface name="velocity"/>\n', '',
        'error: config/rover.yaml:15: ',
        'left_wheel_names holds "left_wheel_joint", which has no command interface "velocity"',
        'add <command_interface name="velocity"/> to it in <ros2_control>',
    ),
    'a misspelt interface': Mistake(
        ROBOT, '<command_interface name="velocity"/>', '<command_interface name="velocty"/>',
        'warning: urdf/rover.urdf.xacro:100: ',
        'an interface that no controller asks for: found "velocty"',
        'write name="velocity"',
    ),
    'a misspelt plugin': Mistake(
        ROBOT, 'GazeboSimSystem', 'GazeboSimSytem',
        'error: urdf/rover.urdf.xacro:96: ',
        'there is no hardware plugin "gz_ros2_control/GazeboSimSytem"',
        'did you mean "gz_ros2_control/GazeboSimSystem"?',
    ),
    # The parameters of the controllers.
    'a wheel that is not there': Mistake(
        YAML, '"left_wheel_joint"', '"left_wheel_jiont"',
        'error: config/rover.yaml:15: ',
        'left_wheel_names holds "left_wheel_jiont", which is no joint of the robot',
        'write "left_wheel_joint"',
    ),
    'a misspelt parameter': Mistake(
        YAML, 'wheel_separation', 'wheel_seperation',
        'error: config/rover.yaml:18: ',
        'there is no parameter "wheel_seperation", and it is ignored',
        'did you mean "wheel_separation"?',
    ),
    'a section for no node': Mistake(
        YAML, '\ndiff_drive_controller:', '\ndiffdrive_controller:',
        'error: config/rover.yaml:13: ',
        'the section "diffdrive_controller" is for no node',
        'did you mean "diff_drive_controller"?',
    ),
    'a controller type that is not there': Mistake(
        YAML, 'DiffDriveController', 'DiffDriveControler',
        'error: config/rover.yaml:11: ',
        'there is no controller type "diff_drive_controller/DiffDriveControler"',
        'did you mean "diff_drive_controller/DiffDriveController"?',
    ),
    'an integer': Mistake(
        YAML, 'wheel_radius: 0.08', 'wheel_radius: 1',
        'warning: config/rover.yaml:19: ',
        "parameter 'wheel_radius' is 1, an integer, where a double is declared",
        'taken as 1.0; a node of rclcpp refuses it',
    ),
    'ros__parameters with one underscore': Mistake(
        YAML, 'ros__parameters', 'ros_parameters',
        'error: config/rover.yaml:3: ',
        "'ros_parameters' is misspelt",
        'write ros__parameters, with two underscores',
    ),
    'another radius of the wheels': Mistake(
        YAML, 'wheel_radius: 0.08', 'wheel_radius: 0.16',
        'warning: config/rover.yaml:19: ',
        'wheel_radius is not that of "left_wheel_joint": found 0.16 m',
        'write wheel_radius: 0.08',
    ),
    'sides that are swapped': Mistake(
        YAML, SIDES, SWAPPED,
        'warning: config/rover.yaml:15: ',
        'left and right wheels are swapped: turns are inverted',
        'swap left_wheel_names and right_wheel_names',
    ),
    'a frame with two parents': Mistake(
        YAML, 'base_frame_id: base_footprint', 'base_frame_id: base_link',
        'warning: config/rover.yaml:23: ',
        '"base_link" gets two parents in TF',
        'write base_frame_id: base_footprint',
    ),
}  # fmt: skip
"""The 33 of the walk through the first hour, but for :data:`HARMLESS`."""

HARMLESS = Mistake(
    ROBOT, '  <ros2_control',
    '  <transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
    '<joint name="left_wheel_joint"><hardwareInterface>hardware_interface/VelocityJointInterface'
    '</hardwareInterface></joint><actuator name="m"/></transmission>\n  <ros2_control',
    '', '', '',
)  # fmt: skip
"""The drive train of ROS 1, which urdfdom reads and nobody uses."""

FURTHER = {
    'a caster too high': Mistake(
        ROBOT, CASTER, '<origin xyz="-0.13 0 0"/>',
        'warning: urdf/rover.urdf.xacro:90: ',
        'link "caster" does not reach the ground, and the robot tips over: found 50 mm above it',
        'lower it by 0.05 m',
    ),
    'grams': Mistake(
        ROBOT, 'mass="4.0"', 'mass="4000"',
        'warning: urdf/inertials.xacro:5: ',
        'link "base_link": a mass of 4000 kg in a shape of 0.00816 m³: grams?',
        'write <mass value="4"/> (in macro "box_inertial", called at urdf/rover.urdf.xacro:44)',
    ),
    'another separation of the wheels': Mistake(
        YAML, 'wheel_separation: 0.34', 'wheel_separation: 0.17',
        'warning: config/rover.yaml:18: ',
        'wheel_separation is not that of the wheels: found 0.17 m',
        'write wheel_separation: 0.34',
    ),
    'millimetres in the parameters': Mistake(
        YAML, 'wheel_radius: 0.08', 'wheel_radius: 160.0',
        'error: config/rover.yaml:19: ',
        "parameter 'wheel_radius' must be at most 100, found 160.0 m",
        'millimetres? write 0.16',
    ),
    'a number in quotes': Mistake(
        YAML, 'wheel_radius: 0.08', "wheel_radius: '0.08'",
        'error: config/rover.yaml:19: ',
        "parameter 'wheel_radius' must be of type double, found '0.08', a string",
        'write 0.08, without quotes',
    ),
    'a tab': Mistake(
        YAML, '    wheel_radius', '\twheel_radius',
        'error: config/rover.yaml:19:1: ',
        r"found character '\t' that cannot start any token",
        'YAML is indented by spaces, not tabs',
    ),
    'a property that is not there': Mistake(
        ROBOT, 'caster_radius - wheel_radius', 'caster_radius - weel_radius',
        'error: urdf/rover.urdf.xacro:93: ',
        "name 'weel_radius' is not defined",
        'did you mean wheel_radius?',
    ),
    'a macro that is not there': Mistake(
        ROBOT, '<xacro:sphere_inertial', '<xacro:sphere_inertia',
        'error: urdf/rover.urdf.xacro:88: ',
        'unknown macro name: xacro:sphere_inertia',
        'did you mean xacro:sphere_inertial?',
    ),
    'a parameter of a macro left out': Mistake(
        ROBOT, ' reflect="1"', '',
        'error: urdf/rover.urdf.xacro:73: ',
        'Undefined parameters [reflect]',
        f'give reflect="…" where the macro is called {IN_WHEEL}',
    ),
    'a misspelt parameter of a macro': Mistake(
        ROBOT, ' reflect="1"', ' reflct="1"',
        'error: urdf/rover.urdf.xacro:73: ',
        'Invalid parameter "reflct"',
        'did you mean reflect?',
    ),
    'a file that is not there': Mistake(
        ROBOT, 'filename="inertials.xacro"', 'filename="inertia.xacro"',
        'error: urdf/rover.urdf.xacro:5: ',
        'No such file or directory: ./urdf/inertia.xacro',
        'did you mean inertials.xacro?',
    ),
    'a package that is not there': Mistake(
        ROBOT, '"inertials.xacro"', '"$(find rover_description)/urdf/inertials.xacro"',
        'error: urdf/rover.urdf.xacro:5: ',
        "package 'rover_description' not found in AMENT_PREFIX_PATH",
        'build it and source install/setup.bash of its workspace, or correct the name',
    ),
}  # fmt: skip
"""What else was tried on the way."""


@pytest.fixture
def check(tmp_path, monkeypatch, capsys):
    """Check the rover with a mistake in it; give the exit code and the lines of our findings."""

    def run(mistake=None, *options):
        for file in (ROBOT, INERTIALS, YAML):
            text = (ROVER / file).read_text()
            if mistake is not None and file == mistake.file:
                assert mistake.old in text
                text = text.replace(mistake.old, mistake.new)
            path = tmp_path / file
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        monkeypatch.chdir(tmp_path)
        code = check_urdf.main([ROBOT, '--controllers', YAML, *options])
        lines = capsys.readouterr().err.replace(f'{tmp_path}/', '').splitlines()
        return code, [line for line in lines if line.startswith(('error: ', 'warning: '))]

    return run


def test_the_rover_is_right(check):
    assert check(None, '--strict') == (0, [])


def test_what_is_harmless_is_not_reported(check):
    assert check(HARMLESS, '--strict') == (0, [])


def test_all_but_two_of_the_33_are_named():
    assert len(MISTAKES) + len([HARMLESS]) == 33
    assert len(MISTAKES) >= 31


@pytest.mark.parametrize('name', [*MISTAKES, *FURTHER])
def test_the_first_line_names_the_cause_and_a_remedy(check, name):
    mistake = (MISTAKES | FURTHER)[name]
    code, lines = check(mistake, '--strict')
    assert code != 0
    place, _, rest = lines[0].partition(mistake.cause)
    assert place.startswith(mistake.place)
    assert mistake.cause in lines[0]
    assert mistake.remedy in rest


@pytest.mark.parametrize(
    'name',
    [
        'degrees', 'no rpy', 'a caster too deep', 'a misspelt parameter', 'a section for no node',
        'a controller type that is not there', 'a number in quotes', 'grams',
    ],
)  # fmt: skip
def test_nothing_is_said_of_what_follows(check, name):
    assert len(check((MISTAKES | FURTHER)[name])[1]) == 1
