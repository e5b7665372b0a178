# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo hardware component: with a fake world, and with the real one."""

import math

from fixtures.sim.arm import arm
from fixtures.sim.driving import AMR, Lines
from fixtures.sim.fake_world import cell, FakeWorld, info_of, PERIOD, URDF, velocity
import pytest

from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.sim.world import MujocoWorld


@pytest.fixture
def world():
    return FakeWorld()


@pytest.fixture
def system(world):
    system = MujocoSystem(info_of(), Lines(), world)
    system.configure()
    system.activate()
    return system


def test_interfaces_are_those_of_the_tag_in_its_order(system):
    assert [s.name for s in system.state_interfaces()] == [
        'jb/velocity',
        'jb/position',
        'ja/effort',
        'jc/position',
    ]
    assert [c.name for c in system.command_interfaces()] == ['jb/velocity', 'ja/velocity']


def test_states_are_valid_once_configured(world):
    world.state['jc', 'position'] = 1.5
    system = MujocoSystem(info_of(), Lines(), world)
    assert math.isnan(cell(system.state_interfaces(), 'jc/position').value)
    system.configure()
    assert [s.value for s in system.state_interfaces()] == [0.0, 0.0, 0.0, 1.5]


def test_read(system, world):
    world.state.update({('jb', 'velocity'): 2.0, ('jb', 'position'): 3.0, ('ja', 'effort'): 4.0})
    system.read(0, PERIOD)
    assert [s.value for s in system.state_interfaces()] == [2.0, 3.0, 4.0, 0.0]


def test_write_keeps_the_target_where_the_command_is_nan(system, world):
    jb, ja = system.command_interfaces()
    system.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': 'held'}
    jb.value = 5.0
    system.write(0, PERIOD)
    assert world.commands == {'jb': velocity(5.0), 'ja': 'held'}
    jb.value = math.nan
    ja.value = -1.0
    system.write(0, PERIOD)
    assert world.commands == {'jb': velocity(5.0), 'ja': velocity(-1.0)}


@pytest.mark.parametrize(
    'transition',
    [MujocoSystem.deactivate, MujocoSystem.activate, lambda system: system.reset(0)],
    ids=['deactivate', 'activate', 'reset'],
)
def test_transitions_hold_the_joints_and_drop_commands(system, world, transition):
    for command in system.command_interfaces():
        command.value = 5.0
    system.write(0, PERIOD)
    transition(system)
    assert world.commands == {'jb': 'held', 'ja': 'held'}
    assert all(math.isnan(command.value) for command in system.command_interfaces())
    system.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': 'held'}


def test_released_joint_is_held_and_the_others_go_on(system, world):
    for command in system.command_interfaces():
        command.value = 5.0
    system.write(0, PERIOD)
    system.perform_command_mode_switch([], ['jb/velocity'])
    system.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': velocity(5.0)}


def test_an_idle_joint_is_held_anew_at_every_write(system, world):
    # So that one which an overload has moved is brought back.
    jb, _ = system.command_interfaces()
    jb.value = 1.0
    system.write(0, PERIOD)
    world.commands.clear()
    system.write(0, PERIOD)
    assert world.commands == {'jb': velocity(1.0), 'ja': 'held'}


def test_infinite_command_stops_everything_and_fails(system, world):
    jb, ja = system.command_interfaces()
    jb.value = 5.0
    system.write(0, PERIOD)
    ja.value = math.inf
    with pytest.raises(HardwareError, match="hardware component 'Cart': not finite"):
        system.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': 'held'}


def test_needs_a_world():
    with pytest.raises(HardwareError, match='GazeboSimSystem needs a simulated world.*Generic'):
        MujocoSystem(info_of(), Lines(), None)


