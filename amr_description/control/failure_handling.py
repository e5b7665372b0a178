# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of controllers that fail, or whose hardware does.

A controller goes down together with its chain: with those that need it, and with those that it
commands, which would otherwise obey nobody.
"""

from collections.abc import Callable, Collection, Sequence
from typing import Any

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.plugin_errors import log_traceback, one_line
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import names_of, Strictness, SwitchExecution, Switching
from amr_description.errors import AmrError, ControllerError


class FailureHandler:
    """Takes controllers down, and starts their fallbacks."""

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
        """Call a controller; the others must go on whatever it raises, which is logged."""
        try:
            method(*args)
        except AmrError as error:
            self._log(Severity.ERROR, f"Controller '{controller.name}': {error}")
        except Exception as error:
            self._log(
                Severity.ERROR,
                f'Caught exception of type : {type(error).__name__} while {doing} controller '
                f"'{controller.name}': {one_line(error)}",
            )
            log_traceback(self._log, error)
        else:
            return True
        return False

    def switch_to_fallbacks(
        self, failed: Sequence[LoadedController], doing: str, time: int
    ) -> None:
        """
        Deactivate the chains of those that failed while ``doing`` something; start the fallbacks.

        Controllers that hold command interfaces which a fallback needs make way, with their
        chains.
        """
        down = self._controllers.active_chains_of(failed)
        if not down:
            return
        self._log(
            Severity.ERROR,
            f'Deactivating controllers : [ {names_of(down)} ] as their {doing} resulted in an '
            'error!',
        )
        gone = {controller.name for controller in failed}
        fallbacks = dict.fromkeys(name for c in failed for name in c.fallbacks if name not in gone)
        in_the_way = [c for c in self._in_the_way_of(fallbacks) if c not in down]
        if in_the_way:
            self._log(
                Severity.ERROR,
                f'Deactivating controllers : [ {names_of(in_the_way)} ] using the command '
                'interfaces needed for the fallback controllers to activate',
            )
        self._execution.drop([*down, *in_the_way], time)
        if fallbacks:
            self._start(fallbacks, time)

    def deactivate_orphans(self, components: Sequence[str], time: int) -> None:
        """Deactivate the controllers whose interfaces have gone with these components."""
        # A command and a state often have the same name: each kind is looked up by itself.
        known = self._resources.components
        owned = [known[name] for name in components if name in known]
        commands = {name for each in owned for name in each.commands}
        commands -= self._resources.available_commands().keys()
        states = {name for each in owned for name in each.states}
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
        self._execution.drop(orphans, time)

    def _in_the_way_of(self, fallbacks: Collection[str]) -> list[LoadedController]:
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

    def _start(self, fallbacks: Collection[str], time: int) -> None:
        self._log(Severity.ERROR, f'Activating fallback controllers : [ {" ".join(fallbacks)} ]')
        active = {each.name for each in self._controllers.active}
        starting = [name for name in fallbacks if name not in active]
        switching = Switching(self._controllers, self._resources, Strictness.STRICT, self._log)
        try:
            self._execution.carry_out(switching.plan(starting, ()), Strictness.STRICT, time)
        except ControllerError as error:
            self._log(Severity.ERROR, f'Could not activate the fallback controllers: {error}')
