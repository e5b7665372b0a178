# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo hardware component: with a fake world, and with the real one."""

import math

from fixtures.sim.driving import AMR, Lines
import pytest

from amr_description.control.contracts import Severity
from amr_description.control.world import ImuReading
from amr_description.errors import HardwareError, SimulationError
from amr_description.hardware import HARDWARE
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.sim.world import MujocoWorld

PERIOD = 10_000_000

URDF = """
<robot name="cart">
  <link name="base"/><link name="a"/><link name="b"/><link name="c"/>
  <joint name="ja" type="continuous"><parent link="base"/><child link="a"/></joint>
  <joint name="jb" type="continuous"><parent link="base"/><child link="b"/></joint>
  <joint name="jc" type="continuous"><parent link="base"/><child link="c"/></joint>
  <ros2_control name="Cart" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="jb">
      <command_interface name="velocity"/>
      <state_interface name="velocity"/>
      <state_interface name="position"/>
    </joint>
    <joint name="ja">
      <command_interface name="velocity"/>
      <state_interface name="effort"/>
    </joint>
    <joint name="jc"><state_interface name="position"/></joint>
  </ros2_control>
</robot>
"""


class FakeJoints:
    """Each joint's last command, 'held' or 'free' is kept in the world's ``commands``."""

    def __init__(self, world, names):
        self.world, self.names = world, names

    def positions(self):
        return [self.world.state[name, 'position'] for name in self.names]

    def velocities(self):
        return [self.world.state[name, 'velocity'] for name in self.names]

    def efforts(self):
        return [self.world.state[name, 'effort'] for name in self.names]

    def command(self, interface, values):
        if not all(map(math.isfinite, values)):
            raise SimulationError('not finite')
        told = [(interface, value) for value in values]
        self.world.commands.update(zip(self.names, told, strict=True))

    def hold(self):
        self.world.commands.update(dict.fromkeys(self.names, 'held'))

    def release(self):
        self.world.commands.update(dict.fromkeys(self.names, 'free'))


class FakeWorld:
    """Three joints; what is commanded is remembered."""

    time = 0
    reading = ImuReading((0.1, 0.2, 0.3, 0.9), (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))

    def __init__(self, urdf=URDF):
        interfaces = ('position', 'velocity', 'effort')
        self.description = parse(urdf)
        self.state = {(j, i): 0.0 for j in ('ja', 'jb', 'jc') for i in interfaces}
        self.commands = {}
        self.imus = []

    def joints(self, names):
        for name in names:
            if (name, 'position') not in self.state:
                raise SimulationError(f"there is no joint '{name}'")
        return FakeJoints(self, names)

    def imu(self, link, place):
        self.imus.append((link, place))
        return self.reading


def velocity(value):
    return ('velocity', value)


def info_of(urdf=URDF):
    return hardware_of(parse(urdf))[0]


@pytest.fixture
def world():
    return FakeWorld()


@pytest.fixture
def system(world):
    system = MujocoSystem(info_of(), Lines(), world)
    system.configure()
    system.activate()
    return system


def cell(handles, name):
    return next(handle for handle in handles if handle.name == name)


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
def test_transitions_hold_still_and_forget_commands(system, world, transition):
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


@pytest.mark.parametrize(
    'old, new, message',
    [
        (
            '<command_interface name="velocity"/>',
            '<command_interface name="acceleration"/>',
            "joint 'jb': command interface 'acceleration' is asked; there are: position, v",
        ),
        (
            '<state_interface name="effort"/>',
            '<state_interface name="voltage"/>',
            "joint 'ja': state interface 'voltage' is asked; there are: position, velocity, effo",
        ),
    ],
)
def test_interface_that_it_does_not_have(world, old, new, message):
    with pytest.raises(HardwareError, match=message):
        MujocoSystem(info_of(URDF.replace(old, new, 1)), Lines(), world)


def test_joint_that_the_world_does_not_have(world):
    world.state = {('ja', 'position'): 0.0}
    with pytest.raises(HardwareError, match="hardware component 'Cart': there is no joint 'jb'"):
        MujocoSystem(info_of(), Lines(), world)


@pytest.mark.parametrize('kind', ['sensor', 'gpio'])
def test_what_is_not_simulated_is_told(world, kind):
    part = f'<{kind} name="it"><state_interface name="counts"/></{kind}></ros2_control>'
    log = Lines()
    system = MujocoSystem(info_of(URDF.replace('</ros2_control>', part)), log, world)
    assert len(system.state_interfaces()) == 4
    text = f"hardware component 'Cart': {kind} 'it' is not simulated and has no interfaces"
    assert log.lines == [(Severity.WARN, text)]


# --- the table of plugins ------------------------------------------------------------------------


@pytest.mark.parametrize(
    'plugin',
    [
        'amr_description/MujocoSystem',
        'gz_ros2_control/GazeboSimSystem',
        'mujoco_ros2_control/MujocoSystemInterface',
        'amr_description.hardware.mujoco_system/MujocoSystem',
    ],
)
def test_plugin_names(plugin):
    assert HARDWARE.find(plugin) is MujocoSystem


def test_unknown_plugin_is_told_with_the_known_ones():
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
