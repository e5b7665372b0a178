# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The <ros2_control> and <gazebo> blocks: what is read, and what is refused how."""

import pytest
from support.paths import ROOT

from amr_description.errors import DescriptionError
from amr_description.model import urdf
from amr_description.model.checks import check
from amr_description.model.gazebo.tags import gazebo_plugins_of, GazeboPlugin
from amr_description.model.hardware_info import HardwareType, TransmissionEnd
from amr_description.model.robot import Mimic
from amr_description.model.ros2_control_tag import hardware_of

PLUGIN = '<hardware><plugin>p/P</plugin></hardware>'
WHEELS = ['front_left', 'front_right', 'back_left', 'back_right']


def robot_of(blocks):
    """Return a robot with a moving joint j, a mimic m of it and a fixed f; blocks on line 2."""
    ends = '<parent link="a"/><child link="{}"/>'
    return urdf.parse(
        '<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>'
        f'<joint name="j" type="continuous">{ends.format("b")}</joint>'
        f'<joint name="m" type="continuous">{ends.format("c")}'
        '<mimic joint="j" multiplier="2" offset="1"/></joint>'
        f'<joint name="f" type="fixed">{ends.format("d")}</joint>\n'
        f'{blocks}</robot>',
        'f',
    )


def block(inside, attributes='name="s" type="system"'):
    return f'<ros2_control {attributes}>{inside}</ros2_control>'


def joint(inside, attributes='name="j"'):
    return block(f'{PLUGIN}<joint {attributes}>{inside}</joint>')


@pytest.mark.parametrize(
    ('path', 'name', 'plugin'),
    [
        ('urdf/amr.urdf', 'AmrSystem', 'amr_description/MujocoSystem'),
        ('test/fixtures/tutorial/amr.urdf', 'GazeboSimSystem', 'gz_ros2_control/GazeboSimSystem'),
    ],
)
def test_wheels_take_a_velocity_and_give_position_and_velocity(path, name, plugin):
    (info,) = hardware_of(urdf.load(ROOT / path))
    assert (info.name, info.type, info.plugin) == (name, 'system', plugin)
    assert (info.group, info.parameters, info.rw_rate, info.is_async) == ('', {}, 0, False)
    assert [wheel.name for wheel in info.joints] == [f'joint_wheel_{place}' for place in WHEELS]
    for wheel in info.joints:
        assert [interface.name for interface in wheel.command_interfaces] == ['velocity']
        assert [i.name for i in wheel.state_interfaces] == ['position', 'velocity']
        (command,) = wheel.command_interfaces
        assert (command.data_type, command.size, command.limits_enabled) == ('double', 1, True)
        assert command.min is command.max is command.initial_value is None


@pytest.fixture(scope='module')
def arm():
    return hardware_of(urdf.load(ROOT / 'test/fixtures/urdf/arm.urdf'))


def test_attributes_and_hardware_parameters(arm):
    system, imu = arm
    assert (system.name, imu.name) == ('ArmSystem', 'Imu')
    assert (system.type, imu.type) == (HardwareType.SYSTEM, HardwareType.SENSOR)
    assert (system.group, system.rw_rate, system.is_async) == ('right_side', 50, True)
    assert system.parameters == {'calculate_dynamics': 'true', 'port': '/dev/ttyUSB0'}
    assert [part.name for part in system.components] == [
        'shoulder', 'left_finger', 'right_finger', 'wrist', 'valve',
    ]  # fmt: skip


def test_interfaces_and_their_parameters(arm):
    shoulder, left, right = arm[0].joints
    position, velocity = shoulder.command_interfaces
    assert (position.min, position.max, position.limits_enabled) == (-1.0, 1.5, True)
    assert position.parameters == {}, 'min and max have fields of their own'
    assert not velocity.limits_enabled
    assert shoulder.state_interfaces[0].initial_value == 0.25
    assert shoulder.parameters == {'gear': '100'}
    assert not left.command_interfaces[0].limits_enabled, 'limits of the whole joint are off'
    assert right.mimic == Mimic('left_finger', -1.5, 0.002)
    assert left.mimic is shoulder.mimic is None


def test_sensors_gpios_and_transmissions(arm):
    (wrist,), (valve,), (gear,) = arm[0].sensors, arm[0].gpios, arm[0].transmissions
    assert wrist.state_interfaces[0].name == 'force.z'
    assert wrist.parameters == {'frame_id': 'hand'}
    assert valve.command_interfaces[0].data_type == 'bool'
    assert valve.command_interfaces[0].initial_value == 1.0
    assert valve.state_interfaces[0].size == 4
    assert gear.plugin == 'transmission_interface/SimpleTransmission'
    assert gear.joints == (TransmissionEnd('shoulder', 'joint1', 100.0, 0.1),)
    assert gear.actuators == (TransmissionEnd('motor', 'actuator1'),)


