# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The terms of ros2_control: interface names, state and command interfaces, lifecycle states.

A **state interface** holds a measured value, a **command interface** a commanded one. Both are
named ``<joint>/<interface>``, for instance ``joint_wheel_front_left/velocity``. The hardware
component owns them and lends them to controllers, for as long as these are active.

Units are SI: position rad or m, velocity rad/s or m/s, acceleration rad/s² or m/s², jerk rad/s³ or
m/s³, effort N·m or N.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
import enum
import math
from typing import Self, TYPE_CHECKING

from amr_description.clock import NANOSECONDS as NANOSECONDS
from amr_description.errors import ControllerError, InterfaceError
from amr_description.model.hardware_info import (
    IMU_INTERFACES as IMU_INTERFACES,
    MAGNETIC_INTERFACES as MAGNETIC_INTERFACES,
    WRENCH_INTERFACES as WRENCH_INTERFACES,
)

if TYPE_CHECKING:
    from amr_description.model.hardware_info import ComponentInfo, InterfaceInfo

POSITION = 'position'
VELOCITY = 'velocity'
ACCELERATION = 'acceleration'
EFFORT = 'effort'
JERK = 'jerk'
QUANTITIES = {
    **{name: name for name in (POSITION, VELOCITY, EFFORT, ACCELERATION)},
    **dict.fromkeys(('torque', 'force'), EFFORT),
    'position_pid': POSITION,
    'velocity_pid': VELOCITY,
}
"""
Interface of a joint, by any of the names that simulators know it by → the quantity that it is.

``torque`` and ``force`` are those of mujoco_ros2_control, ``…_pid`` those of gazebo_ros2_control.
"""
POSE_INTERFACES = (
    *(f'position.{axis}' for axis in 'xyz'),
    *(f'orientation.{axis}' for axis in 'xyzw'),
)
"""The state interfaces of a pose: m, a unit quaternion."""


class LifecycleState(enum.IntEnum):
    """
    The primary states of ``lifecycle_msgs/msg/State``, of controllers and of hardware components.
    """

    UNKNOWN = 0
    UNCONFIGURED = 1
    INACTIVE = 2
    ACTIVE = 3
    FINALIZED = 4

    @property
    def label(self) -> str:
        """The name as ROS prints it, for instance ``inactive``."""
        return self.name.lower()


DATA_TYPES: Mapping[str, float | int | bool] = {
    'double': math.nan,
    'float32': math.nan,
    'bool': False,
    **{f'int{bits}': 2 ** (bits - 1) - 1 for bits in (8, 16, 32)},
    **{f'uint{bits}': 2**bits - 1 for bits in (8, 16, 32)},
}
"""Data type of an interface, as ``<ros2_control>`` names it → its value before any write."""
_ALWAYS_SET = ('double', 'float32', 'bool')


class Handle:
    """
    One value that a hardware component and controllers share.

    ``value`` is that of :data:`DATA_TYPES` (NaN for a floating-point type) until it is first
    written. It is read and written on the control thread only.
    """

    __slots__ = ('prefix', 'interface', 'data_type', 'value')

    def __init__(
        self,
        prefix: str,
        interface: str,
        value: float | None = None,
        data_type: str = 'double',
    ) -> None:
        """
        Create an interface.

        Args:
            prefix: of its name: the joint, sensor, GPIO or controller.
            interface: the rest of its name, for instance ``velocity``.
            value: initial value; None: that of the data type.
            data_type: one of :data:`DATA_TYPES`.

        Raises:
            InterfaceError: there is no such data type.
        """
        if data_type not in DATA_TYPES:
            raise InterfaceError(
                f"interface '{prefix}/{interface}' has the data type '{data_type}'; there are: "
                f'{", ".join(DATA_TYPES)}'
            )
        self.prefix = prefix
        self.interface = interface
        self.data_type = data_type
        first = DATA_TYPES[data_type]
        self.value = first if value is None else type(first)(value)

    @classmethod
    def of(cls, component: 'ComponentInfo', interface: 'InterfaceInfo') -> Self:
        """Create the interface that a joint, sensor or GPIO declares, with its initial value."""
        return cls(component.name, interface.name, interface.initial_value, interface.data_type)

    @property
    def name(self) -> str:
        """``<prefix>/<interface>``."""
        return f'{self.prefix}/{self.interface}'

    @property
    def is_set(self) -> bool:
        """False while it has the value of before any write: there is no command, or no state."""
        if self.value != self.value:  # NaN
            return False
        return self.data_type in _ALWAYS_SET or self.value != DATA_TYPES[self.data_type]

    def __repr__(self) -> str:
        return f'{type(self).__name__}({self.name!r}, value={self.value})'


class StateInterface(Handle):
    """Written by the hardware component in ``read``, read by controllers."""

    __slots__ = ()


class CommandInterface(Handle):
    """Written by the controller that has claimed it, read by the hardware in ``write``."""

    __slots__ = ()


class Claim(enum.Enum):
    """How a controller asks for interfaces (``interface_configuration_type`` of ros2_control)."""

    NONE = 'none'
    ALL = 'all'
    INDIVIDUAL = 'individual'


@dataclass(frozen=True, slots=True)
class InterfaceRequest:
    """The interfaces that a controller wants; ``names`` counts only for ``Claim.INDIVIDUAL``."""

    claim: Claim = Claim.NONE
    names: tuple[str, ...] = ()

    @classmethod
    def individual(cls, names: Iterable[str]) -> 'InterfaceRequest':
        """Request exactly these interfaces, to be handed over in this order."""
        return cls(Claim.INDIVIDUAL, tuple(names))

    def require_all(self, handles: Sequence['Handle'], kind: str) -> None:
        """
        Check that as many interfaces were handed over as were requested individually.

        Args:
            handles: those that a controller gets when it is activated.
            kind: ``command`` or ``state``, for the message.

        Raises:
            ControllerError: they are more, or fewer.
        """
        if len(handles) != len(self.names):
            raise ControllerError(
                f'Expected {len(self.names)} {kind} interfaces, got {len(handles)}'
            )


NO_INTERFACES = InterfaceRequest()
ALL_INTERFACES = InterfaceRequest(Claim.ALL)
