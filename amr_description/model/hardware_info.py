# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a ``<ros2_control>`` block says: one hardware component and the interfaces it offers.

Field names are those of ros2_control's ``hardware_interface::HardwareInfo``. Interface values are
SI: rad, rad/s, N·m for turning joints, m, m/s, N for sliding ones. Made by
:mod:`amr_description.model.ros2_control_tag`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from amr_description.model.robot import Mimic


class HardwareType(StrEnum):
    """The kinds of hardware component; each equals its text."""

    SYSTEM = 'system'
    ACTUATOR = 'actuator'
    SENSOR = 'sensor'


class ComponentType(StrEnum):
    """What the interfaces of a hardware component belong to; each equals its text."""

    JOINT = 'joint'
    SENSOR = 'sensor'
    GPIO = 'gpio'


@dataclass(frozen=True, slots=True)
class InterfaceInfo:
    """
    One command or state interface, such as ``velocity``.

    ``min`` and ``max`` bound commands while ``limits_enabled``; None means that the tag sets no
    bound. ``initial_value`` is what the interface holds before its first write; None leaves it to
    the hardware. ``parameters`` are the remaining ``<param>`` texts.
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
class ComponentInfo:
    """
    A joint, sensor or GPIO with its interfaces, in the order of the file.

    ``mimic`` is that of the URDF joint, None when it has none or ``mimic="false"`` switches it
    off.
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

    ``rw_rate`` is how often it is read and written, Hz; 0 means at the rate of the controller
    manager. ``group`` is empty when the component fails alone.
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
