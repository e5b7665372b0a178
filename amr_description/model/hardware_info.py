# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A ``<ros2_control>`` block: one hardware component and its interfaces.

Field names are those of ros2_control's ``hardware_interface::HardwareInfo``. Interface values are
in SI: rad, rad/s, N·m for revolute joints, m, m/s, N for prismatic ones. Made by
:mod:`amr_description.model.ros2_control_tag`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

IMU_INTERFACES = (
    *(f'orientation.{axis}' for axis in 'xyzw'),
    *(f'angular_velocity.{axis}' for axis in 'xyz'),
    *(f'linear_acceleration.{axis}' for axis in 'xyz'),
)
"""The state interfaces of an inertial measurement unit: a unit quaternion, rad/s, m/s²."""
WRENCH_INTERFACES = (*(f'force.{axis}' for axis in 'xyz'), *(f'torque.{axis}' for axis in 'xyz'))
"""The state interfaces of a force-torque sensor: N, N·m."""
MAGNETIC_INTERFACES = tuple(f'magnetic_field.{axis}' for axis in 'xyz')
"""The state interfaces of a magnetometer: T."""


class HardwareType(StrEnum):
    """The kinds of hardware component; each equals its text."""

    SYSTEM = 'system'
    ACTUATOR = 'actuator'
    SENSOR = 'sensor'


class ComponentType(StrEnum):
    """The kinds of parts that have interfaces; each equals its text."""

    JOINT = 'joint'
    SENSOR = 'sensor'
    GPIO = 'gpio'


@dataclass(frozen=True, slots=True)
class InterfaceInfo:
    """
    One command or state interface, such as ``velocity``.

    ``min`` and ``max`` bound commands while ``limits_enabled``; None means that the tag sets no
    bound. ``initial_value`` is the value before the first write; None leaves it to the hardware.
    ``parameters`` are the remaining ``<param>`` texts.
    """

    name: str
    data_type: str = 'double'
    size: int = 1
    min: float | None = None
    max: float | None = None
    initial_value: float | None = None
    limits_enabled: bool = True
    parameters: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Mimic:
    """position = ``multiplier`` · position of ``joint`` + ``offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class ComponentInfo:
    """
    A joint, sensor or GPIO with its interfaces, in the order of the file.

    ``mimic`` is that of the URDF joint; None if it has none, or if the tag says
    ``mimic="false"``.
    """

    name: str
    type: ComponentType
    command_interfaces: tuple[InterfaceInfo, ...] = ()
    state_interfaces: tuple[InterfaceInfo, ...] = ()
    parameters: Mapping[str, str] = field(default_factory=dict)
    mimic: Mimic | None = None
    line: int = 0


@dataclass(frozen=True, slots=True)
class TransmissionEnd:
    """A joint or actuator on one end of a transmission."""

    name: str
    role: str = ''
    mechanical_reduction: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class TransmissionInfo:
    """A ``<transmission>`` between actuators and joints."""

    name: str
    plugin: str
    joints: tuple[TransmissionEnd, ...]
    actuators: tuple[TransmissionEnd, ...]


@dataclass(frozen=True, slots=True)
class HardwareInfo:
    """
    One hardware component.

    ``rw_rate`` is the rate of reads and writes, Hz; 0: the rate of the controller manager.
    Components of one ``group`` fail together.
    """

    name: str
    type: HardwareType
    plugin: str
    group: str = ''
    parameters: Mapping[str, str] = field(default_factory=dict)
    rw_rate: int = 0
    is_async: bool = False
    joints: tuple[ComponentInfo, ...] = ()
    sensors: tuple[ComponentInfo, ...] = ()
    gpios: tuple[ComponentInfo, ...] = ()
    transmissions: tuple[TransmissionInfo, ...] = ()
    line: int = 0

    @property
    def components(self) -> tuple[ComponentInfo, ...]:
        """All joints, sensors and GPIOs, in this order."""
        return self.joints + self.sensors + self.gpios