def test_robot_without_a_block_has_no_hardware():
    assert hardware_of(robot_of('')) == ()


def test_lines_are_those_of_the_file():
    path = ROOT / 'urdf/amr.urdf'
    lines = path.read_text().splitlines()
    (info,) = hardware_of(urdf.load(path))
    assert '<ros2_control name="AmrSystem"' in lines[info.line - 1]
    for wheel in info.joints:
        assert f'<joint name="{wheel.name}">' in lines[wheel.line - 1]


def test_mimic_can_be_switched_off():
    command = '<command_interface name="velocity"/>'
    (info,) = hardware_of(robot_of(joint(command, 'name="m" mimic="false"')))
    assert info.joints[0].mimic is None
    assert info.joints[0].command_interfaces[0].name == 'velocity'


STATE = '<state_interface name="position"/>'
REFUSED = {
    'no name': (block(PLUGIN, 'type="system"'), '<ros2_control> has no attribute "name"'),
    'type': (block(PLUGIN, 'name="s" type="robot"'), 'found "robot", expected one of system'),
    'no type': (block(PLUGIN, 'name="s"'), 'type of <ros2_control>: found "", expected'),
    'no hardware': (block(''), 'no <hardware>; add <hardware><plugin>'),
    'no plugin': (block('<hardware/>'), 'no plugin in <hardware>; add <plugin>'),
    'empty plugin': (block('<hardware><plugin> </plugin></hardware>'), 'no plugin in <hardware>'),
    'twice': (
        block(PLUGIN) + '\n' + block(PLUGIN),
        "^f:3: .*Hardware name s is duplicated: found the first on line 2; provide",
    ),
    'tag': (block(f'{PLUGIN}<joints/>'), 'invalid tag name "joints": expected <hardware>'),
    'unknown joint': (
        joint(STATE, 'name="wheel"'),
        'Joint \'wheel\' not found in URDF: expected one of "j", "m"$',
    ),
    'unnamed joint': (joint(STATE, ''), '<joint> has no attribute "name"'),
    'joint twice': (
        block(f'{PLUGIN}<joint name="j"/><joint name="j"/>'),
        "Joint 'j' is listed twice",
    ),
    'fixed': (joint(STATE, 'name="f"'), "Joint 'f' is of type 'fixed': expected a joint that mov"),
    'mimic commanded': (
        joint('<command_interface name="velocity"/>', 'name="m"'),
        "Joint 'm' has mimic attribute not set to false: .*; remove its command interfaces",
    ),
    'mimicked absent': (
        joint(STATE, 'name="m"'),
        'Joint \'m\' mimics a joint that is not in this tag: found "j", expected one of "m"',
    ),
    'mimic of nothing': (
        joint(STATE, 'name="j" mimic="true"'),
        'Joint \'j\' has mimic="true", but no <mimic> in the URDF',
    ),
    'mimic value': (joint(STATE, 'name="m" mimic="maybe"'), 'found "maybe", expected true'),
    'rate': (
        block(PLUGIN, 'name="s" type="system" rw_rate="0"'),
        'rw_rate: found "0", expected a non-zero positive integer',
    ),
    'fast': (
        block(PLUGIN, 'name="s" type="system" rw_rate="1e3"'),
        'rw_rate: found "1e3", expected a non-zero positive integer',
    ),
    'async': (
        block(PLUGIN, 'name="s" type="system" is_async="yes"'),
        'is_async of <ros2_control>: found "yes", expected true or false',
    ),
    'unnamed interface': (joint('<state_interface/>'), '<state_interface> has no attribute'),
    'interface twice': (joint(STATE * 2), 'state_interface "position" is there twice'),
    'data type': (
        joint('<state_interface name="x" data_type="complex"/>'),
        'data_type of <state_interface>: found "complex", expected one of double, bool',
    ),
    'size': (joint('<state_interface name="x" size="1.5"/>'), 'found "1.5", expected an integer'),
    'size word': (joint('<state_interface name="x" size="x"/>'), 'found "x", expected a number'),
    'too large': (
        joint('<state_interface name="x" data_type="uint8"><param name="initial_value">256</param>'
              '</state_interface>'),
        '"initial_value": found 256, expected an integer from 0 to 255, as its data_type is uint8',
    ),
    'too small': (
        joint('<state_interface name="x" data_type="int16"><param name="initial_value">-32769'
              '</param></state_interface>'),
        'found -32769, expected an integer from -32768 to 32767',
    ),
    'no integer': (
        joint('<state_interface name="x" data_type="int32"><param name="initial_value">1.5'
              '</param></state_interface>'),
        'found 1.5, expected an integer from',
    ),
    'transmission': (
        block(f'{PLUGIN}<transmission name="t"><plugin>p</plugin><joint name="j">'
              '<mechanical_reduction>much</mechanical_reduction></joint></transmission>'),
        'transmission "t": <mechanical_reduction>: found "much", expected a finite number',
    ),
}  # fmt: skip


