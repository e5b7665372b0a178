# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller inside the manager: its lifecycle state, its interfaces, and its update rate."""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeAlias

from amr_description.control.chains import ChainInterfaces
from amr_description.control.contracts import Action, Controller, Input
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    NO_INTERFACES,
    StateInterface,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import RunningCycleStatistic
from amr_description.errors import ControllerError

TransitionCallback: TypeAlias = Callable[
    [LifecycleState, LifecycleState, LifecycleState | None], None
]
"""Called as (start, goal, None) when a transition begins, (start, goal, reached) when it ends."""


def ignore_transition(_: LifecycleState, __: LifecycleState, ___: LifecycleState | None) -> None:
    """Do nothing: a :data:`TransitionCallback`."""


class LoadedController:
    """A controller with its lifecycle, which only the manager changes."""

    def __init__(
        self,
        controller: Controller,
        type_name: str,
        update_divisor: int,
        fallbacks: Iterable[str] = (),
        on_transition: TransitionCallback = ignore_transition,
    ) -> None:
        """
        Take a controller.

        Args:
            controller: unconfigured.
            type_name: as in ``controller_manager_msgs/msg/ControllerState``.
            update_divisor: ticks of the manager for each of its updates.
            fallbacks: names of the controllers to start if it fails.
            on_transition: called for every transition.
        """
        self._on_transition = on_transition
        self.statistic = RunningCycleStatistic()
        """Of its updates since it was activated."""
        self.fallbacks = tuple(fallbacks)
        self.controller = controller
        self.type = type_name
        self.update_divisor = update_divisor
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands: tuple[str, ...] = ()
        self.required_states: tuple[str, ...] = ()
        self.references: tuple[CommandInterface, ...] = ()
        self.exported_states: tuple[StateInterface, ...] = ()
        self.chain_interfaces = ChainInterfaces()
        """What links it to other controllers, once configured."""
        self.is_busy = False
        """True while its ``configure`` may be running on another thread."""
        self.has_failed = False
        """True: its own ``activate`` raised."""
        # Requested once, as are the inputs: a third-party controller may raise.
        self._command_request = self._state_request = NO_INTERFACES
        self._inputs: tuple[Input[Any], ...] = ()
        self._actions: tuple[Action[Any, Any, Any], ...] = ()
        self.last_update: int | None = None
        """ns; None: not since it was activated, or since a jump of the clock."""
        self._ticks = 0

    @property
    def name(self) -> str:
        """Its name, and that of its node."""
        return self.controller.context.name

    @property
    def is_active(self) -> bool:
        """True while it is updated."""
        return self.state is LifecycleState.ACTIVE

    @property
    def is_configured(self) -> bool:
        """True while it is inactive or active."""
        return self.state in (LifecycleState.INACTIVE, LifecycleState.ACTIVE)

    @contextmanager
    def transition(self, goal: LifecycleState) -> Iterator[None]:
        """Report the start of a transition and, however the block ends, the state reached."""
        start = self.state
        self._on_transition(start, goal, None)
        try:
            yield
        finally:
            self._on_transition(start, goal, self.state)

    def become_inactive(self, resources: ResourceManager) -> None:
        """Complete a ``configure``. Raises ControllerError; it is then cleaned up again."""
        try:
            self._request_interfaces(resources)
        except Exception:
            self.become_unconfigured()
            raise
        self.state = LifecycleState.INACTIVE

    def _request_interfaces(self, resources: ResourceManager) -> None:
        controller = self.controller
        self._command_request = controller.command_interfaces()
        self._state_request = controller.state_interfaces()
        self._inputs = tuple(controller.inputs())
        self._actions = tuple(controller.actions())
        if controller.is_chainable:
            self.references = tuple(controller.references())
            self.exported_states = tuple(controller.exported_states())
        self.chain_interfaces = ChainInterfaces(
            _listed(self._command_request),
            _listed(self._state_request),
            tuple(handle.name for handle in self.references),
            tuple(handle.name for handle in self.exported_states),
        )
        available = resources.available_commands(), resources.available_states()
        self.required_commands, self.required_states = self.wanted(*available)
        self._check_unique('command', self.required_commands)
        self._check_unique('state', self.required_states)
        self._check_exported('reference', self.chain_interfaces.references, available[0])
        self._check_exported('exported state', self.chain_interfaces.exported_states, available[1])

    def wanted(
        self, commands: Iterable[str], states: Iterable[str]
    ) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """
        Return the names of the command and of the state interfaces that it needs.

        Only a controller that requests all interfaces depends on which ones are available; those
        that it exports itself are left out.

        Args:
            commands: names of the available command interfaces.
            states: names of the available state interfaces.
        """
        own, names = self.chain_interfaces, ResourceManager.names
        return (
            names(self._command_request, (n for n in commands if n not in own.references)),
            names(self._state_request, (n for n in states if n not in own.exported_states)),
        )

    def activate(self, resources: ResourceManager, time: int, *, chained: bool = False) -> None:
        """
        Inactive → active; its references and exported states become available.

        Args:
            resources: lends the interfaces.
            time: present time, ns.
            chained: whether another controller commands its references.

        Raises:
            Exception: anything; its claims are then released, and it stays inactive.
        """
        self.has_failed = False
        with self.transition(LifecycleState.ACTIVE):
            self._activate(resources, time, chained)

    def _activate(self, resources: ResourceManager, time: int, chained: bool) -> None:
        try:
            self._set_chained_mode(chained)
            self.required_commands, self.required_states = self.wanted(
                resources.available_commands(), resources.available_states()
            )
            commands = resources.claim(self.name, self.required_commands)
            states = resources.lend_states(self.required_states)
            self.has_failed = True
            self.controller.activate(commands, states, time)
            self.has_failed = False
        except Exception:
            resources.release(self.name)
            self._set_chained_mode(False)
            raise
        self.last_update = None
        self._ticks = 0
        self.statistic.reset()
        for port in self._inputs:
            port.open()
        for action in self._actions:
            action.open()
        resources.add_exported(self.name, self.references, self.exported_states)
        self.state = LifecycleState.ACTIVE

    def is_due(self) -> bool:
        """Return whether it is updated at this tick: at every nth, for ``update_divisor``."""
        ticks, self._ticks = self._ticks, self._ticks + 1
        return ticks % self.update_divisor == 0

    def deactivate(self, resources: ResourceManager, time: int) -> None:
        """Active → inactive, even if its ``deactivate`` raises; ``time`` in ns."""
        with self.transition(LifecycleState.INACTIVE):
            self._deactivate(resources, time)

    def _deactivate(self, resources: ResourceManager, time: int) -> None:
        for port in self._inputs:
            port.close()
        for action in self._actions:
            action.close()
        try:
            self.controller.deactivate(time)
        finally:
            for action in self._actions:
                action.end()
            resources.release(self.name)
            resources.remove_exported(self.name)
            self.state = LifecycleState.INACTIVE
            self._set_chained_mode(False)

    def _set_chained_mode(self, chained: bool) -> None:
        if self.controller.is_chained != chained:
            self.controller.set_chained_mode(chained)
            self.controller.is_chained = chained  # in case an override forgets to

    def cleanup(self) -> None:
        """Inactive → unconfigured."""
        with self.transition(LifecycleState.UNCONFIGURED):
            self.become_unconfigured()

    def finalize(self) -> None:
        """Unconfigured or inactive → finalized."""
        with self.transition(LifecycleState.FINALIZED):
            self.state = LifecycleState.FINALIZED

    def become_unconfigured(self) -> None:
        """Clean up, as part of a transition."""
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands = self.required_states = ()
        self.references = self.exported_states = ()
        self.chain_interfaces = ChainInterfaces()
        self._command_request = self._state_request = NO_INTERFACES
        self._inputs = ()
        self._actions = ()
        self.controller.cleanup()

    def reset(self, time: int) -> None:
        """The simulation was reset to ``time``, ns; the next tick updates, as the first does."""
        self.last_update = None
        self._ticks = 0
        if self.is_configured:
            self.controller.reset(time)

    def set_clock(self, time: int) -> None:
        """The clock jumped to ``time``, ns."""
        self.last_update = None
        if self.is_configured:
            self.controller.set_clock(time)

    def _check_unique(self, kind: str, names: Sequence[str]) -> None:
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ControllerError(
                f"The {kind} interfaces of the controller '{self.name}' are not unique. Please "
                f"make sure that the {kind} interfaces are unique : '{' '.join(twice)}'."
            )

    def _check_exported(self, kind: str, names: Sequence[str], available: Collection[str]) -> None:
        """Raise ControllerError unless the names are unique, new, and begin with its own name."""
        self._check_unique(kind, names)
        for name in names:
            if not name.startswith(f'{self.name}/'):
                raise ControllerError(
                    f"The {kind} interface '{name}' of the controller '{self.name}' must be named "
                    f"'{self.name}/...'"
                )
            if name in available:
                raise ControllerError(
                    f"The {kind} interface '{name}' of the controller '{self.name}' is there "
                    'already: another component exports it'
                )


def _listed(request: InterfaceRequest) -> tuple[str, ...]:
    return request.names if request.claim is Claim.INDIVIDUAL else ()
