# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The noise that ``<noise type="gaussian">`` of a Gazebo sensor asks for."""

from collections.abc import Iterator
from dataclasses import dataclass
import math

from lxml import etree

from amr_description.model.element_reader import ElementReader, parse_number
from amr_description.model.findings import quote

GAUSSIAN_TYPES = ('gaussian', 'gaussian_quantized')
TYPES = ('none', *GAUSSIAN_TYPES)

IMU_QUANTITIES = ('angular_velocity', 'linear_acceleration')
"""What an ``<imu>`` may have noise on, each along x, y and z."""


@dataclass(frozen=True, slots=True)
class Noise:
    """
    As in SDF; all in the unit of what is measured, times in s.

    What is measured comes out as ``value + bias + normal(mean, stddev)``. The bias is drawn once,
    of ``normal(bias_mean, bias_stddev)``, with either sign alike. With a dynamic bias it then
    wanders as a Gauss–Markov process: ``bias' = exp(-dt / tau) bias + normal(0, s)`` with
    ``s² = dynamic_bias_stddev² tau / 2 (1 - exp(-2 dt / tau))``.
    """

    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    dynamic_bias_stddev: float = 0.0
    dynamic_bias_correlation_time: float = 0.0
    precision: float = 0.0
    """What comes out is a multiple of it; 0: it is not rounded."""

    @property
    def wanders(self) -> bool:
        """Whether it has a dynamic bias."""
        return self.dynamic_bias_stddev > 0.0 and self.dynamic_bias_correlation_time > 0.0


_NEVER_NEGATIVE = (
    'stddev',
    'bias_stddev',
    'dynamic_bias_stddev',
    'dynamic_bias_correlation_time',
    'precision',
)


def read_imu_noise(sensor: etree._Element, reader: ElementReader) -> Iterator[tuple[str, Noise]]:
    """Yield the noise of each state interface that has some, such as ``angular_velocity.x``."""
    for quantity in IMU_QUANTITIES:
        for axis in 'xyz':
            element = sensor.find(f'imu/{quantity}/{axis}/noise')
            if element is not None:
                noise = _read_noise(element, reader.of(f'{reader.label}: {quantity}.{axis}'))
                if noise is not None:
                    yield f'{quantity}.{axis}', noise


def _read_noise(element: etree._Element, reader: ElementReader) -> Noise | None:
    kind = element.get('type', 'none')
    if kind not in TYPES:
        reader.error(
            element, 'type of <noise>', found=quote(kind), expected=f'one of {", ".join(TYPES)}'
        )
    if kind not in GAUSSIAN_TYPES:
        return None
    values = {}
    for name in Noise.__dataclass_fields__:
        text = element.findtext(name)
        if text is None or (name == 'precision' and kind == 'gaussian'):
            continue
        values[name] = value = parse_number(text.strip())
        least = 0.0 if name in _NEVER_NEGATIVE else -math.inf
        if not (math.isfinite(value) and value >= least):
            expected = 'a finite number' if least else 'a finite number from 0 on'
            reader.error(element, f'<{name}>', found=quote(text.strip()), expected=expected)
    return Noise(**values)
