# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The noise of a simulated sensor: its statistics against their formulas, and its bits."""

import math
from statistics import fmean

import numpy as np
import pytest

from amr_description.hardware.sensor_noise import SensorNoise
from amr_description.model.gazebo.tags import Noise

COUNT = 20_000


def samples(noise, seed=(1,), count=COUNT, period=0.01, value=0.0):
    source = SensorNoise([noise], seed)
    return [source.apply([value], period)[0] for _ in range(count)]


@pytest.mark.parametrize('mean, stddev', [(0.0, 0.001), (2.0, 0.5), (-1.0, 3.0)])
def test_mean_and_stddev_are_those_asked_for(mean, stddev):
    measured = samples(Noise(mean, stddev), value=9.81)
    # Five standard errors of either.
    assert fmean(measured) == pytest.approx(9.81 + mean, abs=5 * stddev / math.sqrt(COUNT))
    assert np.std(measured) == pytest.approx(stddev, abs=5 * stddev / math.sqrt(2 * COUNT))


def test_white_noise_has_no_memory():
    measured = samples(Noise(stddev=1.0))
    products = [a * b for a, b in zip(measured, measured[1:], strict=False)]
    assert fmean(products) == pytest.approx(0.0, abs=5 / math.sqrt(COUNT))


def test_the_bias_is_drawn_once_with_either_sign():
    noise = Noise(bias_mean=0.3, bias_stddev=0.01)
    biases = []
    for seed in range(400):
        first, *others = samples(noise, (seed,), count=5)
        assert others == [first] * 4
        biases.append(first)
    assert np.std([abs(bias) for bias in biases]) == pytest.approx(0.01, rel=0.2)
    assert fmean([abs(bias) for bias in biases]) == pytest.approx(0.3, abs=0.003)
    assert 150 < sum(bias < 0.0 for bias in biases) < 250


@pytest.mark.parametrize('period', [0.01, 0.05])
def test_the_dynamic_bias_is_a_gauss_markov_process(period):
    tau, stddev = 0.2, 0.5
    noise = Noise(dynamic_bias_stddev=stddev, dynamic_bias_correlation_time=tau)
    measured = samples(noise, count=10 * COUNT, period=period)
    variance = np.std(measured) ** 2
    # In the long run, whatever the period: σ² τ / 2; correlated by exp(-dt/τ).
    assert variance == pytest.approx(stddev**2 * tau / 2, rel=0.1)
    products = [a * b for a, b in zip(measured, measured[1:], strict=False)]
    assert fmean(products) / variance == pytest.approx(math.exp(-period / tau), rel=0.02)


def test_quantized_noise_comes_in_steps():
    measured = samples(Noise(stddev=1.0, precision=0.25), count=100)
    assert all(value == round(value / 0.25) * 0.25 for value in measured)
    assert len(set(measured)) > 5


def test_the_same_seed_gives_the_same_bits_and_another_others():
    noise = Noise(0.0, 1.0, 0.1, 0.1, 0.1, 1.0)
    assert samples(noise, (3, 4), 100) == samples(noise, (3, 4), 100)
    assert not set(samples(noise, (3, 4), 100)) & set(samples(noise, (3, 5), 100))


def test_a_restart_repeats_them():
    source = SensorNoise([Noise(stddev=1.0, bias_stddev=1.0), Noise(stddev=2.0)], (5,))
    first = [source.apply([0.0, 0.0], 0.01) for _ in range(50)]
    source.restart((5,))
    assert [source.apply([0.0, 0.0], 0.01) for _ in range(50)] == first


def test_the_quantities_of_a_sensor_are_independent():
    source = SensorNoise([Noise(stddev=1.0)] * 2, (6,))
    pairs = [source.apply([0.0, 0.0], 0.01) for _ in range(COUNT)]
    assert fmean(a * b for a, b in pairs) == pytest.approx(0.0, abs=5 / math.sqrt(COUNT))