@pytest.mark.parametrize(('blocks', 'message'), REFUSED.values(), ids=REFUSED)
def test_refuses(blocks, message):
    robot = robot_of(blocks)
    with pytest.raises(DescriptionError, match=message) as caught:
        hardware_of(robot, strict=True)
    assert str(caught.value).startswith(('f:2: ros2_control "', 'f:3: Hardware name'))


VELOCITY = '<command_interface name="velocity"/>'
TAKEN = {
    'no hardware': ('', lambda info: info.plugin == ''),
    'no plugin': ('<hardware/>', lambda info: info.plugin == ''),
    'tag': (f'{PLUGIN}<joints/><joint name="j"/>', lambda info: [*names(info)] == ['j']),
    'unknown joint': (
        f'{PLUGIN}<joint name="wheel"/><joint name="j"/>',
        lambda info: [*names(info)] == ['j'],
    ),
    'fixed': (
        f'{PLUGIN}<joint name="f"/><joint name="j"/>',
        lambda info: [*names(info)] == ['j'],
    ),
    'joint twice': (
        f'{PLUGIN}<joint name="j">{STATE}</joint><joint name="j"/>',
        lambda info: len(info.joints) == len(info.joints[0].state_interfaces) == 1,
    ),
    'interface twice': (
        f'{PLUGIN}<joint name="j">{STATE * 2}</joint>',
        lambda info: len(info.joints[0].state_interfaces) == 1,
    ),
    'mimic commanded': (
        f'{PLUGIN}<joint name="m">{VELOCITY}{STATE}</joint>',
        lambda info: info.joints[0].mimic and info.joints[0].command_interfaces,
    ),
    'mimicked absent': (
        f'{PLUGIN}<joint name="m">{STATE}</joint>',
        lambda info: info.joints[0].mimic == Mimic('j', 2.0, 1.0),
    ),
    'mimic of nothing': (
        f'{PLUGIN}<joint name="j" mimic="true">{VELOCITY}</joint>',
        lambda info: info.joints[0].mimic is None and info.joints[0].command_interfaces,
    ),
    'initial value': (
        f'{PLUGIN}<joint name="j"><state_interface name="position"><param name="initial_value">'
        'home</param></state_interface></joint>',
        lambda info: info.joints[0].state_interfaces[0].initial_value is None,
    ),
}


def names(info):
    return (joint.name for joint in info.joints)


@pytest.mark.parametrize(('inside', 'holds'), TAKEN.values(), ids=TAKEN)
def test_the_simulator_takes_what_real_hardware_cannot(inside, holds):
    robot = robot_of(block(inside))
    (info,) = hardware_of(robot)
    assert holds(info)
    with pytest.raises(DescriptionError):
        hardware_of(robot, strict=True)


def test_a_block_of_a_type_that_nobody_knows_is_passed_by():
    robot = robot_of(block(PLUGIN, 'name="s" type="diffdrive_arduino/X"') + block(PLUGIN))
    (info,) = hardware_of(robot, strict=False)
    assert info.name == 's' and info.type == 'system'
    with pytest.raises(DescriptionError, match='found "diffdrive_arduino/X"'):
        hardware_of(robot, strict=True)


def test_of_two_blocks_of_one_name_the_simulator_takes_the_first():
    (info,) = hardware_of(robot_of(block(PLUGIN) + block(PLUGIN.replace('p/P', 'q/Q'))))
    assert info.plugin == 'p/P'


def bounded(low, high):
    texts = f'<param name="min">{low}</param><param name="max">{high}</param>'
    return joint(f'<command_interface name="x">{texts}</command_interface>')


WARNED = {
    'min': (
        bounded("'-3.14'", '1'),
        'parameter "min": found "\'-3.14\'", expected a finite number; its bounds are skipped',
    ),
    'infinite': (bounded('-1', 'inf'), 'parameter "max": found "inf", expected a finite number; '),
    'min above max': (
        bounded('2', '1'),
        'parameters "min" and "max": found 2 and 1, expected a "min" that is not above "max"',
    ),
    'parameter twice': (
        block(
            '<hardware><plugin>p</plugin><param name="a">1</param><param name="a">2</param>'
            '</hardware>'
        ),
        'parameter "a" is set twice; the last one counts',
    ),
    'inner tag': (
        joint('<command name="x"/>'),
        'joint "j": invalid tag name "command": expected <command_interface>, <state_interface>, ',
    ),
    'hardware tag': (
        block('<hardware><plugin>p</plugin><params/></hardware>'),
        'invalid tag name "params": expected <plugin>, <group>, <param>; it has no effect',
    ),
    'sensor commanded': (
        block(f'{PLUGIN}<sensor name="s"><command_interface name="x"/></sensor>'),
        'sensor "s": invalid tag name "command_interface": expected <state_interface>, <param>',
    ),
    'mimic parameter': (
        joint('<param name="mimic">j</param><param name="multiplier">-</param>'),
        '"s": it does not follow another joint: found mimic "j", multiplier "-", expected the ',
    ),
}


