# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
state_interfaces_broadcaster/StateInterfacesBroadcaster: any state interfaces, as plain numbers.

``~/names`` (latched) has their names, ``~/values`` their values at every update, in that order.
The original publishes the names when it is configured, this one when it is activated.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from amr_description.control.contracts import Output, Port, Qos
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.sensor_samples import NamesSample, ValuesSample
from amr_description.controllers.broadcasters.sensor_broadcaster import SensorBroadcaster
from amr_description.errors import ControllerError
from amr_description.parameters import parameter

_LATCHED = Qos(depth=1, reliability='reliable', durability='transient_local')


@dataclass(frozen=True)
class StateInterfacesParameters:
    """The table of state_interfaces_broadcaster/StateInterfacesBroadcaster."""

    interfaces: tuple[str, ...] = parameter(
        (), 'State interfaces to publish, in this order', not_empty=True, read_only=True
    )


class StateInterfacesBroadcaster(SensorBroadcaster):
    """Publishes the values at every update."""

    parameters_type = StateInterfacesParameters

    def configure(self, parameters: StateInterfacesParameters) -> None:
        """Take over the names."""
        self._interfaces = parameters.interfaces
        self._names: Output[NamesSample] = Output(
            Port('~/names', 'control_msgs/msg/Keys', qos=_LATCHED, sample=NamesSample)
        )
        self._published: Output[ValuesSample] = Output(
            Port('~/values', 'control_msgs/msg/Float64Values', sample=ValuesSample)
        )
        self._read_from(parameters.interfaces, self._names, self._published)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Publish the names. Raises ControllerError: a state is missing, or no double."""
        for state in states:
            if state.data_type != 'double':
                raise ControllerError(
                    f"State interface '{state.name}' ({state.data_type}) is not of type double. "
                    'The StateInterfacesBroadcaster only supports state interfaces that support '
                    'double datatype.'
                )
        super().activate(commands, states, time)
        self._names.send(NamesSample(time, self._interfaces))

    def update(self, time: int, period: int) -> None:
        """Publish the values."""
        self._published.send(ValuesSample(time, self._values()))
