# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Poses and force-torque sensors in the ``<ros2_control>`` block of a simulated robot."""

import math
from statistics import fmean, pstdev

from fixtures.sim.arm import ARM, arm, GRAVITY, load_of
from fixtures.sim.driving import Lines
from fixtures.sim.fake_world import FakeWorld, info_of, PERIOD, URDF
import pytest

from amr_description.control.interfaces import (
    IMU_INTERFACES,
    MAGNETIC_INTERFACES,
    POSE_INTERFACES,
    WRENCH_INTERFACES,
)
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.sim.world import MujocoWorld

QUARTER = quaternion_from_yaw(math.pi / 2)


def sensor(interfaces, name='tcp', inside='<param name="frame_id">b</param>'):
    states = ''.join(f'<state_interface name="{interface}"/>' for interface in interfaces)
    return f'<sensor name="{name}">{states}{inside}</sensor></ros2_control>'


def measured(urdf, name='tcp', world=None):
    """Return what a sensor measures once, by interface, and the lines of the log."""
    world = world or FakeWorld(urdf)
    system = MujocoSystem(info_of(urdf), Lines(), world)
    system.configure()
    system.read(0, PERIOD)
    states = [state for state in system.state_interfaces() if state.prefix == name]
    return {state.interface: state.value for state in states}, system.log.lines


def with_sensor(*args, gazebo='', **options):
    part = sensor(*args, **options)
    return URDF.replace('</ros2_control>', part).replace('</robot>', f'{gazebo}</robot>')


def test_a_position_and_an_orientation_are_a_pose():
    urdf = with_sensor(POSE_INTERFACES)
    world = FakeWorld(urdf)
    world.poses = {'b': Transform((1.0, 2.0, 3.0), QUARTER)}
    values, lines = measured(urdf, world=world)
    assert [*values] == [*POSE_INTERFACES]
    assert [*values.values()] == [1.0, 2.0, 3.0, *QUARTER]
    assert (world.imus, lines) == ([], [])


def test_a_pose_stands_where_its_gazebo_sensor_does():
    gazebo = '<gazebo reference="b"><sensor name="tcp"><pose>1 0 0 0 0 0</pose></sensor></gazebo>'
    urdf = with_sensor(['position.y', 'position.z'], gazebo=gazebo, inside='')
    world = FakeWorld(urdf)
    world.poses = {'b': Transform((0.0, 0.0, 3.0), QUARTER)}
    values, _ = measured(urdf, world=world)
    assert values == pytest.approx({'position.y': 1.0, 'position.z': 3.0})


def test_a_sensor_of_the_tool_is_at_the_end_of_an_industrial_arm():
    urdf = with_sensor(POSE_INTERFACES, name='tcp_pose', inside='').replace('"b"', '"tool0"')
    world = FakeWorld(urdf)
    world.poses = {'tool0': Transform((1.0, 2.0, 3.0), QUARTER)}
    values, lines = measured(urdf, name='tcp_pose', world=world)
    assert (values['position.z'], lines) == (3.0, [])


def test_a_sensor_may_be_several_instruments():
    urdf = with_sensor(['position.x', *IMU_INTERFACES, 'force.z', 'height'])
    world = FakeWorld(urdf)
    world.poses = {'b': Transform((1.0, 2.0, 3.0), QUARTER)}
    values, ((_, text),) = measured(urdf, world=world)
    assert values['position.x'] == 1.0
    assert values['orientation.z'] == QUARTER[2], 'of the pose'
    assert values['angular_velocity.x'] == 1.0
    assert values['force.z'] == -3.0
    assert math.isnan(values['height'])
    assert 'not simulated: "tcp/height"; such' in text


# --- force and torque --------------------------------------------------------------------------


def force_torque(inside='', pose='0 0 0 0 0 1.5707963267948966'):
    """A sensor in joint jb, turned by 90 degrees against link b."""
    return (
        '<gazebo reference="jb"><sensor name="tcp" type="force_torque">'
        f'<pose>{pose}</pose><force_torque>{inside}</force_torque></sensor></gazebo></robot>'
    )


