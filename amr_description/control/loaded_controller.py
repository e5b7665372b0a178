# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One controller inside the manager: its state, its interfaces and when it is due."""

from typing import Any

from amr_description.control.contracts import Controller
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager


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

    def configure(self, parameters: Any) -> None:
        """Unconfigured → inactive. Raises what the controller raises; it stays unconfigured."""
        self.controller.configure(parameters)
        self.state = LifecycleState.INACTIVE

    def resolve(self, resources: ResourceManager) -> None:
        """Ask which interfaces it wants now: 'all' depends on the hardware that is there."""
        commands = self.controller.command_interfaces()
        states = self.controller.state_interfaces()
        self.required_commands = resources.names(commands, resources.available_commands())
        self.required_states = resources.names(states, resources.available_states())

    def activate(self, resources: ResourceManager, time: int) -> None:
        """Inactive → active. Raises; all claims are then given back, and it stays inactive."""
        try:
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
        """Time went back to ``time``, ns."""
        self._last_update = None
        if self.is_active:
            self.controller.reset(time)
