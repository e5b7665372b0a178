# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""An inertial measurement unit in the ``<ros2_control>`` block of a simulated robot."""

from fixtures.sim.driving import Lines
from fixtures.sim.fake_world import FakeWorld, info_of, PERIOD, URDF
import pytest

from amr_description.control.interfaces import IMU_INTERFACES
from amr_description.errors import HardwareError
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.model.frames import Transform


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
        (
            with_imu(['orientation.x', 'temperature'], MOUNT),
            "sensor 'imu': state interface 'temperature' is asked; an IMU has: orientation.x, or",
        ),
    ],
)
def test_imu_that_cannot_be(urdf, message):
    with pytest.raises(HardwareError, match=f"hardware component 'Cart': .*{message}"):
        imu_of(urdf)
