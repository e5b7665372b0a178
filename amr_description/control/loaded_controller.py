# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One controller inside the manager: its state, its interfaces and when it is due."""

from collections.abc import Sequence
from typing import Any

from amr_description.control.contracts import Controller, Log, Severity
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import ControllerError


class LoadedController:
    """
    A controller with its lifecycle; the manager is the only one to move it.

    ``stride``: it is updated at every so manieth tick of the manager.
    """

    def __init__(self, controller: Controller, type_name: str, stride: int) -> None:
        self.controller = controller
        self.type = type_name
        self.stride = stride
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands: tuple[str, ...] = ()
        self.required_states: tuple[str, ...] = ()
        self.is_busy = False
        """True while its ``configure`` may be running, on whatever thread."""
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

    def settle(self, resources: ResourceManager) -> None:
        """Configured → inactive. Raises ControllerError; it is then cleaned up again."""
        try:
            self.required_commands, self.required_states = self.wanted(resources)
            self._check_unique('command', self.required_commands)
            self._check_unique('state', self.required_states)
        except Exception:
            self.cleanup()
            raise
        self.state = LifecycleState.INACTIVE

    def wanted(self, resources: ResourceManager) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """
        Ask which command and which state interfaces it wants: 'all' depends on the hardware that
        is there.
        """
        commands = self.controller.command_interfaces()
        states = self.controller.state_interfaces()
        return (
            resources.names(commands, resources.available_commands()),
            resources.names(states, resources.available_states()),
        )

    def activate(self, resources: ResourceManager, time: int) -> None:
        """Inactive → active. Raises; all claims are then given back, and it stays inactive."""
        try:
            self.required_commands, self.required_states = self.wanted(resources)
            commands = resources.claim(self.name, self.required_commands)
            states = resources.lend_states(self.required_states)
            self.controller.activate(commands, states, time)
        except Exception:
            resources.release(self.name)
            raise
        self._last_update = None
        self._ticks = 0
        for port in self.controller.inputs():
            port.open()
        self.state = LifecycleState.ACTIVE

    def update(self, time: int, nominal_period: int) -> None:
        """Update it if it is due at this tick; ``nominal_period`` of the manager, ns."""
        is_due = self._ticks % self.stride == 0
        self._ticks += 1
        if not is_due:
            return
        last, self._last_update = self._last_update, time
        period = nominal_period * self.stride if last is None else time - last
        self.controller.update(time, period)

    def deactivate(self, resources: ResourceManager, time: int) -> None:
        """Active → inactive: actuators safe, claims given back, inputs closed."""
        for port in self.controller.inputs():
            port.close()
        try:
            self.controller.deactivate(time)
        finally:
            resources.release(self.name)
            self.state = LifecycleState.INACTIVE

    def cleanup(self) -> None:
        """Inactive → unconfigured."""
        self.state = LifecycleState.UNCONFIGURED
        self.required_commands = self.required_states = ()
        self.controller.cleanup()

    def reset(self, time: int) -> None:
        """Time went back to ``time``, ns: what an inactive one remembers is wrong as well."""
        self._last_update = None
        if self.state in (LifecycleState.INACTIVE, LifecycleState.ACTIVE):
            self.controller.reset(time)

    def _check_unique(self, kind: str, names: Sequence[str]) -> None:
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ControllerError(
                f"The {kind} interfaces of the controller '{self.name}' are not unique. Please "
                f'make sure that the {kind} interfaces are unique : \'{" ".join(twice)}\'.'
            )


class Configuring:
    """
    The configuration of one controller, under way.

    The owner begins it and finishes it (:class:`ControllerManager`); in between any one thread
    calls :meth:`run`, once, while the loop goes on: a long configure stops no robot.
    """

    def __init__(self, loaded: LoadedController) -> None:
        self.loaded = loaded
        self.failure: Exception | None = ControllerError('it was not configured')

    def run(self, parameters: Any) -> None:
        """
        Call the controller's ``configure``; what it raises is kept for the finish.

        A controller that is being configured is touched by nobody else.
        """
        try:
            self.loaded.controller.configure(parameters)
        except Exception as error:  # a foreign controller may raise anything
            self.failure = error
        else:
            self.failure = None


def stride_of(controller: Controller, manager_rate: int, log: Log) -> int:
    """
    Return the ticks of the manager (``manager_rate``, Hz) for each update of the controller.

    What cannot be had exactly is warned of. Raises ControllerError: its rate is not positive.
    """
    name, rate = controller.context.name, controller.context.update_rate
    if rate <= 0:
        raise ControllerError(
            f"The update rate of controller '{name}' must be above 0 Hz, found {rate}"
        )
    if rate > manager_rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is above that of the controller "
            f'manager, {manager_rate} Hz, and is set to it',
        )
        return 1
    stride = (2 * manager_rate + rate) // (2 * rate)  # half away from zero, as C++ rounds
    if manager_rate % rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is not achievable with a "
            f'controller manager at {manager_rate} Hz; it runs at {manager_rate / stride:g} Hz',
        )
    return stride
