# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Deactivates controllers that fail, or whose hardware fails, and activates their fallbacks.

A controller is deactivated together with its chain: with those that need it, and with those that
it commands, which would be left without commands.
"""

from collections.abc import Callable, Collection, Sequence
from typing import Any

from amr_description.control.controller_list import ControllerList
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import names_of, Strictness, SwitchExecution, SwitchPlanner
from amr_description.errors import AmrError, ControllerError
from amr_description.log import Log, Severity
from amr_description.plugin_errors import error_line, log_traceback


class FailureHandler:
    """Handles failures, on the control thread."""

    def __init__(
        self,
        controllers: ControllerList,
        resources: ResourceManager,
        execution: SwitchExecution,
        log: Log,
    ) -> None:
        self._controllers = controllers
        self._resources = resources
        self._execution = execution
        self._log = log

    def call_guarded(
        self, doing: str, controller: LoadedController, method: Callable[..., None], *args: Any
    ) -> bool:
        """
        Call a method of a controller, and log whatever it raises.

        Args:
            doing: what the call is for, for the log: ``updating``.
            controller: the one that is called.
            method: its method.
            args: of the method.

        Returns:
            False if it raised.
        """
        try:
            method(*args)
        except Exception as error:
            self.log_failure(doing, controller, error)
            return False
        return True

    def log_failure(self, doing: str, controller: LoadedController, error: Exception) -> None:
        """Log what a controller has raised; ``doing``: as above."""
        if isinstance(error, AmrError):
            self._log(Severity.ERROR, f"Controller '{controller.name}': {error}")
            return
        self._log(
            Severity.ERROR,
            f'Caught exception of type : {type(error).__name__} while {doing} controller '
            f"'{controller.name}': {error_line(error)}",
        )
        log_traceback(self._log, error)

    def switch_to_fallbacks(
        self, failed: Sequence[LoadedController], doing: str, time: int
    ) -> None:
        """
        Deactivate the chains of controllers that failed, and activate the fallbacks.

        Controllers that have claimed command interfaces of a fallback are deactivated too, with
        their chains.

        Args:
            failed: the controllers.
            doing: what failed, for the log: ``update``.
            time: present time, ns.
        """
        down = self._controllers.active_chains_of(failed)
        if not down:
            return
        self._log(
            Severity.ERROR,
            f'Deactivating controllers : [ {names_of(down)} ] as their {doing} resulted in an '
            'error!',
        )
        excluded = {controller.name for controller in failed}
        fallbacks = dict.fromkeys(n for c in failed for n in c.fallbacks if n not in excluded)
        claiming = [c for c in self._claiming_commands_of(fallbacks) if c not in down]
        if claiming:
            self._log(
                Severity.ERROR,
                f'Deactivating controllers : [ {names_of(claiming)} ] using the command '
                'interfaces needed for the fallback controllers to activate',
            )
        self._execution.force_deactivate([*down, *claiming], time)
        if fallbacks:
            self._activate(fallbacks, time)

    def deactivate_orphans(self, components: Sequence[str], time: int) -> None:
        """Deactivate the controllers that used interfaces of these components, now gone."""
        # A command and a state often have the same name: look each kind up by itself.
        known = self._resources.components
        lost = [known[name] for name in components if name in known]
        commands = {name for each in lost for name in each.commands}
        commands -= self._resources.available_commands().keys()
        states = {name for each in lost for name in each.states}
        states -= self._resources.available_states().keys()
        orphans = self._controllers.active_chains_of(
            controller
            for controller in self._controllers.active
            if commands.intersection(controller.required_commands)
            or states.intersection(controller.required_states)
        )
        if orphans:
            self._log(
                Severity.ERROR,
                f'Deactivating controllers : [ {names_of(orphans)} ] as the hardware components '
                f'[ {" ".join(components)} ] are no longer active',
            )
        self._execution.force_deactivate(orphans, time)

    def _claiming_commands_of(self, fallbacks: Collection[str]) -> list[LoadedController]:
        """Return the active chains that have claimed command interfaces of the fallbacks."""
        commands = self._resources.available_commands()
        needed = {
            name
            for each in self._controllers
            if each.name in fallbacks and each.is_configured
            for name in each.wanted(commands, ())[0]
        }
        return self._controllers.active_chains_of(
            each
            for each in self._controllers.active
            if each.name not in fallbacks and needed.intersection(each.required_commands)
        )

    def _activate(self, fallbacks: Collection[str], time: int) -> None:
        self._log(Severity.ERROR, f'Activating fallback controllers : [ {" ".join(fallbacks)} ]')
        active = {each.name for each in self._controllers.active}
        inactive = [name for name in fallbacks if name not in active]
        planner = SwitchPlanner(self._controllers, self._resources, Strictness.STRICT, self._log)
        try:
            self._execution.carry_out(planner.plan(inactive, ()), Strictness.STRICT, time)
        except ControllerError as error:
            self._log(Severity.ERROR, f'Could not activate the fallback controllers: {error}')
