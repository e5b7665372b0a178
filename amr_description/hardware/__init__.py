# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Hardware components: drivers of simulated, mocked and real robots.

``<plugin>`` of a ``<ros2_control>`` block names the class: one of :data:`HARDWARE`, or
``my_package.my_module/MyClass`` for a
:class:`~amr_description.control.contracts.HardwareComponent` of yours. A class is imported when it
is used. In the simulator any other name is that of a driver, and what it drives is simulated
(``in_simulator.py``).

============================ =====================================================================
``in_simulator.py``          which class stands for a plugin in the simulator
``mujoco_system.py``         the joints and sensors of a simulated robot
``simulated_sensors.py``     … its sensors: poses, forces and torques, magnetic fields
``simulated_sensor.py``      … what they have in common: where they are mounted
``simulated_range.py``       … its range finders
``sensor_noise.py``          … the noise of all these
``mock_system.py``           states follow commands at once, without physics
``simulated_base.py``        the body of a simulated robot: moved as a whole, and its truth
``serial_base_system.py``    a wheeled robot with a motor board on a serial port
``serial_link.py``           … the connection to the board: parameters, conversation, thread, port
``serial_protocol.py``       … the messages, for both ends
``simulated_motor_board.py`` … the other end, for tests without a board
============================ =====================================================================
"""

from amr_description.errors import HardwareError
from amr_description.registry import Registry

_MUJOCO_SYSTEM = 'amr_description.hardware.mujoco_system:MujocoSystem'
_MOCK_SYSTEM = 'amr_description.hardware.mock_system:MockSystem'
_SIMULATED_BASE = 'amr_description.hardware.simulated_base:SimulatedBase'
_SERIAL_BASE_SYSTEM = 'amr_description.hardware.serial_base_system:SerialBaseSystem'

HARDWARE = Registry(
    'hardware plugin',
    {
        'amr_description/MujocoSystem': _MUJOCO_SYSTEM,
        # A description written for another simulator runs here unchanged.
        'gz_ros2_control/GazeboSimSystem': _MUJOCO_SYSTEM,
        'ign_ros2_control/IgnitionSystem': _MUJOCO_SYSTEM,
        'gazebo_ros2_control/GazeboSystem': _MUJOCO_SYSTEM,
        'mujoco_ros2_control/MujocoSystemInterface': _MUJOCO_SYSTEM,
        'mujoco_ros2_control/MujocoSystem': _MUJOCO_SYSTEM,
        'webots_ros2_control::Ros2ControlSystem': _MUJOCO_SYSTEM,
        'mock_components/GenericSystem': _MOCK_SYSTEM,
        'fake_components/GenericSystem': _MOCK_SYSTEM,
        'amr_description/SerialBaseSystem': _SERIAL_BASE_SYSTEM,
        'amr_description/SimulatedBase': _SIMULATED_BASE,
    },
    HardwareError,
    base='amr_description.control.contracts:HardwareComponent',
)
"""Plugin name → class."""
