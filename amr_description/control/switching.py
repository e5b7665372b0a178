# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether controllers may be switched as asked: the checks of ``switch_controller``, word for word.

Nothing is changed here; :mod:`amr_description.control.controller_manager` carries the plan out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import enum

from amr_description.control.contracts import Log, Severity
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import ControllerError

NOTHING_TO_SWITCH = (
    'After checking the controllers, no controllers need to be activated or deactivated.'
)


class Strictness(enum.IntEnum):
    """The constants of ``controller_manager_msgs/srv/SwitchController``."""

    BEST_EFFORT = 1
    STRICT = 2
    AUTO = 3
    FORCE_AUTO = 4


@dataclass(frozen=True, slots=True)
class SwitchPlan:
    """What is to be done, in this order: first deactivate, then activate."""

    deactivate: tuple[LoadedController, ...]
    activate: tuple[LoadedController, ...]


class Switching:
    """Checks one request against the controllers and interfaces there are."""

    def __init__(
        self,
        controllers: Mapping[str, LoadedController],
        resources: ResourceManager,
        strictness: Strictness,
        log: Log,
    ) -> None:
        self._controllers = controllers
        self._resources = resources
        self._strict = strictness is Strictness.STRICT
        self._log = log

    def plan(self, activate: Sequence[str], deactivate: Sequence[str]) -> SwitchPlan:
        """Return what can be done. Raises ControllerError with the message of the response."""
        leaving = self._known(deactivate, 'deactivate')
        entering = self._known(activate, 'activate')
        leaving = [c for c in leaving if self._passes(self._objection_to_deactivation(c))]
        restarting = {c.name for c in leaving}
        entering = [
            c
            for c in entering
            if c.name in restarting or self._passes(self._objection_to_activation(c))
        ]
        self._check_interfaces(entering, leaving)
        return SwitchPlan(tuple(leaving), tuple(entering))

    def _known(self, names: Sequence[str], verb: str) -> list[LoadedController]:
        known = []
        for name in dict.fromkeys(names):
            if name in self._controllers:
                known.append(self._controllers[name])
                continue
            message = (
                f"Could not {verb} controller with name '{name}' because no controller with this "
                'name exists'
            )
            self._log(Severity.WARN, message)
            if self._strict:
                self._log(
                    Severity.ERROR, "Aborting, no controller is switched! ('STRICT' switch)"
                )
                raise ControllerError(message)
        if names and not known:
            raise ControllerError(
                f'None of the controllers to {verb} exists: [ {" ".join(names)} ]. Loaded: '
                f'[ {" ".join(sorted(self._controllers))} ]'
            )
        return known

    def _passes(self, objection: str) -> bool:
        if not objection:
            return True
        if self._strict:
            self._log(Severity.ERROR, objection)
            raise ControllerError(objection)
        self._log(Severity.WARN, objection)
        return False

    @staticmethod
    def _objection_to_deactivation(controller: LoadedController) -> str:
        if controller.is_active:
            return ''
        return (
            f"Controller with name '{controller.name}' can not be deactivated since it is not "
            'active.'
        )

    @staticmethod
    def _objection_to_activation(controller: LoadedController) -> str:
        name, state = controller.name, controller.state
        if controller.is_busy:
            return (
                f"Controller with name '{name}' is being configured; it can be activated when "
                'that has ended.'
            )
        if state is LifecycleState.INACTIVE:
            return ''
        if state is LifecycleState.ACTIVE:
            return f"Controller with name '{name}' is already active."
        if state is LifecycleState.UNCONFIGURED:
            return (
                f"Controller with name '{name}' is in 'unconfigured' state. The controller needs "
                "to be configured to be in 'inactive' state before it can be checked and "
                'activated.'
            )
        return f"Controller with name '{name}' is not in 'inactive' state."

    def _check_interfaces(
        self, entering: Sequence[LoadedController], leaving: Sequence[LoadedController]
    ) -> None:
        """Every interface must be there, and free or freed by this very request."""
        commands = self._resources.available_commands()
        states = self._resources.available_states()
        freed = {controller.name for controller in leaving}
        promised: set[str] = set()
        for controller in entering:
            wanted_commands, wanted_states = controller.wanted(self._resources)
            refusal = f"Unable to activate controller '{controller.name}' since the "
            for name in wanted_commands:
                holder = self._resources.claims.get(name)
                if name not in commands:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' is not available."
                    )
                if holder is not None and holder not in freed:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' is currently claimed by another "
                        'controller.'
                    )
                if name in promised:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' will be used by another controller "
                        'that is being activated.'
                    )
            promised.update(wanted_commands)
            for name in wanted_states:
                if name not in states:
                    raise ControllerError(f"{refusal}state interface '{name}' is not available.")
