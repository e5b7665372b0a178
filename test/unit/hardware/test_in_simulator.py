# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which class stands for a plugin in the simulator."""

from dataclasses import replace

from fixtures.sim.driving import Lines
from fixtures.sim.fake_world import info_of
import pytest

from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.hardware.in_simulator import class_in_simulator
from amr_description.hardware.mock_system import MockSystem
from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.hardware.serial_base_system import SerialBaseSystem
from amr_description.log import Severity


def class_of(plugin, simulates_mocks=True):
    log = Lines()
    info = replace(info_of(), plugin=plugin)
    return class_in_simulator(info, log, simulates_mocks, plugin), log.lines


@pytest.mark.parametrize(
    'plugin',
    [
        'amr_description/MujocoSystem',
        'gz_ros2_control/GazeboSimSystem',
        'ign_ros2_control/IgnitionSystem',
        'gazebo_ros2_control/GazeboSystem',
        'franka_ign_ros2_control/IgnitionSystem',
        'mujoco_ros2_control/MujocoSystem',
        'mujoco_ros2_control/MujocoSystemInterface',
        'webots_ros2_control::Ros2ControlSystem',
        'topic_based_ros2_control/TopicBasedSystem',
        'amr_description.hardware.mujoco_system/MujocoSystem',
        '',
    ],
)
def test_simulated_without_a_word(plugin):
    assert class_of(plugin) == (MujocoSystem, [])


@pytest.mark.parametrize(
    'plugin',
    [
        'ur_robot_driver/URPositionHardwareInterface',
        'signal_driver/Motors',
        'amr_description/SerialBaseSystem',
        # A package of Python, and no such class in it.
        'amr_description/Base',
        'Motors',
    ],
)
def test_a_driver_of_real_hardware_is_simulated_and_said(plugin):
    found, ((severity, text),) = class_of(plugin)
    assert (found, severity) == (MujocoSystem, Severity.WARN)
    assert text == (
        f"hardware component 'Cart': plugin '{plugin}' drives real hardware and is not used here: "
        'its joints and sensors are simulated'
    )


@pytest.mark.parametrize(
    'plugin', ['mock_components/GenericSystem', 'fake_components/GenericSystem']
)
def test_mock_hardware_is_simulated_or_stays_a_mock(plugin):
    found, ((severity, text),) = class_of(plugin)
    assert (found, severity) == (MujocoSystem, Severity.INFO)
    assert text.endswith("GenericSystem' is simulated; mock_hardware:=mock keeps the mock")
    assert class_of(plugin, simulates_mocks=False) == (MockSystem, [])
    assert HARDWARE.find(plugin) is MockSystem, 'outside of the simulator'


def test_a_class_in_python_is_used():
    plugin = 'amr_description.hardware.serial_base_system/SerialBaseSystem'
    assert class_of(plugin) == (SerialBaseSystem, [])


@pytest.mark.parametrize(
    'plugin', ['amr_description.hardware.nothing/System', 'no_such_package.motors/Motors']
)
def test_a_module_that_cannot_be_imported_is_an_error(plugin):
    with pytest.raises(HardwareError, match=f"plugin '{plugin}' is not known, and cannot be imp"):
        class_of(plugin)


@pytest.mark.parametrize(
    'plugin', ['ur_robot_driver/URPositionHardwareInterface', 'topic_based_ros2_control/T']
)
def test_outside_of_the_simulator_an_unknown_plugin_is_an_error(plugin):
    with pytest.raises(HardwareError, match=f"plugin '{plugin}' is not known"):
        HARDWARE.find(plugin)
