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

It measures without noise, unless the Gazebo sensor declares some
(:mod:`amr_description.model.gazebo.tags`)::

    <imu><angular_velocity><z><noise type="gaussian"><stddev>0.001</stddev> …
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

from amr_description.control.interfaces import StateInterface
from amr_description.control.world import World
from amr_description.errors import HardwareError
from amr_description.hardware.sensor_noise import SensorNoise
from amr_description.model.frames import Transform
from amr_description.model.gazebo.tags import GazeboSensor, Noise
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
    parameters: Mapping[str, str] = field(default_factory=dict)
    """Of the ``<sensor>`` of the ``<ros2_control>`` block."""


class SimulatedSensor(ABC):
    """Some state interfaces of a ``<sensor>``, which one instrument measures."""

    interfaces: ClassVar[tuple[str, ...]]
    """All state interfaces of the instrument."""
    stream: ClassVar[bytes] = b''
    """Tells its random numbers from those of another instrument of the same sensor."""

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """``states``: those of :attr:`interfaces` that are asked for."""
        self.states = states
        self.world = world
        self.mount = mount
        self._indices = [self.interfaces.index(state.interface) for state in states]
        self._noisy: list[int] = []
        self._noise: SensorNoise | None = None
        if mount.gazebo is not None:
            self._add_noise(mount.gazebo.noise)

    def _add_noise(self, noises: Iterable[tuple[str, Noise]]) -> None:
        """Give interfaces noise, as far as they are those of the instrument."""
        known = [(self.interfaces.index(i), each) for i, each in noises if i in self.interfaces]
        self._noisy = [index for index, _ in known]
        if known:
            self._noise = SensorNoise([noise for _, noise in known], self._seed())

    def _seed(self) -> Sequence[int]:
        # No name contains a 0: no other robot and sensor have the same seed.
        return (*self.world.seed, 0, *self.states[0].prefix.encode(), *self.stream)

    @abstractmethod
    def measure(self, period: float) -> Sequence[float]:
        """
        Return a value for each of :attr:`interfaces`, without noise.

        Args:
            period: since the last call, s.
        """

    def read(self, period: float) -> None:
        """Update the states; ``period``: since the previous call, s."""
        values = self.measure(period)
        if self._noise is not None:
            values = self.with_noise(values, self._noise, period)
        for state, index in zip(self.states, self._indices, strict=True):
            state.value = values[index]

    def with_noise(
        self, values: Sequence[float], noise: SensorNoise, period: float
    ) -> Sequence[float]:
        """Return values with noise; ``period``: since the last call, s."""
        measured = noise.apply([values[index] for index in self._noisy], period)
        noisy = list(values)
        for index, value in zip(self._noisy, measured, strict=True):
            noisy[index] = value
        return noisy

    def restart(self) -> None:
        """Begin anew, after a reset: the same noise again, unless the seed is another."""
        if self._noise is not None:
            self._noise.restart(self._seed())


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
            pose = Transform() if gazebo is None else gazebo.pose
            return Mount(link, pose, gazebo, info.parameters)
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
