# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The noise of a simulated sensor: :class:`~amr_description.model.gazebo.tags.Noise`, reproducible.

Each sensor has its own random stream; another sensor or robot does not change its measurements.
"""

from collections.abc import Sequence
import math

from amr_description.model.gazebo.tags import Noise


class SensorNoise:
    """The noise of some quantities of a sensor, from numpy's PCG64."""

    def __init__(self, noises: Sequence[Noise], seed: Sequence[int]) -> None:
        """``seed``: numbers ≥ 0, different for every sensor."""
        self._noises = tuple(noises)
        self.restart(seed)

    def restart(self, seed: Sequence[int]) -> None:
        """Restart the random stream, and the biases, from a seed."""
        from numpy.random import Generator, PCG64  # slow to import, and few sensors have noise

        self._generator = Generator(PCG64(tuple(seed)))
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
            if noise.precision and math.isfinite(value):
                value = round(value / noise.precision) * noise.precision
            measured.append(value)
        return measured

    def _drift_bias(self, index: int, noise: Noise, period: float, draw: float) -> None:
        tau = noise.dynamic_bias_correlation_time
        spread = noise.dynamic_bias_stddev * math.sqrt(
            -0.5 * tau * math.expm1(-2.0 * period / tau)
        )
        self._biases[index] = math.exp(-period / tau) * self._biases[index] + spread * draw
