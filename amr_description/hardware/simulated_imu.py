# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An inertial measurement unit of a simulated robot: a ``<sensor>`` of the ``<ros2_control>`` block.

The link that it is mounted on is that of the Gazebo sensor of the same name::

    <gazebo reference="base_link"><sensor name="imu" type="imu"/></gazebo>

without one ``<param name="link">`` or ``<param name="frame_id">`` in the ``<ros2_control>``
sensor, and else the link of its own name. Its orientation is that in the world, not that against
the start.
"""

from collections.abc import Iterable

from amr_description.control.interfaces import IMU_INTERFACES, StateInterface
from amr_description.control.world import ImuReading, World
from amr_description.errors import HardwareError
from amr_description.model.frames import Transform
from amr_description.model.gazebo_sensors import gazebo_sensors_of, GazeboSensor
from amr_description.model.hardware_info import ComponentInfo

_LINK_PARAMETERS = ('link', 'frame', 'frame_id')


class SimulatedImu:
    """The state interfaces of one unit: unit quaternion, rad/s and m/s², gravity included."""

    def __init__(self, info: ComponentInfo, world: World) -> None:
        """Raises HardwareError for another interface, or if nothing says where it is mounted."""
        self._world = world
        for interface in info.state_interfaces:
            if interface.name not in IMU_INTERFACES:
                raise HardwareError(
                    f"sensor '{info.name}': state interface '{interface.name}' is asked; an IMU "
                    f'has: {", ".join(IMU_INTERFACES)}'
                )
        self._link, self._place = _mounting(info, world)
        self.states = [StateInterface(info.name, each.name) for each in info.state_interfaces]
        self._indices = [IMU_INTERFACES.index(state.interface) for state in self.states]

    def read(self) -> None:
        """Bring the states up to date."""
        values = _values(self._world.imu(self._link, self._place))
        for state, index in zip(self.states, self._indices, strict=True):
            state.value = values[index]


def is_imu(info: ComponentInfo, world: World) -> bool:
    """Whether a sensor of the block is an IMU: Gazebo has it as one, or its interfaces say so."""
    return _gazebo_sensor(info.name, world) is not None or any(
        interface.name in IMU_INTERFACES for interface in info.state_interfaces
    )


def _values(reading: ImuReading) -> tuple[float, ...]:
    """In the order of IMU_INTERFACES."""
    return (*reading.orientation, *reading.angular_velocity, *reading.linear_acceleration)


def _gazebo_sensor(name: str, world: World) -> GazeboSensor | None:
    sensors = gazebo_sensors_of(world.description)
    return next((s for s in sensors if s.name == name and s.type == 'imu'), None)


def _mounting(info: ComponentInfo, world: World) -> tuple[str, Transform]:
    """The link, and the transform from the sensor to it. Raises HardwareError."""
    robot = world.description
    mounted = _gazebo_sensor(info.name, world)
    if mounted is not None:
        return _known(mounted.link, info, world), mounted.place
    for parameter in _LINK_PARAMETERS:
        if parameter in info.parameters:
            return _known(info.parameters[parameter], info, world), Transform()
    if robot.has_link(info.name):
        return info.name, Transform()
    raise HardwareError(
        f"sensor '{info.name}': nothing says on which link it is mounted; write "
        f'<gazebo reference="LINK"><sensor name="{info.name}" type="imu"/></gazebo>, or '
        f'<param name="link">LINK</param> in the sensor, with one of: {_listed(world)}'
    )


def _known(link: str, info: ComponentInfo, world: World) -> str:
    if world.description.has_link(link):
        return link
    raise HardwareError(
        f"sensor '{info.name}': there is no link '{link}' to mount it on; there are: "
        f'{_listed(world)}'
    )


def _listed(world: World) -> str:
    names: Iterable[str] = (link.name for link in world.description.links)
    return ', '.join(names)