@pytest.mark.parametrize(
    ('inside', 'sign', 'turned'),
    [
        ('', -1.0, False),
        ('<frame>child</frame>', -1.0, False),
        ('<frame>sensor</frame>', -1.0, True),
        ('<measure_direction>parent_to_child</measure_direction>', 1.0, False),
    ],
)
def test_direction_and_axes_are_those_that_gazebo_would_take(inside, sign, turned):
    urdf = with_sensor(WRENCH_INTERFACES, inside='').replace('</robot>', force_torque(inside))
    world = FakeWorld(urdf)
    values, lines = measured(urdf, world=world)
    assert [*values.values()] == [sign * value for value in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)]
    ((link, pose), *_) = world.wrenches
    assert link == 'b'
    assert pose.rotation == pytest.approx(QUARTER if turned else (0.0, 0.0, 0.0, 1.0))
    assert lines == []


@pytest.fixture
def held_arm():
    """An arm that is held at 0.4 and 0.3 rad, with sensors in its elbow, and where it measures."""

    def settle(part, gazebo=''):
        urdf = ARM.replace('</ros2_control>', part).replace('</robot>', f'{gazebo}</robot>')
        for name, position in (('shoulder', 0.4), ('elbow', 0.3)):
            block = f'<joint name="{name}">'
            before, _, after = urdf.rpartition(block)
            state = '<state_interface name="position"/>'
            full = state.replace(
                '/>', f'><param name="initial_value">{position}</param></state_interface>'
            )
            urdf = before + block + after.replace(state, full, 1)
        world, robot = arm(urdf)
        (info,) = hardware_of(robot.description)
        system = MujocoSystem(info, Lines(), robot)
        system.configure()
        system.activate()
        for _ in range(200):
            system.write(world.time, PERIOD)
            world.step(5)
        system.read(world.time, PERIOD)
        states = [state for state in system.state_interfaces() if state.prefix == 'wrist']
        return {state.interface: state.value for state in states}

    return settle


# kg and N·m: of the fingers' rotors, which MuJoCo's sum has and which weigh nothing.
ROTORS = 2e-3


def test_a_sensor_carries_the_weight_of_what_hangs_on_it(held_arm):
    values = held_arm(sensor(WRENCH_INTERFACES, 'wrist', '<param name="frame_id">fore</param>'))
    weight = (1.0 + 0.1) * GRAVITY
    _, torque = load_of(0.4, 0.3)
    # In the axes of the link, which points 0.7 rad below the horizon.
    expected = (weight * math.sin(0.7), 0.0, -weight * math.cos(0.7), 0.0, torque, 0.0)
    assert [*values.values()] == pytest.approx(expected, abs=ROTORS * GRAVITY)


def test_a_sensor_away_from_the_joint_has_its_own_lever(held_arm):
    mount = (
        '<gazebo reference="elbow"><sensor name="wrist" type="force_torque"><pose>0.2 0 0 0 0 0'
        '</pose><force_torque><frame>parent</frame></force_torque></sensor></gazebo>'
    )
    values = held_arm(sensor(WRENCH_INTERFACES, 'wrist', ''), mount)
    weight = (1.0 + 0.1) * GRAVITY
    torque = 0.1 * 0.2 * GRAVITY * math.cos(0.7)  # of the fingers alone
    expected = (weight * math.sin(0.4), 0.0, -weight * math.cos(0.4), 0.0, torque, 0.0)
    assert [*values.values()] == pytest.approx(expected, abs=ROTORS * GRAVITY)


def test_a_sensor_on_a_frame_without_mass_is_in_the_joint_above(held_arm):
    frame = (
        '<link name="tool"/><joint name="tool_joint" type="fixed"><parent link="fore"/>'
        '<child link="tool"/><origin xyz="0.2 0 0" rpy="0 1.5707963267948966 0"/></joint>'
    )
    values = held_arm(
        sensor(WRENCH_INTERFACES, 'wrist', '<param name="frame">tool</param>'), frame
    )
    weight = (1.0 + 0.1) * GRAVITY
    torque = 0.1 * 0.2 * GRAVITY * math.cos(0.7)
    # x of the tool is down, z ahead.
    expected = (weight * math.cos(0.7), 0.0, weight * math.sin(0.7), 0.0, torque, 0.0)
    assert [*values.values()] == pytest.approx(expected, abs=ROTORS * GRAVITY)


