# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""An inertial measurement unit in the ``<ros2_control>`` block of a simulated robot."""

import math
import re
from statistics import fmean, pstdev

from fixtures.sim.driving import AMR, Drive, Lines
from fixtures.sim.fake_world import cell, FakeWorld, info_of, PERIOD, URDF
import pytest

from amr_description.control.interfaces import IMU_INTERFACES
from amr_description.control.world import ImuReading
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.model.frames import rotate, Transform
from amr_description.model.ros2_control_tag import hardware_of


def with_imu(interfaces, mount='', parameters='', name='imu'):
    states = ''.join(f'<state_interface name="{interface}"/>' for interface in interfaces)
    sensor = f'<sensor name="{name}">{states}{parameters}</sensor></ros2_control>{mount}'
    return URDF.replace('</ros2_control>', sensor)


def imu_of(urdf):
    world = FakeWorld(urdf)
    return MujocoSystem(info_of(urdf), Lines(), world), world


SENSOR = '<sensor name="imu" type="imu"><pose>1 2 3 0 0 0</pose></sensor>'
MOUNT = f'<gazebo reference="b">{SENSOR}</gazebo>'


def test_imu_states_in_the_order_of_the_tag():
    system, world = imu_of(with_imu(IMU_INTERFACES, MOUNT))
    assert [s.name for s in system.state_interfaces()][4:] == [f'imu/{i}' for i in IMU_INTERFACES]
    system.configure()
    expected = [0.1, 0.2, 0.3, 0.9, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert [s.value for s in system.state_interfaces()][4:] == expected
    assert world.imus == [('b', Transform((1.0, 2.0, 3.0)))]
    assert system.log.lines == []


def test_imu_with_some_interfaces_only():
    system, _ = imu_of(with_imu(['angular_velocity.z', 'orientation.w'], MOUNT))
    system.read(0, PERIOD)
    assert [s.value for s in system.state_interfaces()][4:] == [3.0, 0.9]


@pytest.mark.parametrize(
    'options, link',
    [
        ({'parameters': '<param name="link">a</param>'}, 'a'),
        ({'parameters': '<param name="frame_id">c</param>'}, 'c'),
        ({'name': 'base'}, 'base'),
        ({'name': 'base_sensor'}, 'base'),
        ({'parameters': '<param name="mujoco_sensor_name">a_sensor</param>'}, 'a'),
        ({'name': 'jb'}, 'b'),
        ({'mount': MOUNT, 'parameters': '<param name="link">a</param>'}, 'b'),
    ],
)
def test_where_an_imu_is_mounted(options, link):
    system, world = imu_of(with_imu(['orientation.x'], **options))
    system.read(0, PERIOD)
    assert [where for where, _ in world.imus] == [link]


@pytest.mark.parametrize(
    'urdf, message',
    [
        (with_imu(['orientation.x']), "'imu': nothing says on which link it is mounted; write "),
        (with_imu(['orientation.x']), 'one of: base, a, b, c'),
        (
            with_imu(['orientation.x'], parameters='<param name="link">nose</param>'),
            "sensor 'imu': there is no link 'nose' to mount it on; there are: base, a, b, c",
        ),
    ],
)
def test_an_imu_that_is_mounted_nowhere_measures_nothing(urdf, message):
    system, world = imu_of(urdf)
    system.configure()
    assert math.isnan(cell(system.state_interfaces(), 'imu/orientation.x').value)
    assert world.imus == []
    assert re.search(
        f"^WARN hardware component 'Cart': .*{message}.*; it measures nothing$",
        system.log.text,
    )


def test_what_else_a_sensor_has_is_left_as_it_is():
    system, world = imu_of(with_imu(['orientation.x', 'temperature'], MOUNT))
    system.configure()
    assert cell(system.state_interfaces(), 'imu/orientation.x').value == 0.1
    assert math.isnan(cell(system.state_interfaces(), 'imu/temperature').value)
    assert 'not simulated: "imu/temperature"; such states' in system.log.text


def test_component_of_nothing_but_an_imu_in_the_simulator():
    states = ''.join(f'<state_interface name="{interface}"/>' for interface in IMU_INTERFACES)
    plugin = '<hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>'
    block = (
        f'<ros2_control name="Imu" type="sensor">{plugin}<sensor name="imu">{states}'
        '<param name="frame_id">base_link</param></sensor></ros2_control></robot>'
    )
    drive = Drive(AMR.replace('</robot>', block))
    system = MujocoSystem(hardware_of(drive.robot.description)[-1], Lines(), drive.robot)
    system.configure()
    system.activate()
    drive.run(0.0, 1.0, 2.0)
    system.read(drive.world.time, PERIOD)
    system.write(drive.world.time, PERIOD)
    values = {state.interface: state.value for state in system.state_interfaces()}
    _, rates = drive.robot.velocity('base_link')
    assert values['angular_velocity.z'] == pytest.approx(rates[2]) == pytest.approx(1.0, rel=0.05)
    assert values['linear_acceleration.z'] == pytest.approx(9.81, abs=0.05)
    assert 2.0 * math.atan2(values['orientation.z'], values['orientation.w']) == (
        pytest.approx(drive.yaw, abs=1e-6)
    )


# --- noise -------------------------------------------------------------------------------------

NOISE = '<noise type="gaussian"><mean>0.5</mean><stddev>0.01</stddev></noise>'


def noisy_imus(*names):
    """The amr with units that are noisy about z."""
    states = ''.join(f'<state_interface name="{interface}"/>' for interface in IMU_INTERFACES)
    plugin = '<hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>'
    sensors = ''.join(f'<sensor name="{name}">{states}</sensor>' for name in names)
    mounts = ''.join(
        f'<sensor name="{name}" type="imu"><imu><angular_velocity><z>{NOISE}</z>'
        '</angular_velocity></imu></sensor>'
        for name in names
    )
    return AMR.replace(
        '</robot>',
        f'<ros2_control name="Imu" type="sensor">{plugin}{sensors}</ros2_control>'
        f'<gazebo reference="base_link">{mounts}</gazebo></robot>',
    )


class Noisy:
    """A robot that drives, and what its units measure."""

    def __init__(self, *names, robot='amr', **options):
        self.drive = Drive(noisy_imus(*names), name=robot, **options)
        info = hardware_of(self.drive.robot.description)[-1]
        self.system = MujocoSystem(info, Lines(), self.drive.robot)
        self.system.configure()

    def measure(self, ticks=50):
        """Return the error of each unit about z in so many ticks."""
        cells = [s for s in self.system.state_interfaces() if s.name.endswith('velocity.z')]
        measured = []
        self.drive.command(0.5, 1.0)
        for _ in range(ticks):
            self.drive.tick()
            self.system.read(self.drive.world.time, PERIOD)
            _, (_, _, true) = self.drive.robot.velocity('base_link')
            measured.append([cell.value - true for cell in cells])
        return measured


def test_only_the_requested_quantities_are_noisy():
    noisy = Noisy('imu')
    noise = [value for (value,) in noisy.measure(400)]
    assert fmean(noise) == pytest.approx(0.5, abs=5 * 0.01 / 20)
    assert pstdev(noise) == pytest.approx(0.01, rel=0.2)
    values = {state.interface: state.value for state in noisy.system.state_interfaces()}
    truth = noisy.drive.robot.imu('base_link', Transform())
    assert values['linear_acceleration.z'] == truth.linear_acceleration[2]
    assert values['angular_velocity.x'] == truth.angular_velocity[0]


def test_noise_follows_from_the_seed_bit_by_bit():
    expected = Noisy('imu').measure()
    assert Noisy('imu').measure() == expected
    assert Noisy('imu', seed=1).measure() != expected
    assert Noisy('imu', robot='other').measure() != expected


def test_another_unit_does_not_change_what_one_measures():
    alone = Noisy('imu').measure()
    both = Noisy('imu', 'second').measure()
    assert [[first] for first, _ in both] == alone
    assert all(first != second for first, second in both)


def test_after_a_reset_the_noise_is_repeated():
    noisy = Noisy('imu')
    runs = []
    for _ in range(2):
        noisy.drive.world.reset()
        noisy.system.reset(0)
        runs.append(noisy.measure())
    assert runs[0] == runs[1]


LOOKS_EAST = (0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ('inside', 'x_axis', 'z_axis'),
    [
        ('<localization>ENU</localization>', (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
        # East is the second axis of NED, and up is against its third.
        ('<localization>NED</localization>', (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)),
        ('<localization>NWU</localization>', (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
        (
            '<localization>CUSTOM</localization><custom_rpy>0 0 1.5707963267948966</custom_rpy>',
            (0.0, -1.0, 0.0),
            (0.0, 0.0, 1.0),
        ),
    ],
)
def test_the_orientation_is_relative_to_the_frame_that_is_named(inside, x_axis, z_axis):
    frame = f'<imu><orientation_reference_frame>{inside}</orientation_reference_frame></imu>'
    mount = f'<gazebo reference="b"><sensor name="imu" type="imu">{frame}</sensor></gazebo>'
    system, world = imu_of(with_imu(IMU_INTERFACES, mount))
    world.reading = ImuReading(LOOKS_EAST, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    system.read(0, PERIOD)
    x, y, z, w, *others = [s.value for s in system.state_interfaces()][4:]
    assert rotate((x, y, z, w), (1.0, 0.0, 0.0)) == pytest.approx(x_axis)
    assert rotate((x, y, z, w), (0.0, 0.0, 1.0)) == pytest.approx(z_axis)
    assert others == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert system.log.lines == []


def test_a_frame_of_the_orientation_that_is_not_known_is_told():
    inside = '<orientation_reference_frame><localization>GRAV_UP</localization>'
    mount = '<gazebo reference="b"><sensor name="imu" type="imu"><imu>'
    mount += f'{inside}</orientation_reference_frame></imu></sensor></gazebo>'
    system, _ = imu_of(with_imu(IMU_INTERFACES, mount))
    ((_, line),) = system.log.lines
    assert "its <localization> is 'GRAV_UP'; it is taken as ENU" in line


def test_noise_as_before_sdf_1_5_is_that_of_all_axes():
    old = (
        '<imu><noise><type>gaussian</type><rate><mean>5</mean><stddev>0</stddev></rate>'
        '<accel><mean>0</mean><stddev>0</stddev><bias_mean>7</bias_mean></accel></noise></imu>'
    )
    mount = f'<gazebo reference="b"><sensor name="imu" type="imu">{old}</sensor></gazebo>'
    system, world = imu_of(with_imu(IMU_INTERFACES, mount))
    system.read(0, PERIOD)
    values = [s.value for s in system.state_interfaces()][8:]
    exact = (*world.reading.angular_velocity, *world.reading.linear_acceleration)
    offsets = [a - b for a, b in zip(values, exact, strict=True)]
    assert offsets[:3] == pytest.approx([5.0] * 3)
    assert [abs(each) for each in offsets[3:]] == pytest.approx([7.0] * 3)
