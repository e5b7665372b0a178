# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which hardware component owns which interface, and which controller has claimed it.

Where this departs from ros2_control 4.x: an infinite command (or, as this is Python, one that is
no number) stops its joint, with an ERROR that names the controller. There infinity goes to the
hardware, whose component refuses it and is brought down: one message with a speed of 1e308 m/s
would end the robot.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
import math
from typing import TYPE_CHECKING

from amr_description.control.contracts import Log, Severity
from amr_description.control.foreign_errors import describe
from amr_description.control.hardware_components import HardwareComponents
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    NANOSECONDS,
    StateInterface,
)
from amr_description.control.limits import value_at_rest
from amr_description.control.owned_component import by_name, OwnedComponent
from amr_description.control.statistics import standing_still, Stopwatch
from amr_description.errors import HardwareError, InterfaceError

if TYPE_CHECKING:
    from amr_description.model.robot import Robot


class ResourceManager(HardwareComponents):
    """The components of one robot, their interfaces and the claims on them."""

    def __init__(
        self,
        log: Log,
        robot: 'Robot | None' = None,
        enforce_command_limits: bool = False,
        stopwatch: Stopwatch = standing_still,
    ) -> None:
        """See the base."""
        super().__init__(log, robot, enforce_command_limits, stopwatch)
        self.claims: dict[str, str] = {}
        """Command interface → the controller that holds it."""
        self.lends_commands_of_inactive = False
        """True: controllers may command components that are not active (yet)."""
        self._references: dict[str, dict[str, CommandInterface]] = {}
        self._exported_states: dict[str, dict[str, StateInterface]] = {}

    # --- interfaces ---------------------------------------------------------------------------

    def available_commands(self) -> dict[str, CommandInterface]:
        """
        Every command interface of an active component or controller, by name.

        With ``lends_commands_of_inactive`` those of inactive components too.
        """
        lending = (
            owned
            for owned in self.components.values()
            if owned.state is LifecycleState.ACTIVE
            or (self.lends_commands_of_inactive and owned.is_available)
        )
        sources = chain((owned.commands for owned in lending), self._references.values())
        return {name: handle for source in sources for name, handle in source.items()}

    def available_states(self) -> dict[str, StateInterface]:
        """Every state interface that can be read, by name: components in their order first."""
        available = (owned for owned in self.components.values() if owned.is_available)
        sources = chain((owned.states for owned in available), self._exported_states.values())
        return {name: handle for source in sources for name, handle in source.items()}

    @staticmethod
    def names(request: InterfaceRequest, available: Iterable[str]) -> tuple[str, ...]:
        """Resolve a request to names: all that are available, those listed, or none."""
        if request.claim is Claim.ALL:
            return tuple(available)
        return request.names

    def claim(self, controller: str, names: Sequence[str]) -> list[CommandInterface]:
        """Lend the command interfaces to a controller. Raises InterfaceError, claiming nothing."""
        available = self.available_commands()
        for name in names:
            if name not in available:
                raise InterfaceError(f"the command interface '{name}' is not available")
            holder = self.claims.get(name)
            if holder is not None:
                raise InterfaceError(f"the command interface '{name}' is claimed by '{holder}'")
        self.claims.update(dict.fromkeys(names, controller))
        return [available[name] for name in names]

    def lend_states(self, names: Sequence[str]) -> list[StateInterface]:
        """Lend state interfaces, which any number may read. Raises InterfaceError."""
        available = self.available_states()
        missing = [name for name in names if name not in available]
        if missing:
            raise InterfaceError(f"the state interface '{missing[0]}' is not available")
        return [available[name] for name in names]

    def release(self, controller: str) -> None:
        """Take all claims of a controller back."""
        self.claims = {name: by for name, by in self.claims.items() if by != controller}

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Ask each component about its commands that begin and end. Raises HardwareError."""
        for owned, begin, end in self._concerned(start, stop):
            try:
                owned.component.prepare_command_mode_switch(begin, end)
            except Exception as error:  # a foreign component may raise anything
                raise HardwareError(
                    f"Hardware component '{owned.info.name}' refuses the command mode: "
                    f'{describe(error)}'
                ) from error

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Tell each component which of its commands begin and end now. Raises HardwareError."""
        for owned, begin, end in self._concerned(start, stop):
            try:
                owned.component.perform_command_mode_switch(begin, end)
            except Exception as error:
                raise HardwareError(
                    f"Hardware component '{owned.info.name}' failed to switch its command mode: "
                    f'{describe(error)}'
                ) from error

    def _concerned(
        self, start: Sequence[str], stop: Sequence[str]
    ) -> Iterator[tuple[OwnedComponent, list[str], list[str]]]:
        """The available components that own some of these, each with its own."""
        for owned in self.components.values():
            begin = [name for name in start if name in owned.commands]
            end = [name for name in stop if name in owned.commands]
            if owned.is_available and (begin or end):
                yield owned, begin, end

    def enforce_limits(self, period: int) -> None:
        """
        Bound what the controllers have written, for ``period`` ns; before every :meth:`write`.

        With ``enforce_command_limits`` commands are kept within the limits of their joints. In any
        case an infinite one stops its joint, and so does what is no number at all: no component
        is ever given one.
        """
        for name, owned in self.components.items():
            if not owned.is_available:
                continue
            try:
                self._bound(name, owned, period)
            except (TypeError, OverflowError):
                for command in owned.commands.values():
                    if not _is_number(command.value):
                        self._stop(command)
                self._bound(name, owned, period)

    def _bound(self, name: str, owned: OwnedComponent, period: int) -> None:
        """Raises TypeError or OverflowError where a command is no number."""
        for limiter in self._limiters.get(name, ()):
            limiter.enforce(period / NANOSECONDS)
        for command in owned.commands.values():
            if math.isinf(command.value):
                self._stop(command)

    def _stop(self, command: CommandInterface) -> None:
        still = value_at_rest(command.interface)
        writer = self.claims.get(command.name)
        by = f" by controller '{writer}'" if writer else ''
        self.log(
            Severity.ERROR,
            f"The command '{command.name}' is {command.value}{by}; a finite number is needed. It "
            f'is set to {still}',
            throttle=1.0,
        )
        command.value = still

    # --- what controllers offer ---------------------------------------------------------------

    def offer(
        self,
        controller: str,
        references: Iterable[CommandInterface],
        states: Iterable[StateInterface],
    ) -> None:
        """Make an active controller's references and exported states available to others."""
        self._references[controller] = by_name(references, controller)
        self._exported_states[controller] = by_name(states, controller)

    def withdraw(self, controller: str) -> None:
        """Take what a controller offered back."""
        self._references.pop(controller, None)
        self._exported_states.pop(controller, None)


def _is_number(value: object) -> bool:
    """Tell whether a stranger's controller has written what a component can read."""
    try:
        math.isinf(value)
    except (TypeError, OverflowError):
        return False
    return True