@pytest.mark.parametrize(('blocks', 'message'), WARNED.values(), ids=WARNED)
def test_what_ros2_control_reads_over_is_warned_of(blocks, message):
    robot = robot_of(blocks)
    lines = []
    (info,) = hardware_of(robot, strict=True, warn=lines.append)
    assert any(line.startswith('f:2: ') and message in line for line in lines)
    assert not any(interface.min or interface.max for interface in interfaces(info))
    assert info.parameters.get('a', '2') == '2'
    assert any(message in str(finding) for finding in check(robot.text, 'f'))
    assert not any(f.severity == 'error' and 'ros2_control' in f.what for f in check(robot.text))


def interfaces(info):
    return (each for part in info.components for each in part.command_interfaces)


def test_a_joint_follows_another_by_parameters_as_in_humble():
    follow = '<param name="mimic">m</param><param name="multiplier">-1</param>'
    (info,) = hardware_of(robot_of(joint(f'{follow}{STATE}')))
    assert info.joints[0].mimic == Mimic('m', -1.0)
    commanded, switched_off = (
        hardware_of(robot_of(joint(f'{follow}{VELOCITY}'))),
        hardware_of(robot_of(joint(follow, 'name="j" mimic="false"'))),
    )
    assert commanded[0].joints[0].mimic is switched_off[0].joints[0].mimic is None


def test_an_empty_initial_value_is_none():
    state = STATE.replace('/>', '><param name="initial_value"/></state_interface>')
    (info,) = hardware_of(robot_of(joint(state)), strict=True)
    assert info.joints[0].state_interfaces[0].initial_value is None


def test_gazebo_plugin_of_the_tutorial():
    (plugin,) = gazebo_plugins_of(urdf.load(ROOT / 'test/fixtures/tutorial/amr.urdf'))
    assert plugin.filename == 'libgz_ros2_control-system.so'
    assert plugin.hosts_ros2_control
    assert plugin.parameters == ('/absolute/path/to/config/controllers.yaml',)
    assert (plugin.controller_manager_name, plugin.namespace) == ('controller_manager', '')
    assert plugin.hold_joints
    assert plugin.remappings == ()


GZ = 'gz_ros2_control::GazeboSimROS2ControlPlugin'


def gazebo(inside, name=GZ):
    return f'<gazebo><plugin filename="lib.so" name="{name}">{inside}</plugin></gazebo>'


def test_gazebo_plugin_with_everything():
    robot = robot_of(
        gazebo(
            '<parameters>a.yaml</parameters><parameters>b.yaml</parameters>'
            '<controller_manager_name>cm</controller_manager_name>'
            '<hold_joints>false</hold_joints>'
            '<position_proportional_gain>0.5</position_proportional_gain>'
            '<ros><namespace>left</namespace>'
            '<remapping>a:=b</remapping><remapping>c:=d</remapping></ros>'
        )
    )
    assert gazebo_plugins_of(robot) == (
        GazeboPlugin(
            filename='lib.so',
            name=GZ,
            line=2,
            parameters=('a.yaml', 'b.yaml'),
            controller_manager_name='cm',
            namespace='left',
            remappings=('a:=b', 'c:=d'),
            hold_joints=False,
            position_proportional_gain=0.5,
        ),
    )


def test_other_gazebo_plugins_are_not_judged():
    (plugin,) = gazebo_plugins_of(robot_of(gazebo('<parameters/>', 'gz::sim::systems::Imu')))
    assert not plugin.hosts_ros2_control
    assert gazebo_plugins_of(robot_of('<gazebo reference="b"><mu1>1</mu1></gazebo>')) == ()


@pytest.mark.parametrize(
    ('inside', 'message'),
    [
        ('<parameters> </parameters>', '<parameters> is empty: expected the path of a YAML file'),
        ('<hold_joints>maybe</hold_joints>', '<hold_joints>: found "maybe", expected true or fal'),
        (
            '<position_proportional_gain>-1</position_proportional_gain>',
            '<position_proportional_gain>: found "-1", expected a finite number above 0',
        ),
    ],
)
def test_refuses_in_the_gazebo_block(inside, message):
    with pytest.raises(DescriptionError, match=f'^f:2: gazebo plugin "{GZ}": {message}'):
        gazebo_plugins_of(robot_of(gazebo(inside)))
