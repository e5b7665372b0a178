# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the sensors of a simulated robot have in common: where they are mounted, and their states.

A ``<sensor>`` of a ``<ros2_control>`` block is mounted where the Gazebo sensor of its name is::

    <gazebo reference="base_link"><sensor name="imu" type="imu"/></gazebo>

or else on the link that its parameter ``link``, ``frame``, ``frame_id`` or ``frame_name`` names,
or on the link of its own name: ``imu``, ``imu_link`` or ``imu_frame``, also for ``imu_sensor`` and
``mujoco_sensor_name``.
One whose name begins with ``tcp_`` is else at ``tool0`` or ``flange``, which end an arm by the
names of ROS-Industrial. A joint stands for its child link.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from amr_description.control.interfaces import StateInterface
from amr_description.control.world import World
from amr_description.errors import HardwareError
from amr_description.model.frames import Transform
from amr_description.model.gazebo import GazeboSensor
from amr_description.model.hardware_info import ComponentInfo
from amr_description.model.robot import Robot

_TOOL = 'tcp_'
_TOOL_FRAMES = ('tcp', 'tool0', 'flange')
_PARAMETERS = ('link', 'frame', 'frame_id', 'frame_name')


@dataclass(frozen=True, slots=True)
class Mount:
    """
    Where a sensor is mounted.

    ``pose`` is the transform from the sensor to ``link``; ``gazebo`` is the Gazebo sensor, if
    there is one.
    """

    link: str
    pose: Transform = Transform()
    gazebo: GazeboSensor | None = None


class SimulatedSensor(ABC):
    """Some state interfaces of a ``<sensor>``, which one instrument measures."""

    interfaces: ClassVar[tuple[str, ...]]
    """All state interfaces of the instrument."""

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """``states``: those of :attr:`interfaces` that are asked for."""
        self.states = states
        self.world = world
        self.mount = mount
        self._indices = [self.interfaces.index(state.interface) for state in states]

    @abstractmethod
    def measure(self, period: float) -> Sequence[float]:
        """Return a value for each of :attr:`interfaces`; ``period``: since the last call, s."""

    def read(self, period: float) -> None:
        """Update the states; ``period``: since the previous call, s."""
        values = self.measure(period)
        for state, index in zip(self.states, self._indices, strict=True):
            state.value = values[index]

    def restart(self) -> None:
        """Begin anew, after a reset."""


def mount_of(info: ComponentInfo, robot: Robot, gazebo: GazeboSensor | None) -> Mount:
    """
    Return where a sensor is mounted, see the module.

    Args:
        info: the ``<sensor>`` of the ``<ros2_control>`` block.
        robot: the description.
        gazebo: the Gazebo sensor of that name, if there is one.

    Raises:
        HardwareError: nothing says so, or there is no such link.
    """
    named = [info.parameters[name] for name in _PARAMETERS if info.parameters.get(name)]
    if gazebo is not None:
        named.insert(0, gazebo.link)
    for name in named[:1] or _guesses(info):
        link = _link_of(name, robot)
        if link:
            return Mount(link, Transform() if gazebo is None else gazebo.pose, gazebo)
    links = ', '.join(link.name for link in robot.links)
    if named:
        raise HardwareError(
            f"sensor '{info.name}': there is no link '{named[0]}' to mount it on; there are: "
            f'{links}'
        )
    raise HardwareError(
        f"sensor '{info.name}': nothing says on which link it is mounted; write "
        f'<param name="frame_id">LINK</param> in the sensor, with one of: {links}'
    )


def _guesses(info: ComponentInfo) -> Iterator[str]:
    """Yield the links or joints that a sensor may be mounted on, by its names."""
    name, in_mujoco = info.name, info.parameters.get('mujoco_sensor_name', info.name)
    for stem in (name, name.removesuffix('_sensor'), in_mujoco, in_mujoco.removesuffix('_sensor')):
        for suffix in ('', '_link', '_frame', '_joint'):
            yield stem + suffix
    if name.startswith(_TOOL):
        yield from _TOOL_FRAMES


def _link_of(name: str, robot: Robot) -> str:
    """Return the link of this name, or below the joint of this name; '' if there is neither."""
    if robot.has_link(name):
        return name
    return robot.joint(name).child if robot.has_joint(name) else ''
