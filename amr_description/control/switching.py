# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
From the request of ``switch_controller`` to a plan of what is done.

Nothing is changed here; :mod:`amr_description.control.switch_execution` carries the plan out.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import enum

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switch_checks import SwitchChecks
from amr_description.control.switch_request import SwitchRequest
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
    chained: frozenset[str]
    """Those to activate whose references somebody commands."""
    restarted: frozenset[str]
    """Those in both lists only because that changes; the request did not name them."""
    start: tuple[str, ...]
    """The command interfaces that will be claimed."""


class Switching:
    """Plans one switch."""

    def __init__(
        self,
        controllers: ControllerList,
        resources: ResourceManager,
        strictness: Strictness,
        log: Log,
    ) -> None:
        self._controllers = controllers
        self._request = SwitchRequest(controllers)
        self._checks = SwitchChecks(self._request, resources)
        self._strict = strictness is Strictness.STRICT
        self._log = log

    def plan(self, activate: Sequence[str], deactivate: Sequence[str]) -> SwitchPlan:
        """Return what can be done. Raises ControllerError with the message of the response."""
        request = self._request
        request.leaving = self._known(deactivate, 'deactivate')
        request.entering = self._known(activate, 'activate')
        self._drop_what_may_not_be()
        restarted = request.restart_what_changes_mode()
        ordered = self._controllers.activation_order
        return SwitchPlan(
            deactivate=tuple(reversed(ordered(request.leaving))),
            activate=tuple(ordered(request.entering)),
            chained=frozenset(c.name for c in request.entering if request.will_be_chained(c)),
            restarted=restarted,
            start=tuple(self._checks.check_interfaces()),
        )

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
                abort = "Aborting, no controller is switched! ('STRICT' switch)"
                self._log(Severity.ERROR, abort)
                raise ControllerError(f'{abort} {message}')
        if names and not known:
            loaded = sorted(each.name for each in self._controllers)
            raise ControllerError(
                f'None of the controllers to {verb} exists: [ {" ".join(names)} ]. Loaded: '
                f'[ {" ".join(loaded)} ]'
            )
        return known

    def _drop_what_may_not_be(self) -> None:
        """Until nothing is objected to: what goes may have been the ground of something else."""
        is_settled = False
        while not is_settled:
            is_settled = not (
                self._drop(self._request.leaving, self._checks.objection_to_deactivation)
                or self._drop(self._request.entering, self._checks.objection_to_activation)
            )

    def _drop(
        self, asked: list[LoadedController], objection_to: Callable[[LoadedController], str]
    ) -> bool:
        """Take out what is objected to; tell whether anything was. Raises where that is strict."""
        before = len(asked)
        for controller in list(asked):
            objection = objection_to(controller)
            if not objection:
                continue
            if self._strict:
                self._log(Severity.ERROR, objection)
                raise ControllerError(objection)
            self._log(Severity.WARN, objection)
            asked.remove(controller)
        return len(asked) < before
