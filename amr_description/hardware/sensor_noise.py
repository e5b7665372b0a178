# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The noise of one simulated sensor: by chance, and the same each time.

Every number follows from a seed. Each sensor has a stream of its own, so that another sensor, or
another robot, does not change what this one measures.
"""

from collections.abc import Sequence
import math

from amr_description.model.gazebo_noise import Noise


class SensorNoise:
    """The noise on some quantities of a sensor; the stream is that of numpy's PCG64."""

    def __init__(self, noises: Sequence[Noise], seed: Sequence[int]) -> None:
        """``seed``: numbers from 0 on that no other sensor has."""
        self._noises = tuple(noises)
        self._seed = tuple(seed)
        self.restart()

    def restart(self) -> None:
        """Begin the stream anew, the biases too."""
        from numpy.random import Generator, PCG64  # not at import: few sensors have noise

        self._generator = Generator(PCG64(self._seed))
        self._biases = [self._first_bias(noise) for noise in self._noises]

    def _first_bias(self, noise: Noise) -> float:
        draw, sign = self._generator.standard_normal(2).tolist()
        return math.copysign(1.0, sign) * (noise.bias_mean + noise.bias_stddev * draw)

    def apply(self, values: Sequence[float], period: float) -> list[float]:
        """What is measured instead of ``values``, ``period`` s after the last time."""
        count = len(self._noises)
        draws = self._generator.standard_normal(2 * count).tolist()
        measured = []
        for index, (noise, value) in enumerate(zip(self._noises, values, strict=True)):
            if noise.wanders:
                self._wander(index, noise, period, draws[count + index])
            value += self._biases[index] + noise.mean + noise.stddev * draws[index]
            if noise.precision:
                value = round(value / noise.precision) * noise.precision
            measured.append(value)
        return measured

    def _wander(self, index: int, noise: Noise, period: float, draw: float) -> None:
        tau = noise.dynamic_bias_correlation_time
        spread = noise.dynamic_bias_stddev * math.sqrt(
            -0.5 * tau * math.expm1(-2.0 * period / tau)
        )
        self._biases[index] = math.exp(-period / tau) * self._biases[index] + spread * draw
