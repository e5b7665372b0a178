# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which hardware component owns which interface, and which controller has claimed it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING

from amr_description.control.contracts import HardwareComponent, Log, Severity
from amr_description.control.foreign_errors import describe
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    Handle,
    InterfaceRequest,
    LifecycleState,
    StateInterface,
)
from amr_description.errors import HardwareError, InterfaceError

if TYPE_CHECKING:
    from amr_description.model.ros2_control_tag import HardwareInfo

_PATH = (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE, LifecycleState.ACTIVE)


@dataclass(slots=True)
class OwnedComponent:
    """A component, with what the manager knows of it; interfaces are available once configured."""

    info: 'HardwareInfo'
    component: HardwareComponent
    states: Mapping[str, StateInterface]
    commands: Mapping[str, CommandInterface]
    state: LifecycleState = LifecycleState.UNCONFIGURED

    @property
    def is_available(self) -> bool:
        """True when its interfaces may be used."""
        return self.state in (LifecycleState.INACTIVE, LifecycleState.ACTIVE)


@dataclass
class ResourceManager:
    """All components of one robot, their interfaces and the claims on them."""

    log: Log
    components: dict[str, OwnedComponent] = field(default_factory=dict)
    claims: dict[str, str] = field(default_factory=dict)
    """Command interface → the controller that holds it."""
    _references: dict[str, dict[str, CommandInterface]] = field(default_factory=dict)
    _exported_states: dict[str, dict[str, StateInterface]] = field(default_factory=dict)

    # --- components ---------------------------------------------------------------------------

    def add(self, component: HardwareComponent) -> None:
        """Take a component and its interfaces. Raises HardwareError where a name is taken."""
        info = component.info
        if info.name in self.components:
            raise HardwareError(f"Hardware component '{info.name}' is there twice")
        states = _by_name(component.state_interfaces(), info.name)
        commands = _by_name(component.command_interfaces(), info.name)
        for other in self.components.values():
            twice = states.keys() & other.states.keys() | commands.keys() & other.commands.keys()
            if twice:
                raise HardwareError(
                    f"Interface '{min(twice)}' is exported by the hardware components "
                    f"'{other.info.name}' and '{info.name}'; one of them must leave it out"
                )
        self.components[info.name] = OwnedComponent(info, component, states, commands)

    def set_state(self, name: str, target: LifecycleState) -> None:
        """
        Bring a component to ``target``, one transition after the other.

        Raises HardwareError: unknown component, or a transition failed; it is then left in the
        state that it reached.
        """
        owned = self.components.get(name)
        if owned is None:
            raise HardwareError(
                f"Hardware component '{name}' does not exist. Known: {_listed(self.components)}"
            )
        if target not in _PATH or owned.state not in _PATH:
            raise HardwareError(
                f"Hardware component '{name}' cannot go from {owned.state.label} to {target.label}"
            )
        while owned.state != target:
            upwards = owned.state < target
            following = LifecycleState(owned.state + (1 if upwards else -1))
            try:
                _transition(owned, following, upwards)
            except Exception as error:  # a foreign component may raise anything
                raise HardwareError(
                    f"Hardware component '{name}' failed on its way from {owned.state.label} to "
                    f'{following.label}: {describe(error)}'
                ) from error
            owned.state = following

    def shut_down(self) -> None:
        """Stop and close every component, as far as it still can."""
        for owned in self.components.values():
            self._bring_down(owned)

    def read(self, time: int, period: int) -> list[str]:
        """Read every available component; return the names of those that failed."""
        available = [owned for owned in self.components.values() if owned.is_available]
        return [o.info.name for o in available if not self._io(o, 'read', time, period)]

    def write(self, time: int, period: int) -> list[str]:
        """Write every active component; return the names of those that failed."""
        active = [o for o in self.components.values() if o.state is LifecycleState.ACTIVE]
        return [o.info.name for o in active if not self._io(o, 'write', time, period)]

    def _io(self, owned: OwnedComponent, action: str, time: int, period: int) -> bool:
        try:
            getattr(owned.component, action)(time, period)
        except Exception as error:  # a foreign component may raise anything; the others go on
            self._report(owned, action, error)
            self._bring_down(owned)
            return False
        return True

    def _bring_down(self, owned: OwnedComponent) -> None:
        """Stop its actuators, which nobody may command any more, and close it; never raises."""
        while owned.state > LifecycleState.UNCONFIGURED:
            following = LifecycleState(owned.state - 1)
            try:
                _transition(owned, following, upwards=False)
            except Exception as error:
                self._report(owned, f'transition to {following.label}', error)
            owned.state = following

    def _report(self, owned: OwnedComponent, action: str, error: Exception) -> None:
        self.log(
            Severity.ERROR,
            f"{action} of hardware component '{owned.info.name}' failed: {describe(error)}",
        )

    # --- interfaces ---------------------------------------------------------------------------

    def available_commands(self) -> dict[str, CommandInterface]:
        """Every command interface of an active component or controller, by name."""
        active = (o for o in self.components.values() if o.state is LifecycleState.ACTIVE)
        sources = chain((owned.commands for owned in active), self._references.values())
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

    # --- what controllers offer ---------------------------------------------------------------

    def offer(
        self,
        controller: str,
        references: Iterable[CommandInterface],
        states: Iterable[StateInterface],
    ) -> None:
        """Make an active controller's references and exported states available to others."""
        self._references[controller] = _by_name(references, controller)
        self._exported_states[controller] = _by_name(states, controller)

    def withdraw(self, controller: str) -> None:
        """Take what a controller offered back."""
        self._references.pop(controller, None)
        self._exported_states.pop(controller, None)


def _transition(owned: OwnedComponent, target: LifecycleState, upwards: bool) -> None:
    component = owned.component
    transition = {
        (LifecycleState.INACTIVE, True): component.configure,
        (LifecycleState.ACTIVE, True): component.activate,
        (LifecycleState.INACTIVE, False): component.deactivate,
        (LifecycleState.UNCONFIGURED, False): component.cleanup,
    }[target, upwards]
    transition()


def _by_name[H: Handle](handles: Iterable[H], owner: str) -> dict[str, H]:
    """Raises HardwareError where the owner exports one name twice."""
    by_name: dict[str, H] = {}
    for handle in handles:
        if handle.name in by_name:
            raise HardwareError(
                f"'{owner}' exports the interface '{handle.name}' twice"
            )
        by_name[handle.name] = handle
    return by_name


def _listed(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'
