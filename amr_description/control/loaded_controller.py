# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One controller inside the manager: its state, its interfaces and when it is due."""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from amr_description.control.chains import ChainInterfaces
from amr_description.control.contracts import Controller, Input
from amr_description.control.interfaces import (
    Claim,
    CommandInterface,
    InterfaceRequest,
    LifecycleState,
    NO_INTERFACES,
    StateInterface,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import RunningCycleStatistic, Stopwatch, zero_clock
from amr_description.errors import ControllerError

type Watch = Callable[[LifecycleState, LifecycleState, LifecycleState | None], None]
"""Told of a transition: its start, its goal, and at its end the state that was reached."""


def ignore_transition(_: LifecycleState, __: LifecycleState, ___: LifecycleState | None) -> None:
    """Watch nothing."""


class LoadedController:
    """
    A controller with its lifecycle; the manager is the only one to move it.

    ``stride``: it is updated at every so manieth tick of the manager. ``fallbacks``: the names of
    the controllers that are started when it fails. ``watch``: is told of every transition.
    ``stopwatch``: measures its updates.
    """

    def __init__(
        self,
        controller: Controller,
        type_name: str,
        stride: int,
        fallbacks: Iterable[str] = (),
        watch: Watch = ignore_transition,
        stopwatch: Stopwatch = zero_clock,
    ) -> None:
        self._watch = watch
        self._stopwatch = stopwatch
        self.statistic = RunningCycleStatistic()
        """Of its updates since it was activated."""
        self.fallbacks = tuple(fallbacks)
        self.controller = controller
        self.type = type_name
        self.stride = stride
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands: tuple[str, ...] = ()
        self.required_states: tuple[str, ...] = ()
        self.references: tuple[CommandInterface, ...] = ()
        self.exported_states: tuple[StateInterface, ...] = ()
        self.ends = ChainInterfaces()
        """What links it to other controllers, once configured."""
        self.is_busy = False
        """True while its ``configure`` may be running, on whatever thread."""
        self.has_failed = False
        """True when its own ``activate`` raised."""
        self._wishes = (NO_INTERFACES, NO_INTERFACES)
        """Commands and states; asked once, as are the inputs: a stranger's answer may raise."""
        self._inputs: tuple[Input[Any], ...] = ()
        self._last_update: int | None = None
        self._ticks = 0

    @property
    def name(self) -> str:
        """Its name, also that of its node."""
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
        """Tell whoever watches that a transition begins and, either way, where it ended."""
        start = self.state
        self._watch(start, goal, None)
        try:
            yield
        finally:
            self._watch(start, goal, self.state)

    def settle(self, resources: ResourceManager) -> None:
        """Configured → inactive. Raises ControllerError; it is then cleaned up again."""
        try:
            self._ask_for_interfaces(resources)
        except Exception:
            self.unsettle()
            raise
        self.state = LifecycleState.INACTIVE

    def _ask_for_interfaces(self, resources: ResourceManager) -> None:
        controller = self.controller
        commands, states = controller.command_interfaces(), controller.state_interfaces()
        self._wishes, self._inputs = (commands, states), tuple(controller.inputs())
        if controller.is_chainable:
            self.references = tuple(controller.references())
            self.exported_states = tuple(controller.exported_states())
        self.ends = ChainInterfaces(
            _listed(commands),
            _listed(states),
            tuple(handle.name for handle in self.references),
            tuple(handle.name for handle in self.exported_states),
        )
        available = resources.available_commands(), resources.available_states()
        self.required_commands, self.required_states = self.wanted(*available)
        self._check_unique('command', self.required_commands)
        self._check_unique('state', self.required_states)
        self._check_offer('reference', self.ends.references, available[0])
        self._check_offer('exported state', self.ends.exported_states, available[1])

    def wanted(
        self, commands: Iterable[str], states: Iterable[str]
    ) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """
        Which command and which state interfaces it wants when these are available.

        That makes a difference to a controller that wants all; its own are not among them.
        """
        ends, names = self.ends, ResourceManager.names
        wished_commands, wished_states = self._wishes
        return (
            names(wished_commands, (name for name in commands if name not in ends.references)),
            names(wished_states, (name for name in states if name not in ends.exported_states)),
        )

    def activate(self, resources: ResourceManager, time: int, *, chained: bool = False) -> None:
        """
        Inactive → active, and what it offers becomes available to others.

        Raises; all claims are then given back, and it stays inactive.
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
        self._last_update = None
        self._ticks = 0
        self.statistic.reset()
        for port in self._inputs:
            port.open()
        resources.offer(self.name, self.references, self.exported_states)
        self.state = LifecycleState.ACTIVE

    def update(self, time: int, nominal_period: int) -> None:
        """
        Update it if it is due at this tick, and measure that.

        ``nominal_period``: of the manager, ns.
        """
        is_due = self._ticks % self.stride == 0
        self._ticks += 1
        if not is_due:
            return
        last, self._last_update = self._last_update, time
        period = nominal_period * self.stride if last is None else time - last
        begin = self._stopwatch()
        self.controller.update(time, period)
        self.statistic.add(self._stopwatch() - begin, None if last is None else period)

    def deactivate(self, resources: ResourceManager, time: int) -> None:
        """Active → inactive: actuators safe, claims and offers taken back, inputs closed."""
        with self.transition(LifecycleState.INACTIVE):
            self._deactivate(resources, time)

    def _deactivate(self, resources: ResourceManager, time: int) -> None:
        for port in self._inputs:
            port.close()
        try:
            self.controller.deactivate(time)
        finally:
            resources.release(self.name)
            resources.withdraw(self.name)
            self.state = LifecycleState.INACTIVE
            self._set_chained_mode(False)

    def _set_chained_mode(self, chained: bool) -> None:
        if self.controller.is_chained != chained:
            self.controller.set_chained_mode(chained)
            self.controller.is_chained = chained  # also where an override forgets to

    def cleanup(self) -> None:
        """Inactive → unconfigured."""
        with self.transition(LifecycleState.UNCONFIGURED):
            self.unsettle()

    def finalize(self) -> None:
        """Any state but active → finalized, the last one."""
        with self.transition(LifecycleState.FINALIZED):
            self.state = LifecycleState.FINALIZED

    def unsettle(self) -> None:
        """Unconfigured again, as part of another transition."""
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands = self.required_states = ()
        self.references = self.exported_states = ()
        self.ends = ChainInterfaces()
        self._wishes, self._inputs = (NO_INTERFACES, NO_INTERFACES), ()
        self.controller.cleanup()

    def reset(self, time: int) -> None:
        """Time went back to ``time``, ns: what an inactive one remembers is wrong as well."""
        self._last_update = None
        if self.is_configured:
            self.controller.reset(time)

    def set_clock(self, time: int) -> None:
        """The clock was set to ``time``, ns."""
        self._last_update = None
        if self.is_configured:
            self.controller.set_clock(time)

    def _check_unique(self, kind: str, names: Sequence[str]) -> None:
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ControllerError(
                f"The {kind} interfaces of the controller '{self.name}' are not unique. Please "
                f"make sure that the {kind} interfaces are unique : '{' '.join(twice)}'."
            )

    def _check_offer(self, kind: str, names: Sequence[str], available: Collection[str]) -> None:
        """What it offers must be its own, once, and nobody else's."""
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