def test_interfaces_that_are_not_simulated_are_taken_and_named_in_one_line(world):
    urdf = URDF.replace(
        '<state_interface name="effort"/>',
        '<command_interface name="kp"/><state_interface name="voltage"/><state_interface '
        'name="current"><param name="initial_value">0.5</param></state_interface>',
    )
    sensor = '<sensor name="eye"/><sensor name="nose"><state_interface name="smell"/></sensor>'
    system = MujocoSystem(
        info_of(urdf.replace('</ros2_control>', f'{sensor}</ros2_control>')), Lines(), world
    )
    ((severity, text),) = system.log.lines
    assert severity is Severity.WARN
    assert text == (
        'hardware component \'Cart\': not simulated: "ja/kp", "ja/voltage", "ja/current", "eye", '
        '"nose/smell"; such states keep their initial values, such commands have no effect'
    )
    system.configure()
    system.activate()
    states = {state.name: state.value for state in system.state_interfaces()}
    assert math.isnan(states['ja/voltage']) and math.isnan(states['nose/smell'])
    assert states['ja/current'] == 0.5
    cell(system.command_interfaces(), 'ja/kp').value = 7.0
    switch(system, ['ja/kp', 'ja/velocity'])
    system.write(0, PERIOD)
    assert world.commands['ja'] == 'held'


def test_torque_and_force_are_other_names_of_effort(world):
    urdf = URDF.replace(
        '<command_interface name="velocity"/>',
        '<command_interface name="torque"/><state_interface name="force"/>'
        '<state_interface name="acceleration"/>',
        1,
    )
    system = MujocoSystem(info_of(urdf), Lines(), world)
    world.state.update({('jb', 'effort'): 2.0, ('jb', 'acceleration'): 3.0})
    system.configure()
    system.activate()
    assert cell(system.state_interfaces(), 'jb/force').value == 2.0
    assert cell(system.state_interfaces(), 'jb/acceleration').value == 3.0
    cell(system.command_interfaces(), 'jb/torque').value = 4.0
    system.write(0, PERIOD)
    assert world.commands['jb'] == ('effort', 4.0)
    assert system.log.lines == []


def test_commands_of_a_joint_that_follows_another_can_be_claimed_and_have_no_effect(world):
    follow = '<child link="b"/><mimic joint="ja"/></joint>'
    urdf = URDF.replace('<child link="b"/></joint>', follow)
    system = MujocoSystem(info_of(urdf), Lines(), FakeWorld(urdf))
    system.configure()
    system.activate()
    switch(system, ['jb/velocity', 'ja/velocity'])
    for command in system.command_interfaces():
        command.value = 2.0
    system.write(0, PERIOD)
    assert system.world.commands == {'ja': velocity(2.0)}


def test_interfaces_with_gains_are_exported_without_as_gazebo_does(world):
    urdf = URDF.replace(
        '<command_interface name="velocity"/>',
        '<param name="pos_kp">10</param><command_interface name="position_pid"/>',
        1,
    )
    system = MujocoSystem(info_of(urdf), Lines(), world)
    assert [command.name for command in system.command_interfaces()][0] == 'jb/position'
    assert "WARN hardware component 'Cart': gains of joints are left out: " in system.log.text


TRANSMISSION = """<transmission name="gear">
  <plugin>transmission_interface/SimpleTransmission</plugin>
  <joint name="ja" role="joint1"><mechanical_reduction>50</mechanical_reduction></joint>
  <actuator name="motor" role="actuator1"/></transmission></ros2_control>"""


def test_transmissions_are_not_applied_and_that_is_said(world):
    system = MujocoSystem(info_of(URDF.replace('</ros2_control>', TRANSMISSION)), Lines(), world)
    text = (
        'hardware component \'Cart\': transmissions are not applied, as in Gazebo: "gear"; '
        'commands and states are those of the joints'
    )
    assert system.log.lines == [(Severity.INFO, text)]
    cell(system.command_interfaces(), 'ja/velocity').value = 2.0
    system.activate()
    cell(system.command_interfaces(), 'ja/velocity').value = 2.0
    system.write(0, PERIOD)
    assert world.commands['ja'] == velocity(2.0)


