# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Filters of numbers, chains of them, and the controller that filters states with them.

Filters and parameters have the names of the packages filters and control_filters. A filter of
wrenches is one of numbers for each of the six axes: ``…Wrench`` and ``…Double`` are alike. The
first number passes as it is, so that no filter begins at zero.

Formulas: ros/filters (BSD), control_toolbox (Apache-2.0).
"""

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
import math
from statistics import fmean, median_high

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.controllers.broadcasters.sensor_broadcaster import SensorBroadcaster
from amr_description.errors import ControllerError
from amr_description.parameters import group, keyed_group, numbered_group, parameter


@dataclass(frozen=True)
class FilterSettings:
    """What the filters need; each its own."""

    number_of_observations: int = parameter(0, 'Of a mean or median filter', minimum=0)
    sampling_frequency: float = parameter(0.0, 'Of a low-pass filter', unit='Hz', minimum=0.0)
    damping_frequency: float = parameter(0.0, 'Of a low-pass filter', unit='Hz', minimum=0.0)
    damping_intensity: float = parameter(0.0, 'Of a low-pass filter', unit='dB', minimum=0.0)
    alpha: float = parameter(
        0.0, 'Of an exponential filter: weight of a new number', minimum=0.0, maximum=1.0
    )


@dataclass(frozen=True)
class FilterParameters:
    """One filter of a chain."""

    name: str = parameter('', 'What it is called')
    type: str = parameter('', 'Type of the filter', not_empty=True)
    params: FilterSettings = group('params', FilterSettings)


class Filter(ABC):
    """One filter of one number after the other."""

    @abstractmethod
    def update(self, value: float) -> float:
        """Return the filtered number."""


class _Last(Filter):
    """Something of the last numbers."""

    def __init__(self, count: int, make: Callable[[Sequence[float]], float]) -> None:
        self._values: deque[float] = deque(maxlen=count)
        self._make = make

    def update(self, value: float) -> float:
        self._values.append(value)
        return self._make(self._values)


class _LowPass(Filter):
    """Returns b·x₋₁ + a·y₋₁ with a = exp(−2π·f_d / f_s / 10^(−intensity/10)), b = 1 − a."""

    def __init__(self, settings: FilterSettings) -> None:
        damping = 10.0 ** (settings.damping_intensity / -10.0)
        ratio = 2.0 * math.pi * settings.damping_frequency / settings.sampling_frequency
        self._factor = math.exp(-ratio / damping)
        self._before = self._filtered = math.nan

    def update(self, value: float) -> float:
        if math.isnan(self._filtered):
            self._before = self._filtered = value
        self._filtered = (1.0 - self._factor) * self._before + self._factor * self._filtered
        self._before = value
        return self._filtered


class _Exponential(Filter):
    """Returns alpha·x + (1 − alpha)·y₋₁."""

    def __init__(self, alpha: float) -> None:
        self._alpha = alpha
        self._filtered = math.nan

    def update(self, value: float) -> float:
        before = value if math.isnan(self._filtered) else self._filtered
        self._filtered = self._alpha * value + (1.0 - self._alpha) * before
        return self._filtered


class _Increment(Filter):
    """Returns x + 1."""

    def update(self, value: float) -> float:
        return value + 1.0


def _low_pass(settings: FilterSettings) -> Filter:
    _need(settings, 'sampling_frequency', 'damping_frequency')
    return _LowPass(settings)


def _mean(settings: FilterSettings) -> Filter:
    _need(settings, 'number_of_observations')
    return _Last(settings.number_of_observations, fmean)


def _median(settings: FilterSettings) -> Filter:
    _need(settings, 'number_of_observations')
    return _Last(settings.number_of_observations, median_high)


def _need(settings: FilterSettings, *names: str) -> None:
    for name in names:
        if not getattr(settings, name) > 0:
            raise ControllerError(f'params.{name} must be greater than 0')


_FILTERS: dict[str, Callable[[FilterSettings], Filter]] = {
    'control_filters/ExponentialFilter': lambda settings: _Exponential(settings.alpha),
    'control_filters/LowPassFilter': _low_pass,
    'filters/IncrementFilter': lambda settings: _Increment(),
    'filters/MeanFilter': _mean,
    'filters/MedianFilter': _median,
}


class FilterChain:
    """Filters of one number, one after the other."""

    def __init__(self, chain: Mapping[str, FilterParameters]) -> None:
        """Make the filters. Raises ControllerError: there is no such type, or it lacks a value."""
        self._filters = [_filter(number, each) for number, each in chain.items()]

    def update(self, value: float) -> float:
        """Return the filtered number."""
        for each in self._filters:
            value = each.update(value)
        return value


def _filter(number: str, given: FilterParameters) -> Filter:
    kind = given.type.removesuffix('Double').removesuffix('Wrench')
    if kind not in _FILTERS:
        known = ', '.join(f'{each}Double' for each in _FILTERS)
        raise ControllerError(
            f"filter{number}: there is no filter of type '{given.type}' here; there are: {known}, "
            'and the same for wrenches'
        )
    try:
        return _FILTERS[kind](given.params)
    except ControllerError as error:
        raise ControllerError(f'filter{number} ({given.type}): {error}') from None


_CHAIN = 'filter_chain.filter'


@dataclass(frozen=True)
class InputFilters:
    """The filters of one input."""

    filters: Mapping[str, FilterParameters] = numbered_group(_CHAIN, FilterParameters)


@dataclass(frozen=True)
class ChainedFilterParameters:
    """The table of chained_filter_controller/ChainedFilter."""

    input_interfaces: tuple[str, ...] = parameter(
        (), 'State interfaces to filter', not_empty=True, read_only=True
    )
    output_interfaces: tuple[str, ...] = parameter(
        (), 'Names of the filtered ones, in the same order', not_empty=True, read_only=True
    )
    filters: Mapping[str, FilterParameters] = numbered_group(_CHAIN, FilterParameters)
    own_filters: Mapping[str, InputFilters] = keyed_group('', 'input_interfaces', InputFilters)


class ChainedFilter(SensorBroadcaster):
    """
    chained_filter_controller/ChainedFilter: state interfaces, filtered, for other controllers.

    Each of ``input_interfaces`` is filtered by ``filter_chain``, or if there is none by its own
    ``<input interface>.filter_chain``, and exported as ``<controller>/<output interface>``. It
    publishes nothing. A state that is NaN leaves the filtered one as it was.
    """

    parameters_type = ChainedFilterParameters
    is_chainable = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._exports: tuple[StateInterface, ...] = ()
        self._chains: tuple[FilterChain, ...] = ()

    def configure(self, parameters: ChainedFilterParameters) -> None:
        """Make the filters. Raises ControllerError: names or filters are missing."""
        inputs, outputs = parameters.input_interfaces, parameters.output_interfaces
        if len(inputs) != len(outputs):
            raise ControllerError(
                f'input_interfaces ({len(inputs)}) and output_interfaces ({len(outputs)}) have to '
                'be equally many'
            )
        self._parameters = parameters
        self._make_chains()
        self._exports = tuple(StateInterface(self.context.name, name) for name in outputs)
        self._read_from(inputs)

    def exported_states(self) -> tuple[StateInterface, ...]:
        """Return the filtered states."""
        return self._exports

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Begin to filter. Raises ControllerError: a state is missing."""
        super().activate(commands, states, time)
        self._begin()

    def update(self, time: int, period: int) -> None:
        """Filter."""
        for value, chain, export in zip(self._values(), self._chains, self._exports, strict=True):
            if not math.isnan(value):
                export.value = chain.update(value)

    def reset(self, time: int) -> None:
        """Forget what was before: the simulation was reset."""
        self._begin()

    def set_clock(self, time: int) -> None:
        """Do nothing: it has no stamps."""

    def _begin(self) -> None:
        self._make_chains()
        for export in self._exports:
            export.value = math.nan

    def _make_chains(self) -> None:
        given = self._parameters
        chains = [
            given.filters or given.own_filters[name].filters for name in given.input_interfaces
        ]
        for name, chain in zip(given.input_interfaces, chains, strict=True):
            if not chain:
                raise ControllerError(
                    f"there is no filter for '{name}': give filter_chain.filter1.type, or "
                    f'{name}.filter_chain.filter1.type'
                )
        self._chains = tuple(FilterChain(chain) for chain in chains)
