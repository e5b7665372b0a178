# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which hardware component owns which interface, and which controller has claimed it."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from amr_description.control.contracts import HardwareComponent, Log, Severity
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    StateInterface,
)
from amr_description.errors import AmrError, HardwareError, InterfaceError

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

    # --- components ---------------------------------------------------------------------------

    def add(self, component: HardwareComponent) -> None:
        """Take a component and its interfaces. Raises HardwareError where a name is taken."""
        info = component.info
        if info.name in self.components:
            raise HardwareError(f"Hardware component '{info.name}' is there twice")
        states = {handle.name: handle for handle in component.state_interfaces()}
        commands = {handle.name: handle for handle in component.command_interfaces()}
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
            _transition(owned, following, upwards)
            owned.state = following

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
            kind = '' if isinstance(error, AmrError) else f'{type(error).__name__}: '
            self.log(
                Severity.ERROR,
                f"{action} of hardware component '{owned.info.name}' failed: {kind}{error}",
            )
            owned.state = LifecycleState.UNCONFIGURED
            return False
        return True

    # --- interfaces ---------------------------------------------------------------------------

    def available_commands(self) -> dict[str, CommandInterface]:
        """Every command interface of an active component, by name."""
        active = (o for o in self.components.values() if o.state is LifecycleState.ACTIVE)
        return {name: handle for owned in active for name, handle in owned.commands.items()}

    def available_states(self) -> dict[str, StateInterface]:
        """Every state interface of a configured component, by name, in the components' order."""
        available = (owned for owned in self.components.values() if owned.is_available)
        return {name: handle for owned in available for name, handle in owned.states.items()}

    def names(self, request: InterfaceRequest, available: Iterable[str]) -> tuple[str, ...]:
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

    def switch_command_mode(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Tell each component which of its commands begin and end. Raises HardwareError."""
        for owned in self.components.values():
            mine_start = [name for name in start if name in owned.commands]
            mine_stop = [name for name in stop if name in owned.commands]
            if mine_start or mine_stop:
                owned.component.switch_command_mode(mine_start, mine_stop)


def _transition(owned: OwnedComponent, target: LifecycleState, upwards: bool) -> None:
    component = owned.component
    transition = {
        (LifecycleState.INACTIVE, True): component.configure,
        (LifecycleState.ACTIVE, True): component.activate,
        (LifecycleState.INACTIVE, False): component.deactivate,
        (LifecycleState.UNCONFIGURED, False): component.cleanup,
    }[target, upwards]
    transition()


def _listed(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'
