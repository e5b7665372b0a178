# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
From the request of ``switch_controller`` to a plan of what is done.

Nothing is changed here; :mod:`amr_description.control.switching` carries the plan out.

The checks of ``switch_controller``, word for word as scripts grep for them.

What one switch is about: who comes, who goes, and which mode that means for the others.

Carrying out a switch that :mod:`amr_description.control.switching` has planned.

A controller or a component of a stranger may raise anything at any point; what it raises is
logged, and the others go on.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
import enum

from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_list import ControllerList
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.plugin_errors import describe, log_traceback
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import ControllerError, HardwareError


@dataclass(slots=True)
class SwitchRequest:
    """The controllers there are, and those of them to activate and to deactivate, as asked."""

    controllers: ControllerList
    entering: list[LoadedController] = field(default_factory=list)
    leaving: list[LoadedController] = field(default_factory=list)

    def will_be_active(self, controller: LoadedController) -> bool:
        """Tell whether it stays active or becomes it."""
        stays = controller.is_active and controller not in self.leaving
        return stays or controller in self.entering

    def will_be_chained(self, controller: LoadedController) -> bool:
        """Tell whether somebody will command it."""
        return any(map(self.will_be_active, self.controllers.commanding(controller)))

    def add_mode_changes(self) -> frozenset[str]:
        """
        Add to both lists whoever stays active but is commanded from now on, or no longer.

        A controller changes its mode only while it is inactive. Returns their names.
        """
        changing = [
            each
            for each in self.controllers.active
            if each not in self.leaving
            and each.controller.is_chained != self.will_be_chained(each)
        ]
        self.leaving += changing
        self.entering += changing
        return frozenset(each.name for each in changing)


class SwitchChecks:
    """What speaks against a request, as it stands at the moment of each question."""

    def __init__(self, request: SwitchRequest, resources: ResourceManager) -> None:
        self._request = request
        self._resources = resources

    def objection_to_deactivation(self, controller: LoadedController) -> str:
        """Say why it cannot be deactivated, or nothing."""
        if not controller.is_active:
            return (
                f"Controller with name '{controller.name}' can not be deactivated since it is not "
                'active.'
            )
        refusal = f"Unable to deactivate controller with name '{controller.name}' because "
        for preceding in self._request.controllers.needing(controller):
            if preceding.is_active and preceding not in self._request.leaving:
                return (
                    f"{refusal}preceding controller with name '{preceding.name}' is currently "
                    'active and will not be deactivated.'
                )
            comes_up = preceding in self._request.entering and not preceding.is_active
            if comes_up and controller not in self._request.entering:
                return (
                    f"{refusal}preceding controller with name '{preceding.name}' is inactive and "
                    'will be activated.'
                )
        return ''

    def objection_to_activation(self, controller: LoadedController) -> str:
        """Say why it cannot be activated, or nothing; interfaces apart."""
        return (
            self._objection_to_state(controller)
            or self._objection_by_following(controller)
            or self._objection_by_fallbacks(controller)
        )

    def _objection_to_state(self, controller: LoadedController) -> str:
        name, state = controller.name, controller.state
        if controller.is_busy:
            return (
                f"Controller with name '{name}' is being configured; it can be activated when "
                'that has ended.'
            )
        if state is LifecycleState.INACTIVE or controller in self._request.leaving:
            return ''
        if state is LifecycleState.ACTIVE:
            return f"Controller with name '{name}' is already active."
        if state is LifecycleState.UNCONFIGURED:
            condition = "in 'unconfigured' state. The controller needs to be configured to be"
        else:
            condition = "not in 'inactive' state. The controller needs to be"
        return (
            f"Controller with name '{name}' is {condition} in 'inactive' state before it can be "
            'checked and activated.'
        )

    def _objection_by_following(self, controller: LoadedController) -> str:
        refusal = f"Unable to activate controller with name '{controller.name}' because "
        for following in self._request.controllers.needed(controller):
            if following in self._request.entering:
                continue
            if not following.is_active:
                return (
                    f"{refusal}following controller with name '{following.name}' is not active "
                    'and will not be activated.'
                )
            if following in self._request.leaving:
                return (
                    f"{refusal}following controller with name '{following.name}' is currently "
                    'active but will be deactivated.'
                )
        return ''

    def _objection_by_fallbacks(self, controller: LoadedController) -> str:
        """A fallback that could not start now would be none."""
        refusal = f"Controller with name '{controller.name}' cannot be activated, as "
        fallbacks = [self._request.controllers.get(name) for name in controller.fallbacks]
        for name, fallback in zip(controller.fallbacks, fallbacks, strict=True):
            if fallback is None or not fallback.is_configured:
                return (
                    f"{refusal}its fallback controller : '{name}' need to be configured and be in "
                    'inactive/active state!'
                )
        there = [each for each in fallbacks if each is not None]
        commands, states = self._available(
            [*self._request.entering, *there], self._request.leaving
        )
        for fallback in there:
            wanted = fallback.wanted(commands, states)
            for kind, names, available in zip(
                ('command', 'state'), wanted, (commands, states), strict=True
            ):
                missing = [name for name in names if name not in available]
                if missing:
                    return (
                        f"{refusal}not all of its fallback controller's : '{fallback.name}' "
                        f'{kind} interfaces are currently available! Missing: {missing[0]}'
                    )
        return ''

    # --- interfaces ------------------------------------------------------------------------------

    def _available(
        self, entering: Iterable[LoadedController], leaving: Iterable[LoadedController]
    ) -> tuple[list[str], list[str]]:
        """Command and state interfaces when these controllers have come and gone."""
        commands = dict.fromkeys(self._resources.available_commands())
        states = dict.fromkeys(self._resources.available_states())
        for controller in leaving:
            for offered, there in (
                (controller.ends.references, commands),
                (controller.ends.exported_states, states),
            ):
                for name in offered:
                    there.pop(name, None)
        for controller in entering:
            commands.update(dict.fromkeys(controller.ends.references))
            states.update(dict.fromkeys(controller.ends.exported_states))
        return list(commands), list(states)

    def check_interfaces(self) -> list[str]:
        """
        Every interface must be there, and free or freed by this very request.

        Returns the command interfaces. Raises ControllerError.
        """
        entering, leaving = self._request.entering, self._request.leaving
        commands, states = self._available(entering, leaving)
        freed = {controller.name for controller in leaving}
        promised: dict[str, None] = {}
        for controller in entering:
            wanted_commands, wanted_states = controller.wanted(commands, states)
            refusal = f"Unable to activate controller '{controller.name}' since the "
            for name in wanted_commands:
                holder = self._resources.claims.get(name)
                if name not in commands:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' is not available."
                        f'{self._hint_at(name)}'
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
            promised.update(dict.fromkeys(wanted_commands))
            for name in wanted_states:
                if name not in states:
                    raise ControllerError(f"{refusal}state interface '{name}' is not available.")
        return list(promised)

    def _hint_at(self, command: str) -> str:
        """Name the hardware component that has the command but does not lend it now."""
        for name, owned in self._resources.components.items():
            if command in owned.commands:
                return f" Its hardware component '{name}' is {owned.state.label}, not active."
        return ''


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
        self._drop_invalid()
        restarted = request.add_mode_changes()
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

    def _drop_invalid(self) -> None:
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
            self._log(Severity.ERROR, f"Failed to activate '{controller.name}': {describe(error)}")
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
