# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What broadcasters of sensors have in common: they read given states, and command nothing."""

from collections.abc import Iterable, Sequence
from typing import Any

from amr_description.control.contracts import Controller, ControllerContext, Output
from amr_description.control.interfaces import CommandInterface, InterfaceRequest, StateInterface


class SensorBroadcaster(Controller):
    """
    Publishes some state interfaces at every update.

    A broadcaster calls :meth:`_read_from` at the end of ``configure``, and :meth:`_values` in
    ``update``.
    """

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._request = InterfaceRequest.individual(())
        self._outputs: tuple[Output[Any], ...] = ()
        self._states: tuple[StateInterface, ...] = ()

    def _read_from(self, interfaces: Iterable[str], *outputs: Output[Any]) -> None:
        """Have these state interfaces, by their full names, published on these topics."""
        self._request = InterfaceRequest.individual(interfaces)
        self._outputs = outputs

    def _values(self) -> tuple[float, ...]:
        """Return the present states, in the order of the interfaces."""
        return tuple([float(state.value) for state in self._states])

    def state_interfaces(self) -> InterfaceRequest:
        """Return those that are published."""
        return self._request

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return the topics."""
        return self._outputs

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces. Raises ControllerError: some are missing."""
        self._request.require_all(states, 'state')
        self._states = tuple(states)

    def deactivate(self, time: int) -> None:
        """Drop the interfaces."""
        self._states = ()


def below(name: str, *interfaces: str) -> tuple[str, ...]:
    """Return the full names of interfaces of one sensor."""
    return tuple(f'{name}/{interface}' for interface in interfaces)


def axes(quantity: str, names: str = 'xyz') -> tuple[str, ...]:
    """Return the interfaces of a vector: ``force.x``, ``force.y``, ``force.z``."""
    return tuple(f'{quantity}.{axis}' for axis in names)
