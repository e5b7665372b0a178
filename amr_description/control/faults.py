# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of controllers that fail, or whose hardware does.

A controller goes down together with its chain: with those that need it, and with those that it
commands, which would otherwise obey nobody.
"""

from collections.abc import Callable, Sequence

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.foreign_errors import log_traceback, one_line
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switch_execution import names_of, SwitchExecution
from amr_description.control.switching import Strictness, Switching
from amr_description.errors import AmrError, ControllerError


class Faults:
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

    def survives(
        self, doing: str, controller: LoadedController, method: Callable[..., None], *args: int
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

    def replace(self, failed: Sequence[LoadedController], doing: str, time: int) -> None:
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
        fallbacks = self._fallbacks_of(failed)
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

    def abandon(self, components: Sequence[str], time: int) -> None:
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

    def _fallbacks_of(self, failed: Sequence[LoadedController]) -> list[LoadedController]:
        """The fallbacks of those that failed that are there and that have not failed as well."""
        names = dict.fromkeys(name for controller in failed for name in controller.fallbacks)
        found = [self._controllers.get(name) for name in names]
        return [each for each in found if each is not None and each not in failed]

    def _in_the_way_of(self, fallbacks: Sequence[LoadedController]) -> list[LoadedController]:
        needed = {name for each in fallbacks for name in each.ends.commands}
        return self._controllers.active_chains_of(
            controller
            for controller in self._controllers.active
            if controller not in fallbacks and needed.intersection(controller.required_commands)
        )

    def _start(self, fallbacks: Sequence[LoadedController], time: int) -> None:
        self._log(Severity.ERROR, f'Activating fallback controllers : [ {names_of(fallbacks)} ]')
        starting = [each.name for each in fallbacks if not each.is_active]
        switching = Switching(self._controllers, self._resources, Strictness.STRICT, self._log)
        try:
            self._execution.carry_out(switching.plan(starting, ()), Strictness.STRICT, time)
        except ControllerError as error:
            self._log(Severity.ERROR, str(error))
