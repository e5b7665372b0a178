# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An inertial measurement unit of a simulated robot: a ``<sensor>`` of the ``<ros2_control>`` block.

The link that it is mounted on is that of the Gazebo sensor of the same name::

    <gazebo reference="base_link"><sensor name="imu" type="imu"/></gazebo>

or else that of ``<param name="link">``, ``frame`` or ``frame_id`` in the ``<ros2_control>``
sensor, or else the link with the name of the sensor. Its orientation is relative to the world, not
to the start.

It measures without noise, unless the Gazebo sensor declares some (see
:mod:`amr_description.model.gazebo`)::

    <imu><angular_velocity><z><noise type="gaussian"><stddev>0.001</stddev> …

The noise is reproducible: each sensor has its own random stream, and another sensor or robot does
not change its measurements.
"""

from collections.abc import Sequence
import math

from amr_description.control.interfaces import IMU_INTERFACES, StateInterface
from amr_description.control.world import World
from amr_description.errors import HardwareError
from amr_description.model.frames import Transform
from amr_description.model.gazebo import gazebo_sensors_of, GazeboSensor, Noise
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo

_LINK_PARAMETERS = ('link', 'frame', 'frame_id')


class SimulatedImu:
    """The state interfaces of a unit: unit quaternion, rad/s and m/s², gravity included."""

    def __init__(self, info: ComponentInfo, world: World, mounted: GazeboSensor | None) -> None:
        """
        Take a unit.

        Args:
            info: the ``<sensor>`` of the ``<ros2_control>`` block.
            world: the simulated world.
            mounted: the Gazebo sensor, if there is one.

        Raises:
            HardwareError: it has an interface that is not one of a unit, or no link.
        """
        self.info = info
        self._world = world
        for interface in info.state_interfaces:
            if interface.name not in IMU_INTERFACES:
                raise HardwareError(
                    f"sensor '{info.name}': state interface '{interface.name}' is asked; an IMU "
                    f'has: {", ".join(IMU_INTERFACES)}'
                )
        self._link = _link_of(info, world, mounted)
        self._mount_pose = Transform() if mounted is None else mounted.pose
        self.states = [StateInterface(info.name, each.name) for each in info.state_interfaces]
        self._indices = [IMU_INTERFACES.index(state.interface) for state in self.states]
        noises = () if mounted is None else mounted.noise
        self._noisy = [IMU_INTERFACES.index(interface) for interface, _ in noises]
        self._noise: SensorNoise | None = None
        if noises:
            # No name contains a 0: no other robot and sensor have the same seed.
            seed = (*world.seed, 0, *info.name.encode())
            self._noise = SensorNoise([noise for _, noise in noises], seed)

    def restart(self) -> None:
        """Restart the noise."""
        if self._noise is not None:
            self._noise.restart()

    def read(self, period: float) -> None:
        """Update the states; ``period``: since the previous call, s."""
        reading = self._world.imu(self._link, self._mount_pose)
        # In the order of IMU_INTERFACES.
        values = [*reading.orientation, *reading.angular_velocity, *reading.linear_acceleration]
        if self._noise is not None:
            measured = self._noise.apply([values[index] for index in self._noisy], period)
            for index, value in zip(self._noisy, measured, strict=True):
                values[index] = value
        for state, index in zip(self.states, self._indices, strict=True):
            state.value = values[index]


def imus_of(info: HardwareInfo, world: World) -> list[SimulatedImu]:
    """
    Return the units among the sensors of a component.

    Those are the sensors of type ``imu`` in Gazebo, or with at least one interface of a unit.

    Args:
        info: of the component.
        world: the simulated world.

    Raises:
        HardwareError: of :class:`SimulatedImu`.
        DescriptionError: a ``<gazebo>`` block is invalid.
    """
    if not info.sensors:
        return []
    sensors = gazebo_sensors_of(world.description)
    mounted = {sensor.name: sensor for sensor in sensors if sensor.type == 'imu'}
    return [
        SimulatedImu(sensor, world, mounted.get(sensor.name))
        for sensor in info.sensors
        if sensor.name in mounted
        or any(interface.name in IMU_INTERFACES for interface in sensor.state_interfaces)
    ]


class SensorNoise:
    """The noise of some quantities of a sensor, from numpy's PCG64."""

    def __init__(self, noises: Sequence[Noise], seed: Sequence[int]) -> None:
        """``seed``: numbers ≥ 0, different for every sensor."""
        self._noises = tuple(noises)
        self._seed = tuple(seed)
        self.restart()

    def restart(self) -> None:
        """Restart the random stream, and the biases."""
        from numpy.random import Generator, PCG64  # slow to import, and few sensors have noise

        self._generator = Generator(PCG64(self._seed))
        self._biases = [self._first_bias(noise) for noise in self._noises]

    def _first_bias(self, noise: Noise) -> float:
        draw, sign = self._generator.standard_normal(2).tolist()
        return math.copysign(1.0, sign) * (noise.bias_mean + noise.bias_stddev * draw)

    def apply(self, values: Sequence[float], period: float) -> list[float]:
        """
        Return values with noise.

        Args:
            values: one for each quantity.
            period: since the previous call, s.
        """
        count = len(self._noises)
        draws = self._generator.standard_normal(2 * count).tolist()
        measured = []
        for index, (noise, value) in enumerate(zip(self._noises, values, strict=True)):
            if noise.has_dynamic_bias:
                self._drift_bias(index, noise, period, draws[count + index])
            value += self._biases[index] + noise.mean + noise.stddev * draws[index]
            if noise.precision:
                value = round(value / noise.precision) * noise.precision
            measured.append(value)
        return measured

    def _drift_bias(self, index: int, noise: Noise, period: float, draw: float) -> None:
        tau = noise.dynamic_bias_correlation_time
        spread = noise.dynamic_bias_stddev * math.sqrt(
            -0.5 * tau * math.expm1(-2.0 * period / tau)
        )
        self._biases[index] = math.exp(-period / tau) * self._biases[index] + spread * draw


def _link_of(info: ComponentInfo, world: World, mounted: GazeboSensor | None) -> str:
    """Return the link that a unit is mounted on. Raises HardwareError."""
    robot = world.description
    links = ', '.join(link.name for link in robot.links)
    named = [info.parameters[name] for name in _LINK_PARAMETERS if name in info.parameters]
    if mounted is not None:
        named.insert(0, mounted.link)
    link = named[0] if named else info.name
    if robot.has_link(link):
        return link
    if named:
        raise HardwareError(
            f"sensor '{info.name}': there is no link '{link}' to mount it on; there are: {links}"
        )
    raise HardwareError(
        f"sensor '{info.name}': nothing says on which link it is mounted; write "
        f'<gazebo reference="LINK"><sensor name="{info.name}" type="imu"/></gazebo>, or '
        f'<param name="link">LINK</param> in the sensor, with one of: {links}'
    )