GPIO = """<gpio name="valve"><command_interface name="open"/>
  <state_interface name="open"><param name="initial_value">1.0</param></state_interface>
  <state_interface name="pressure"/></gpio></ros2_control>"""


def test_states_of_a_gpio_follow_commands_of_their_name(world):
    system = MujocoSystem(info_of(URDF.replace('</ros2_control>', GPIO)), Lines(), world)
    system.configure()
    system.activate()
    is_open = cell(system.state_interfaces(), 'valve/open')
    assert is_open.value == 1.0
    command = cell(system.command_interfaces(), 'valve/open')
    switch(system, ['valve/open'])
    command.value = 0.0
    system.write(0, PERIOD)
    system.read(0, PERIOD)
    assert is_open.value == 0.0
    assert math.isnan(cell(system.state_interfaces(), 'valve/pressure').value)
    assert 'not simulated: "valve/pressure"; such states keep' in system.log.text
    system.reset(0)
    system.read(0, PERIOD)
    assert is_open.value == 1.0


def test_a_sensor_block_lends_no_commands_of_gpios(world):
    urdf = URDF.replace('</ros2_control>', GPIO).replace('type="system"', 'type="sensor"')
    system = MujocoSystem(info_of(urdf.replace(VELOCITY_COMMAND, '')), Lines(), world)
    assert system.command_interfaces() == []
    assert cell(system.state_interfaces(), 'valve/open')


VELOCITY_COMMAND = '<command_interface name="velocity"/>'


def test_joint_that_the_world_does_not_have(world):
    world.state = {('ja', 'position'): 0.0}
    with pytest.raises(HardwareError, match="hardware component 'Cart': there is no joint 'jb'"):
        MujocoSystem(info_of(), Lines(), world)


# --- several command interfaces on a joint -------------------------------------------------------

MULTI = URDF.replace(
    '<command_interface name="velocity"/>',
    '<command_interface name="position"/><command_interface name="velocity"/>'
    '<command_interface name="effort"/>',
    1,
)


@pytest.fixture
def multi(world):
    """``jb`` has three command interfaces, ``ja`` one."""
    system = MujocoSystem(info_of(MULTI), Lines(), world)
    system.configure()
    system.activate()
    return system


def switch(system, start=(), stop=()):
    system.prepare_command_mode_switch(start, stop)
    system.perform_command_mode_switch(start, stop)


@pytest.mark.parametrize('mode', ['position', 'velocity', 'effort'])
def test_only_the_claimed_command_acts_from_the_first_one_on(multi, world, mode):
    for command in multi.command_interfaces():
        command.value = 9.0
    switch(multi, [f'jb/{mode}'])
    multi.write(0, PERIOD)
    assert world.commands['jb'] == 'held'
    for command in multi.command_interfaces():
        command.value = 8.0 if command.interface == mode else 7.0
    multi.write(0, PERIOD)
    assert world.commands['jb'] == (mode, 8.0)


def test_unclaimed_joint_with_several_commands_is_held(multi, world):
    for command in multi.command_interfaces():
        command.value = 9.0
    multi.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': velocity(9.0)}


def test_from_mode_to_mode_in_one_switch(multi, world):
    position, _, effort, ja = multi.command_interfaces()
    switch(multi, ['jb/position', 'ja/velocity'])
    position.value, ja.value = 1.0, 2.0
    multi.write(0, PERIOD)
    assert world.commands == {'jb': ('position', 1.0), 'ja': velocity(2.0)}
    switch(multi, ['jb/effort'], ['jb/position'])
    # At once, not with the next write.
    assert world.commands == {'jb': 'held', 'ja': velocity(2.0)}
    multi.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': velocity(2.0)}
    effort.value, ja.value = -3.0, math.nan
    multi.write(0, PERIOD)
    assert world.commands == {'jb': ('effort', -3.0), 'ja': velocity(2.0)}
    switch(multi, [], ['jb/effort'])
    assert world.commands == {'jb': 'held', 'ja': velocity(2.0)}