def test_a_sensor_without_a_frame_measures_nothing_and_says_so():
    urdf = with_sensor(WRENCH_INTERFACES, inside='')
    values, ((_, text),) = measured(urdf)
    assert all(math.isnan(value) for value in values.values())
    assert text == (
        "hardware component 'Cart': sensor 'tcp': nothing says on which link it is mounted; write "
        '<param name="frame_id">LINK</param> in the sensor, with one of: base, a, b, c; it '
        'measures nothing'
    )


# --- magnetic fields, and noise ----------------------------------------------------------------


def test_a_magnetometer_measures_the_field_of_the_world_in_its_own_axes():
    gazebo = (
        '<gazebo reference="b"><sensor name="tcp" type="magnetometer">'
        '<pose>0 0 0 3.141592653589793 0 0</pose></sensor></gazebo>'
    )
    urdf = with_sensor(MAGNETIC_INTERFACES, gazebo=gazebo, inside='')
    world = FakeWorld(urdf)
    world.poses = {'b': Transform((1.0, 2.0, 3.0), QUARTER)}
    values, lines = measured(urdf, world=world)
    # b looks along y of the world; the sensor lies on its back in b.
    x, y, z = world.magnetic_field
    assert [*values.values()] == pytest.approx([y, x, -z])
    assert lines == []


@pytest.mark.parametrize(
    ('option', 'field'),
    [
        ('', (5.5645e-6, 22.8758e-6, -42.3884e-6)),
        ('<option magnetic="1e-5 0 -4e-5"/>', (1e-5, 0.0, -4e-5)),
    ],
)
def test_the_field_of_the_world_is_that_of_its_file_or_gazebos(tmp_path, option, field):
    path = tmp_path / 'world.xml'
    path.write_text(f'<mujoco>{option}<worldbody/></mujoco>')
    assert MujocoWorld(str(path)).spawn('arm', ARM).magnetic_field == field


NOISY = {
    'force_torque': ('jb', WRENCH_INTERFACES, '<{0}><{1}><z>{2}</z></{1}></{0}>', 'force'),
    'magnetometer': ('b', MAGNETIC_INTERFACES, '<{0}><z>{2}</z></{0}>', 'magnetic_field'),
}


@pytest.mark.parametrize('kind', NOISY)
def test_noise_and_bias_are_those_of_the_gazebo_sensor_and_begin_anew_with_a_reset(kind):
    place, interfaces, inside, quantity = NOISY[kind]
    noise = '<mean>0.5</mean><stddev>0.1</stddev><bias_mean>3</bias_mean>'
    noise = f'<noise type="gaussian">{noise}</noise>'
    gazebo = f'<gazebo reference="{place}"><sensor name="tcp" type="{kind}">'
    gazebo += f'{inside.format(kind, "force", noise)}</sensor></gazebo>'
    urdf = with_sensor(interfaces, gazebo=gazebo, inside='')
    exact, _ = measured(with_sensor(interfaces))
    system = MujocoSystem(info_of(urdf), Lines(), FakeWorld(urdf))
    (noisy,) = [s for s in system.state_interfaces() if s.name == f'tcp/{quantity}.z']

    def run():
        values = []
        for _ in range(300):
            system.read(0, PERIOD)
            values.append(noisy.value)
        return values

    first = run()
    others = [s for s in system.state_interfaces() if s.prefix == 'tcp' and s is not noisy]
    assert [s.value for s in others] == [exact[s.interface] for s in others]
    assert pstdev(first) == pytest.approx(0.1, rel=0.2)
    offset = fmean(first) - exact[f'{quantity}.z']
    assert min(abs(offset - 3.5), abs(offset + 2.5)) < 0.03
    system.reset(0)
    assert run() == first
