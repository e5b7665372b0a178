# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Carrying out a switch that :mod:`amr_description.control.switching` has planned.

A controller or a component of a stranger may raise anything at any point; what it raises is
logged, and the others go on.
"""

from collections.abc import Iterable, Sequence

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.foreign_errors import describe, log_traceback
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness, SwitchPlan
from amr_description.errors import ControllerError, HardwareError


class SwitchExecution:
    """Moves controllers between inactive and active, and tells the hardware."""

    def __init__(self, controllers: ControllerList, resources: ResourceManager, log: Log) -> None:
        self._controllers = controllers
        self._resources = resources
        self._log = log

    def carry_out(self, plan: SwitchPlan, strictness: Strictness, time: int) -> None:
        """
        Deactivate, then activate.

        Raises ControllerError when the hardware refuses (nothing has then changed), when it then
        fails all the same (what was to be deactivated is), and when a controller cannot be
        activated (it is unconfigured then, if it raised itself): STRICT then deactivates the
        plan's others again. Those that the request did not name, and which only were to change
        their mode, go on.
        """
        stop = [name for c in plan.deactivate for name in c.required_commands]
        self._prepare(plan.start, stop)
        self._deactivate(plan.deactivate, time)
        try:
            self._perform(plan.start, stop)
        except ControllerError:
            self._mend(time)
            raise
        failed = [c for c in plan.activate if not self._activate(c, time, c.name in plan.chained)]
        if not failed:
            return
        if strictness is Strictness.STRICT:
            named = (c for c in reversed(plan.activate) if c.name not in plan.restarted)
            self.drop([c for c in named if c.is_active], time)
        self._release_commands(failed)
        self._mend(time)
        self._clean_up(failed)
        raise ControllerError(
            'Failed switching controllers.... '
            f'Unable to activate controllers: [ {names_of(failed)} ]'
        )

    def _clean_up(self, controllers: Iterable[LoadedController]) -> None:
        """Bring what raised in its own ``activate`` to unconfigured, as ros2_control does."""
        for controller in controllers:
            if not controller.has_failed:
                continue
            try:
                controller.cleanup()
            except Exception as error:  # it is unconfigured all the same
                self._log(
                    Severity.ERROR,
                    f"Failed to clean '{controller.name}' up: {describe(error)}",
                )
                log_traceback(self._log, error)
        self._controllers.link()

    def drop(self, controllers: Sequence[LoadedController], time: int) -> None:
        """Deactivate controllers that cannot go on; nobody is asked."""
        if controllers:
            self._deactivate(controllers, time)
            self._release_commands(controllers)

    def _mend(self, time: int) -> None:
        """
        Leave, after a failure, no controller active without those that it needs, and none in
        chained mode without one that commands it.
        """
        for c in self._controllers.activation_order(self._controllers.active):
            if not all(needed.is_active for needed in self._controllers.needed(c)):
                self.drop([c], time)
        for c in self._controllers.active:
            is_commanded = any(each.is_active for each in self._controllers.commanding(c))
            if c.controller.is_chained and not is_commanded:
                self._deactivate([c], time)
                if not self._activate(c, time, chained=False):
                    self._release_commands([c])
                    self._mend(time)
                    return

    def _prepare(self, start: Sequence[str], stop: Sequence[str]) -> None:
        try:
            self._resources.prepare_command_mode_switch(start, stop)
        except HardwareError as error:
            raise ControllerError(
                'Could not switch controllers since prepare command mode switch was rejected. '
                f'{error}'
            ) from error

    def _perform(self, start: Sequence[str], stop: Sequence[str]) -> None:
        try:
            self._resources.perform_command_mode_switch(start, stop)
        except HardwareError as error:
            raise ControllerError(f'Error while performing mode switch. {error}') from error

    def _release_commands(self, controllers: Iterable[LoadedController]) -> None:
        """Tell the hardware that nobody commands these any more."""
        stop = [name for c in controllers for name in c.required_commands]
        try:
            self._resources.perform_command_mode_switch((), stop)
        except HardwareError as error:
            self._log(Severity.ERROR, str(error))

    def _activate(self, controller: LoadedController, time: int, chained: bool) -> bool:
        try:
            controller.activate(self._resources, time, chained=chained)
        except Exception as error:
            self._log(
                Severity.ERROR, f"Failed to activate '{controller.name}': {describe(error)}"
            )
            log_traceback(self._log, error)
            return False
        return True

    def _deactivate(self, controllers: Iterable[LoadedController], time: int) -> None:
        for controller in controllers:
            try:
                controller.deactivate(self._resources, time)
            except Exception as error:  # it is inactive all the same, and its claims are free
                self._log(
                    Severity.ERROR,
                    f"Failed to deactivate '{controller.name}' cleanly: {describe(error)}",
                )
                log_traceback(self._log, error)


def names_of(controllers: Iterable[LoadedController]) -> str:
    """Return the names as the messages of ros2_control list them."""
    return ' '.join(controller.name for controller in controllers)