def test_a_command_of_a_neighbour_survives_a_switch(multi, world):
    # Its first command is written in the same tick in which another joint changes hands.
    ja = cell(multi.command_interfaces(), 'ja/velocity')
    ja.value = 2.0
    switch(multi, ['jb/position'])
    multi.write(0, PERIOD)
    assert world.commands == {'jb': 'held', 'ja': velocity(2.0)}


@pytest.mark.parametrize(
    'claimed, start, stop',
    [
        (['jb/position'], ['jb/velocity'], []),
        (['jb/effort'], ['jb/velocity', 'jb/position'], []),
        (['jb/position'], ['jb/velocity', 'ja/velocity'], ['ja/velocity']),
    ],
)
def test_a_second_controller_of_a_joint_is_refused(multi, world, claimed, start, stop):
    switch(multi, claimed)
    with pytest.raises(HardwareError, match="'jb' is to be commanded by .* and .* at once; one"):
        multi.prepare_command_mode_switch(start, stop)
    # Nothing has changed.
    for command in multi.command_interfaces():
        command.value = 4.0
    multi.write(0, PERIOD)
    assert world.commands['jb'] == (claimed[0].removeprefix('jb/'), 4.0)


@pytest.mark.parametrize(
    'start, followed, unheeded',
    [
        (['jb/velocity', 'jb/position'], 'position', '"jb/velocity"'),
        (['jb/effort', 'jb/velocity'], 'velocity', '"jb/effort"'),
        (['jb/position', 'jb/velocity', 'jb/effort'], 'position', '"jb/velocity", "jb/effort"'),
    ],
)
def test_one_controller_may_claim_several_commands_of_a_joint(
    multi, world, start, followed, unheeded
):
    switch(multi, start)
    for number, command in enumerate(multi.command_interfaces()):
        command.value = float(number)
    multi.write(0, PERIOD)
    expected = ['position', 'velocity', 'effort'].index(followed)
    assert world.commands['jb'] == (followed, float(expected))
    text = f"INFO hardware component 'Cart': {unheeded} has no effect: of several commands to a"
    assert text in multi.log.text


def test_claims_end_with_the_component(multi):
    switch(multi, ['jb/position'])
    multi.deactivate()
    multi.cleanup()
    multi.configure()
    multi.activate()
    switch(multi, ['jb/velocity'])


# --- joints that nobody commands -----------------------------------------------------------------


def gazebo(hold_joints):
    name = 'gz_ros2_control::GazeboSimROS2ControlPlugin'
    inside = f'<hold_joints>{hold_joints}</hold_joints>'
    return f'<gazebo><plugin filename="x" name="{name}">{inside}</plugin></gazebo></robot>'


def parameter(hold_joints):
    return f'</plugin><param name="hold_joints">{hold_joints}</param>'


@pytest.mark.parametrize(
    'old, new, idle',
    [
        ('</robot>', gazebo('false'), 'free'),
        ('</robot>', gazebo('true'), 'held'),
        ('</plugin>', parameter('false'), 'free'),
        ('</plugin>', parameter('True'), 'held'),
    ],
)
def test_hold_joints(old, new, idle):
    urdf = URDF.replace(old, new)
    world = FakeWorld(urdf)
    system = MujocoSystem(info_of(urdf), Lines(), world)
    system.activate()
    assert world.commands == {'jb': idle, 'ja': idle}
    jb, _ = system.command_interfaces()
    jb.value = 1.0
    system.write(0, PERIOD)
    assert world.commands == {'jb': velocity(1.0), 'ja': idle}
    system.deactivate()
    assert world.commands == {'jb': idle, 'ja': idle}


def test_hold_joints_must_be_a_truth_value(world):
    urdf = URDF.replace('</plugin>', parameter('maybe'))
    with pytest.raises(HardwareError, match="'Cart': parameter 'hold_joints' is 'maybe'; true or"):
        MujocoSystem(info_of(urdf), Lines(), world)


