# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A range finder of a simulated robot: a ``<sensor>`` with the state interface ``range``.

It looks along x of its mount, in a cone, and measures the nearest of some rays in it. Its limits
are parameters of the sensor, with the names and units that range_sensor_broadcaster has for them::

    <sensor name="front">
      <state_interface name="range"/>
      <param name="frame_id">front_link</param>
      <param name="field_of_view">0.26</param>          (rad, of the whole cone; 0: one ray)
      <param name="min_range">0.02</param>              (m; 0)
      <param name="max_range">4.0</param>               (m; inf)
      <param name="update_rate">20</param>              (Hz; 0: measured in every cycle)
    </sensor>

or those of the Gazebo sensor of its name (``ray``, ``lidar``, ``gpu_lidar``, ``sonar``), with its
noise. As in REP 117 the range is -inf if something is nearer than the smallest one, and inf if
nothing is met up to the largest one. The parts of the robot on which it is fixed are not seen.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math

from amr_description.clock import instants_until
from amr_description.control.interfaces import StateInterface
from amr_description.control.world import World
from amr_description.errors import HardwareError
from amr_description.hardware.sensor_noise import SensorNoise
from amr_description.hardware.simulated_sensor import Mount, SimulatedSensor
from amr_description.model.frames import Vector
from amr_description.model.gazebo.sensors import range_finder_of
from amr_description.model.sensors import Lidar

_RINGS = ((0.5, 6), (1.0, 12))
"""Of the rays about the middle one: the share of half the field of view, and how many."""


@dataclass(frozen=True, slots=True)
class RangeLimits:
    """What a range finder can measure, rad and m, and how often, Hz."""

    field_of_view: float = 0.0
    min_range: float = 0.0
    max_range: float = math.inf
    update_rate: float = 0.0

    @classmethod
    def of(cls, name: str, parameters: Mapping[str, str], lidar: Lidar | None) -> 'RangeLimits':
        """
        Return those that parameters say, else those of a Gazebo sensor.

        Args:
            name: of the sensor, for messages.
            parameters: of its tag.
            lidar: the Gazebo sensor, if there is one.

        Raises:
            HardwareError: they are no numbers, or no range is left between them.
        """
        known = cls()
        if lidar is not None:
            axes = (lidar.horizontal, lidar.vertical)
            view = max(abs(axis.upper - axis.lower) for axis in axes)
            known = cls(min(view, math.pi), lidar.range_min, lidar.range_max, lidar.mount.rate)
        values = {each: _number(name, each, parameters, getattr(known, each)) for each in _NAMES}
        found = cls(**values)
        if not (0.0 <= found.field_of_view <= math.pi and found.min_range >= 0.0):
            raise HardwareError(
                f"sensor '{name}': field_of_view is {found.field_of_view:g} rad and min_range "
                f'{found.min_range:g} m; 0 to 3.14159 rad and 0 m or more are needed'
            )
        if not found.min_range < found.max_range:
            raise HardwareError(
                f"sensor '{name}': min_range is {found.min_range:g} m and max_range "
                f'{found.max_range:g} m; the first must be less'
            )
        if found.update_rate < 0.0:
            raise HardwareError(
                f"sensor '{name}': update_rate is {found.update_rate:g} Hz; 0 or more is needed"
            )
        return found


_NAMES = ('field_of_view', 'min_range', 'max_range', 'update_rate')


def _number(sensor: str, name: str, parameters: Mapping[str, str], default: float) -> float:
    text = parameters.get(name, '').strip()
    try:
        value = float(text) if text else default
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise HardwareError(f"sensor '{sensor}': {name} is '{text}'; a number is needed")
    return value


def cone(field_of_view: float) -> tuple[Vector, ...]:
    """Return unit vectors in a cone about x, the first along it; ``field_of_view``: rad."""
    if field_of_view == 0.0:
        return ((1.0, 0.0, 0.0),)
    directions = [(1.0, 0.0, 0.0)]
    for share, count in _RINGS:
        off = share * field_of_view / 2.0
        for index in range(count):
            around = math.tau * index / count
            directions.append(
                (
                    math.cos(off),
                    math.sin(off) * math.cos(around),
                    math.sin(off) * math.sin(around),
                )
            )
    return tuple(directions)


class SimulatedRange(SimulatedSensor):
    """The distance to the nearest thing in a cone, m."""

    interfaces = ('range',)
    stream = b'\0range'

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """Take a range finder. Raises HardwareError: see :meth:`RangeLimits.of`."""
        super().__init__(states, world, mount)
        name = states[0].prefix
        lidar = range_finder_of(world.description, name)
        self._limits = RangeLimits.of(name, mount.parameters, lidar)
        self._instant, self._elapsed = -1, 0.0
        self._directions = cone(self._limits.field_of_view)
        if lidar is not None and lidar.noise.is_some:
            self._add_noise([('range', lidar.noise)])

    def read(self, period: float) -> None:
        """Measure, if that is due; the state keeps its value else."""
        self._elapsed += period
        rate = self._limits.update_rate
        if rate > 0.0:
            instant = instants_until(self.world.time, rate)
            if instant == self._instant:
                return
            self._instant = instant
        elapsed, self._elapsed = self._elapsed, 0.0
        super().read(elapsed)

    def restart(self) -> None:
        """Begin anew, after a reset."""
        super().restart()
        self._instant, self._elapsed = -1, 0.0

    def measure(self, period: float) -> Sequence[float]:
        """Return the range."""
        limits = self._limits
        nearest = min(
            self.world.distances(
                self.mount.link, self.mount.pose, self._directions, limits.max_range
            )
        )
        if nearest < limits.min_range:
            return (-math.inf,)
        return (nearest if nearest <= limits.max_range else math.inf,)

    def with_noise(
        self, values: Sequence[float], noise: SensorNoise, period: float
    ) -> Sequence[float]:
        """Return the range with noise, still within the limits."""
        (value,) = super().with_noise(values, noise, period)
        limits = self._limits
        return (
            min(max(value, limits.min_range), limits.max_range) if math.isfinite(value) else value,
        )
