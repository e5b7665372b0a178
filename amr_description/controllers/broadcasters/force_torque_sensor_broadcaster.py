# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster: a wrench, on ``~/wrench``.

The sensor is one of the ``<ros2_control>`` block with the six states ``force.x`` … ``torque.z``
(``sensor_name``), or any states are named one by one (``interface_names``); an axis without one is
NaN. What is published is (measured + offset) · multiplier, which other controllers may read as
``<controller>/<sensor>/force.x`` …, or as ``<controller>/<interface>``.

With ``sensor_filter_chain`` (:mod:`amr_description.controllers.filters`), ``~/wrench_filtered``
has the filtered wrench, too.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import itertools
import math

from amr_description.control.contracts import ControllerContext, Output, Port
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.sensor_samples import WrenchSample
from amr_description.controllers.broadcasters.sensor_broadcaster import (
    axes,
    below,
    SensorBroadcaster,
)
from amr_description.controllers.filters import FilterChain, FilterParameters
from amr_description.errors import ControllerError
from amr_description.parameters import group, numbered_group, parameter

_AXES = (*axes('force'), *axes('torque'))


@dataclass(frozen=True)
class AxisNames:
    """The interfaces of one vector."""

    x: str = parameter('', 'State interface of x')
    y: str = parameter('', 'State interface of y')
    z: str = parameter('', 'State interface of z')


@dataclass(frozen=True)
class WrenchNames:
    """The interfaces of a wrench."""

    force: AxisNames = group('force', AxisNames)
    torque: AxisNames = group('torque', AxisNames)

    @property
    def all(self) -> tuple[str, ...]:
        """In the order force x, y, z, torque x, y, z; '' where there is none."""
        force, torque = self.force, self.torque
        return (force.x, force.y, force.z, torque.x, torque.y, torque.z)


@dataclass(frozen=True)
class Offsets:
    """What is added to a vector."""

    x: float = parameter(0.0, 'Added to x')
    y: float = parameter(0.0, 'Added to y')
    z: float = parameter(0.0, 'Added to z')


@dataclass(frozen=True)
class Multipliers:
    """What a vector is multiplied by, after the offset."""

    x: float = parameter(1.0, 'Factor on x')
    y: float = parameter(1.0, 'Factor on y')
    z: float = parameter(1.0, 'Factor on z')


@dataclass(frozen=True)
class WrenchOffsets:
    """Of force and torque."""

    force: Offsets = group('force', Offsets)
    torque: Offsets = group('torque', Offsets)


@dataclass(frozen=True)
class WrenchMultipliers:
    """Of force and torque."""

    force: Multipliers = group('force', Multipliers)
    torque: Multipliers = group('torque', Multipliers)


@dataclass(frozen=True)
class ForceTorqueParameters:
    """The table of force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster."""

    frame_id: str = parameter('', 'Frame in which the values are', not_empty=True)
    sensor_name: str = parameter('', 'Name of the sensor in <ros2_control>, or interface_names')
    interface_names: WrenchNames = group('interface_names', WrenchNames)
    offset: WrenchOffsets = group('offset', WrenchOffsets)
    multiplier: WrenchMultipliers = group('multiplier', WrenchMultipliers)
    filters: Mapping[str, FilterParameters] = numbered_group(
        'sensor_filter_chain.filter', FilterParameters
    )


class ForceTorqueSensorBroadcaster(SensorBroadcaster):
    """Publishes the wrench at every update."""

    parameters_type = ForceTorqueParameters
    is_chainable = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._exports: tuple[StateInterface, ...] = ()

    def configure(self, parameters: ForceTorqueParameters) -> None:
        """Determine the interfaces. Raises ControllerError: none is named, or twice."""
        sensor, named = parameters.sensor_name, parameters.interface_names.all
        if not sensor and not any(named):
            raise ControllerError(
                "'sensor_name' or at least one 'interface_names.[force|torque].[x|y|z]' parameter "
                'has to be specified.'
            )
        if sensor and any(named):
            raise ControllerError(
                "both 'sensor_name' and 'interface_names.[force|torque].[x|y|z]' parameters can "
                'not be specified together.'
            )
        interfaces = below(sensor, *_AXES) if sensor else named
        self._frame_id = parameters.frame_id
        self._is_measured = tuple(bool(name) for name in interfaces)
        offset, multiplier = parameters.offset, parameters.multiplier
        self._corrections = [
            (added, factor)
            for sums, factors in (
                (offset.force, multiplier.force),
                (offset.torque, multiplier.torque),
            )
            for added, factor in ((sums.x, factors.x), (sums.y, factors.y), (sums.z, factors.z))
        ]
        self._exports = tuple(
            StateInterface(self.context.name, name) for name in interfaces if name
        )
        self._wrench: Output[WrenchSample] = Output(
            Port('~/wrench', 'geometry_msgs/msg/WrenchStamped', sample=WrenchSample)
        )
        self._filtered: Output[WrenchSample] = Output(
            Port('~/wrench_filtered', 'geometry_msgs/msg/WrenchStamped', sample=WrenchSample)
        )
        self._filters = parameters.filters
        self._make_chains()
        outputs = (self._wrench, self._filtered) if self._filters else (self._wrench,)
        self._read_from(filter(None, interfaces), *outputs)

    def exported_states(self) -> tuple[StateInterface, ...]:
        """Return the corrected values, under the names of those that they are made of."""
        return self._exports

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Begin to filter. Raises ControllerError: a state is missing."""
        super().activate(commands, states, time)
        self._make_chains()

    def update(self, time: int, period: int) -> None:
        """Correct the values, publish and export them."""
        values = iter(self._values())
        measured = [next(values) if known else math.nan for known in self._is_measured]
        wrench = tuple(
            [
                (value + added) * factor
                for value, (added, factor) in zip(measured, self._corrections, strict=True)
            ]
        )
        known = itertools.compress(wrench, self._is_measured)
        for state, value in zip(self._exports, known, strict=True):
            state.value = value
        self._wrench.send(WrenchSample(time, self._frame_id, wrench[:3], wrench[3:]))
        if self._filters:
            filtered = tuple(
                [chain.update(value) for chain, value in zip(self._chains, wrench, strict=True)]
            )
            self._filtered.send(WrenchSample(time, self._frame_id, filtered[:3], filtered[3:]))

    def reset(self, time: int) -> None:
        """Forget what was before: the simulation was reset."""
        self._make_chains()

    def set_clock(self, time: int) -> None:
        """Do nothing: it has no stamps."""

    def _make_chains(self) -> None:
        self._chains = [FilterChain(self._filters) for _ in _AXES]