def test_the_gain_of_gazebos_position_servo_is_warned_of(world):
    gain = '<position_proportional_gain>0.5</position_proportional_gain>'
    urdf = URDF.replace('</robot>', gazebo('true').replace('</plugin>', f'{gain}</plugin>'))
    system = MujocoSystem(info_of(urdf), Lines(), FakeWorld(urdf))
    assert "'Cart': <position_proportional_gain> is left out: positions are" in system.log.text
    silent = MujocoSystem(info_of(), Lines(), world)
    assert silent.log.lines == []


# --- the table of plugins ------------------------------------------------------------------------


@pytest.mark.parametrize(
    'plugin',
    [
        'amr_description/MujocoSystem',
        'gz_ros2_control/GazeboSimSystem',
        'mujoco_ros2_control/MujocoSystemInterface',
        'ign_ros2_control/IgnitionSystem',
        'gazebo_ros2_control/GazeboSystem',
        'webots_ros2_control::Ros2ControlSystem',
        'amr_description.hardware.mujoco_system/MujocoSystem',
    ],
)
def test_plugin_names(plugin):
    assert HARDWARE.find(plugin) is MujocoSystem


def test_unknown_plugin_is_reported_with_the_known_ones():
    with pytest.raises(HardwareError, match="'my/Robot' is not known.*mock_components/GenericSys"):
        HARDWARE.find('my/Robot')


# --- in the simulator ----------------------------------------------------------------------------


def test_drives_the_real_robot():
    world = MujocoWorld('empty')
    robot = world.spawn('amr', AMR)
    (info,) = hardware_of(robot.description)
    system = HARDWARE.find(info.plugin)(info, Lines(), robot)
    system.configure()
    system.activate()
    for command in system.command_interfaces():
        command.value = 5.0
    for _ in range(100):
        system.read(world.time, PERIOD)
        system.write(world.time, PERIOD)
        world.step(5)
    system.read(world.time, PERIOD)
    wheel = cell(system.state_interfaces(), 'joint_wheel_front_left/position')
    ahead, _, _ = robot.pose('base_footprint').translation
    # The step of the command makes the wheels slip by a few millimetres.
    assert ahead == pytest.approx(wheel.value * 0.1, abs=0.01)
    assert [s.value for s in system.state_interfaces() if s.interface == 'velocity'] == (
        pytest.approx([5.0] * 4, rel=1e-3)
    )


def test_arm_through_its_modes_and_a_reset():
    world, robot = arm()
    (info,) = hardware_of(robot.description)
    system = MujocoSystem(info, Lines(), robot)
    system.configure()
    system.activate()
    commands = {command.name: command for command in system.command_interfaces()}
    states = {state.name: state for state in system.state_interfaces()}

    def run(seconds):
        for _ in range(round(seconds * 100)):
            system.read(world.time, PERIOD)
            system.write(world.time, PERIOD)
            world.step(5)
        system.read(world.time, PERIOD)

    switch(system, ['shoulder/position', 'spindle/effort'])
    commands['shoulder/position'].value = -0.5
    commands['spindle/effort'].value = 0.1
    run(1.0)
    assert states['shoulder/position'].value == pytest.approx(-0.5, abs=1e-3)
    assert states['spindle/velocity'].value == pytest.approx(1.0, rel=1e-6)
    assert states['elbow/position'].value == pytest.approx(0.0, abs=1e-3)
    switch(system, ['shoulder/velocity'], ['shoulder/position', 'spindle/effort'])
    commands['shoulder/velocity'].value = 0.4
    run(1.0)
    assert states['shoulder/position'].value == pytest.approx(-0.1, abs=0.02)
    assert states['spindle/velocity'].value == pytest.approx(0.0, abs=1e-3)
    world.reset()
    system.reset(world.time)
    assert math.isnan(commands['shoulder/velocity'].value)
    run(0.5)
    assert [states[f'{joint}/position'].value for joint in ('shoulder', 'spindle')] == (
        pytest.approx([0.0, 0.0], abs=1e-3)
    )
