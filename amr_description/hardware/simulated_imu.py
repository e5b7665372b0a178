# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An inertial measurement unit of a simulated robot: a ``<sensor>`` of the ``<ros2_control>`` block.

Its orientation is relative to the world, not to the start. It measures without noise, unless the
Gazebo sensor declares some (see :mod:`amr_description.model.gazebo`)::

    <imu><angular_velocity><z><noise type="gaussian"><stddev>0.001</stddev> …

The noise is reproducible: each sensor has its own random stream, and another sensor or robot does
not change its measurements.
"""

from collections.abc import Sequence
import math

from amr_description.control.interfaces import IMU_INTERFACES, StateInterface
from amr_description.control.world import World
from amr_description.hardware.simulated_sensor import Mount, SimulatedSensor
from amr_description.model.gazebo import Noise


class SimulatedImu(SimulatedSensor):
    """The state interfaces of a unit: unit quaternion, rad/s and m/s², gravity included."""

    interfaces = IMU_INTERFACES

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """Take a unit, whose noise is that of its Gazebo sensor."""
        super().__init__(states, world, mount)
        noises = () if mount.gazebo is None else mount.gazebo.noise
        self._noisy = [IMU_INTERFACES.index(interface) for interface, _ in noises]
        self._noise: SensorNoise | None = None
        if noises:
            # No name contains a 0: no other robot and sensor have the same seed.
            seed = (*world.seed, 0, *states[0].prefix.encode())
            self._noise = SensorNoise([noise for _, noise in noises], seed)

    def restart(self) -> None:
        """Restart the noise."""
        if self._noise is not None:
            self._noise.restart()

    def measure(self, period: float) -> Sequence[float]:
        """Return what the unit measures; ``period``: since the previous call, s."""
        reading = self.world.imu(self.mount.link, self.mount.pose)
        # In the order of IMU_INTERFACES.
        values = [*reading.orientation, *reading.angular_velocity, *reading.linear_acceleration]
        if self._noise is not None:
            measured = self._noise.apply([values[index] for index in self._noisy], period)
            for index, value in zip(self._noisy, measured, strict=True):
                values[index] = value
        return values


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
