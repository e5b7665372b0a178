# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
chained_filter_controller/ChainedFilter: state interfaces, filtered, for other controllers.

Each of ``input_interfaces`` is filtered by ``filter_chain``, or if there is none by its own
``<input interface>.filter_chain``, and exported as ``<controller>/<output interface>``. It
publishes nothing. A state that is NaN leaves the filtered one as it was.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.controllers.filters import FilterChain, FilterParameters
from amr_description.controllers.sensor_broadcaster import SensorBroadcaster
from amr_description.errors import ControllerError
from amr_description.parameters import keyed_group, numbered_group, parameter

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
    """Filters at every update."""

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
