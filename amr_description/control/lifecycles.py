# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The way of a controller from loaded to inactive, and back to unloaded."""

from collections.abc import Callable, Iterable
from typing import Any

from amr_description.control.configuring import Configuring
from amr_description.control.contracts import Controller, Log
from amr_description.control.controller_list import ControllerList
from amr_description.control.faults import Faults
from amr_description.control.foreign_errors import describe
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController, look_away, Watch
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.snapshots import ManagerSnapshot
from amr_description.control.switch_execution import SwitchExecution
from amr_description.control.taking_snapshots import take_snapshot
from amr_description.control.update_stride import stride_of
from amr_description.errors import ControllerError


class ControllerLifecycles:
    """Loads, configures, cleans up and unloads; who is active is for the manager to say."""

    def __init__(self, resources: ResourceManager, update_rate: int, log: Log) -> None:
        """``update_rate``: of the manager, Hz."""
        self.resources = resources
        self.update_rate = update_rate
        self._log = log
        self._controllers = ControllerList()
        self._execution = SwitchExecution(self._controllers, resources, log)
        self._faults = Faults(self._controllers, resources, self._execution, log)
        self.on_change: Callable[[ManagerSnapshot], None] = lambda _: None
        """Called with every new snapshot."""
        self.snapshot = ManagerSnapshot()
        self.refresh()

    def load(
        self,
        controller: Controller,
        type_name: str,
        fallbacks: Iterable[str] = (),
        watch: Watch = look_away,
    ) -> None:
        """
        Take a controller that was made elsewhere.

        ``fallbacks``: the controllers to start when it fails. ``watch``: is told of every
        transition. Raises ControllerError: name, rate or fallbacks.
        """
        name = controller.context.name
        if name in self._controllers:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        fallbacks = tuple(fallbacks)
        if name in fallbacks:
            raise ControllerError(
                f"Controller '{name}' cannot be a fallback controller for itself."
            )
        stride = stride_of(controller, self.update_rate, self._log)
        stopwatch = self.resources.stopwatch
        self._controllers.add(
            LoadedController(controller, type_name, stride, fallbacks, watch, stopwatch)
        )
        self.refresh()

    def configure(self, name: str, parameters: Any) -> Controller:
        """Configure, from inactive again; return the controller. Raises ControllerError."""
        configuring = self.begin_configure(name)
        configuring.run(parameters)
        return self.finish_configure(configuring)

    def begin_configure(self, name: str) -> Configuring:
        """
        Check, clean up what is inactive, and set the controller aside. Raises ControllerError.

        Until :meth:`finish_configure` nothing else can be asked of it, so that any thread may
        ``run`` what this returns.
        """
        loaded = self._find(name, 'configure')
        if loaded.state not in (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE):
            raise ControllerError(
                f"Controller '{name}' can not be configured from '{loaded.state.label}' state."
            )
        self._clean_up(loaded)
        loaded.is_busy = True
        self.refresh()
        return Configuring(loaded)

    def finish_configure(self, configuring: Configuring) -> Controller:
        """
        Take the controller in again: inactive, or unconfigured where its ``configure`` raised.

        Raises ControllerError.
        """
        loaded = configuring.loaded
        loaded.is_busy = False
        try:
            with configuring.transition:
                if configuring.failure is not None:
                    raise configuring.failure
                self._settle(loaded)
        except Exception as error:  # a foreign controller may raise anything
            raise ControllerError(
                f"Failed to configure controller '{loaded.name}': {describe(error)}"
            ) from error
        finally:
            self.refresh()
        return loaded.controller

    def _settle(self, loaded: LoadedController) -> None:
        loaded.settle(self.resources)
        try:
            self._controllers.link()
        except ControllerError:
            loaded.unsettle()
            raise

    def cleanup(self, name: str) -> None:
        """Bring an inactive controller back to unconfigured. Raises ControllerError."""
        loaded = self._find(name, 'cleanup')
        if loaded.state not in (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE):
            raise ControllerError(
                f"Controller '{name}' can not be cleaned-up from '{loaded.state.label}' state."
            )
        self._clean_up(loaded)
        self.refresh()

    def unload(self, name: str) -> None:
        """Remove a controller that is not active. Raises ControllerError."""
        loaded = self._find(name, 'unload')
        if loaded.is_active:
            raise ControllerError(
                f"Could not unload controller with name '{name}' because it is still active"
            )
        self._clean_up(loaded)
        loaded.finalize()
        self._controllers.remove(name)
        self.refresh()

    def _clean_up(self, controller: LoadedController) -> None:
        """Inactive → unconfigured, which it is whatever its ``cleanup`` raises."""
        if controller.state is LifecycleState.INACTIVE:
            self._faults.survives('cleaning up', controller, controller.cleanup)
            self._controllers.link()

    # --- helpers ------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Take a new snapshot, after anything has changed."""
        self.snapshot = take_snapshot(self._controllers, self.resources, self.update_rate)
        self.on_change(self.snapshot)

    @property
    def loaded(self) -> tuple[LoadedController, ...]:
        """The controllers in the order of their updates; on the owner's thread."""
        return tuple(self._controllers)

    def _find(self, name: str, verb: str) -> LoadedController:
        loaded = self._controllers.get(name)
        if loaded is None:
            raise ControllerError(
                f"Could not {verb} controller with name '{name}' because no controller with this "
                'name exists'
            )
        if loaded.is_busy:
            raise ControllerError(
                f"Could not {verb} controller with name '{name}' because it is being configured; "
                'ask again when that has ended'
            )
        return loaded
