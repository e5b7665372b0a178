# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Switching controllers: a request is checked, becomes a plan, and the plan is carried out.

:class:`SwitchRequest` holds the controllers to activate and to deactivate, :class:`SwitchChecks`
finds the reasons against it, and :class:`SwitchPlanner` makes a :class:`SwitchPlan` of the two;
nothing has changed by then. :class:`SwitchExecution` carries the plan out. Third-party controllers
and components may raise anything in the course of it: that is logged, and the others go on.

Messages are those of ros2_control, to the letter, as scripts search for them. Everything runs on
the control thread, between two ticks.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
import enum

from amr_description.control.controller_list import ControllerList
from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import ControllerError, HardwareError
from amr_description.log import Log, Severity
from amr_description.plugin_errors import describe, log_traceback

NOTHING_TO_SWITCH = (
    'After checking the controllers, no controllers need to be activated or deactivated.'
)


class Strictness(enum.IntEnum):
    """The constants of ``controller_manager_msgs/srv/SwitchController``."""

    BEST_EFFORT = 1
    STRICT = 2
    AUTO = 3
    FORCE_AUTO = 4


@dataclass(slots=True)
class SwitchRequest:
    """The controllers to activate and to deactivate, out of all ``controllers``."""

    controllers: ControllerList
    entering: list[LoadedController] = field(default_factory=list)
    leaving: list[LoadedController] = field(default_factory=list)

    def will_be_active(self, controller: LoadedController) -> bool:
        """Return whether a controller stays or becomes active."""
        stays = controller.is_active and controller not in self.leaving
        return stays or controller in self.entering

    def will_be_chained(self, controller: LoadedController) -> bool:
        """Return whether a controller will be commanded by another one."""
        return any(map(self.will_be_active, self.controllers.commanding(controller)))

    def add_mode_changes(self) -> frozenset[str]:
        """
        Add to both lists the active controllers that enter or leave chained mode.

        They have to be restarted, as the mode is changed only while inactive. Returns their names.
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
    """Finds the reasons against a request, which may change between two calls."""

    def __init__(self, request: SwitchRequest, resources: ResourceManager) -> None:
        self._request = request
        self._resources = resources

    def objection_to_deactivation(self, controller: LoadedController) -> str:
        """Return why a controller cannot be deactivated; '': it can."""
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
            is_activated = preceding in self._request.entering and not preceding.is_active
            if is_activated and controller not in self._request.entering:
                return (
                    f"{refusal}preceding controller with name '{preceding.name}' is inactive and "
                    'will be activated.'
                )
        return ''

    def objection_to_activation(self, controller: LoadedController) -> str:
        """Return why a controller cannot be activated; '': it can, as far as its interfaces do."""
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
        """Every fallback must be able to start right now."""
        refusal = f"Controller with name '{controller.name}' cannot be activated, as "
        fallbacks = [self._request.controllers.get(name) for name in controller.fallbacks]
        for name, fallback in zip(controller.fallbacks, fallbacks, strict=True):
            if fallback is None or not fallback.is_configured:
                return (
                    f"{refusal}its fallback controller : '{name}' need to be configured and be in "
                    'inactive/active state!'
                )
        loaded = [each for each in fallbacks if each is not None]
        commands, states = self._available(
            [*self._request.entering, *loaded], self._request.leaving
        )
        for fallback in loaded:
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
        """Return the command and state interfaces that are available after such a switch."""
        commands = dict.fromkeys(self._resources.available_commands())
        states = dict.fromkeys(self._resources.available_states())
        for controller in leaving:
            for name in controller.chain_interfaces.references:
                commands.pop(name, None)
            for name in controller.chain_interfaces.exported_states:
                states.pop(name, None)
        for controller in entering:
            commands.update(dict.fromkeys(controller.chain_interfaces.references))
            states.update(dict.fromkeys(controller.chain_interfaces.exported_states))
        return list(commands), list(states)

    def check_interfaces(self) -> list[str]:
        """
        Check that every interface is available, and unclaimed or released by this request.

        Returns the command interfaces that will be claimed. Raises ControllerError.
        """
        entering, leaving = self._request.entering, self._request.leaving
        commands, states = self._available(entering, leaving)
        releasing = {controller.name for controller in leaving}
        claimed: dict[str, None] = {}
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
                if holder is not None and holder not in releasing:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' is currently claimed by another "
                        'controller.'
                    )
                if name in claimed:
                    raise ControllerError(
                        f"{refusal}command interface '{name}' will be used by another controller "
                        'that is being activated.'
                    )
            claimed.update(dict.fromkeys(wanted_commands))
            for name in wanted_states:
                if name not in states:
                    raise ControllerError(f"{refusal}state interface '{name}' is not available.")
        return list(claimed)

    def _hint_at(self, command: str) -> str:
        """Return which hardware component has a command that is not available; '': none."""
        for name, component in self._resources.components.items():
            if command in component.commands:
                return f" Its hardware component '{name}' is {component.state.label}, not active."
        return ''


@dataclass(frozen=True, slots=True)
class SwitchPlan:
    """A switch that has passed the checks: first deactivate, then activate."""

    deactivate: tuple[LoadedController, ...]
    activate: tuple[LoadedController, ...]
    chained: frozenset[str]
    """Names of those to activate in chained mode."""
    restarted: frozenset[str]
    """Names of those in both lists only to enter or leave chained mode, without being named."""
    start: tuple[str, ...]
    """Names of the command interfaces that will be claimed."""


class SwitchPlanner:
    """Plans one switch, and changes nothing."""

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
        """
        Return what can be done: with BEST_EFFORT, controllers that fail a check are left out.

        Args:
            activate: names of controllers.
            deactivate: names of controllers.

        Raises:
            ControllerError: with the message of the response.
        """
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
        """Remove invalid controllers until none is left: others may have needed each of them."""
        request, checks = self._request, self._checks
        while self._drop(request.leaving, checks.objection_to_deactivation) or self._drop(
            request.entering, checks.objection_to_activation
        ):
            pass

    def _drop(
        self, requested: list[LoadedController], objection_to: Callable[[LoadedController], str]
    ) -> bool:
        """Remove the invalid controllers; return whether there were any. STRICT: raise instead."""
        before = len(requested)
        for controller in list(requested):
            objection = objection_to(controller)
            if not objection:
                continue
            if self._strict:
                self._log(Severity.ERROR, objection)
                raise ControllerError(objection)
            self._log(Severity.WARN, objection)
            requested.remove(controller)
        return len(requested) < before


class SwitchExecution:
    """Activates and deactivates controllers, and switches the command modes of the hardware."""

    def __init__(self, controllers: ControllerList, resources: ResourceManager, log: Log) -> None:
        self._controllers = controllers
        self._resources = resources
        self._log = log

    def carry_out(self, plan: SwitchPlan, strictness: Strictness, time: int) -> None:
        """
        Deactivate, then activate.

        Args:
            plan: of the switch.
            strictness: STRICT: if a controller cannot be activated, the others of the plan are
                deactivated again, except those that are merely restarted.
            time: present time, ns.

        Raises:
            ControllerError: the hardware refuses, and nothing has changed; or it fails afterwards,
                with the controllers deactivated; or a controller cannot be activated, and is then
                unconfigured if it raised itself.
        """
        stop = [name for c in plan.deactivate for name in c.required_commands]
        self._prepare(plan.start, stop)
        self._deactivate(plan.deactivate, time)
        try:
            self._perform(plan.start, stop)
        except ControllerError:
            self._restore_chains(time)
            raise
        failed = [c for c in plan.activate if not self._activate(c, time, c.name in plan.chained)]
        if not failed:
            return
        if strictness is Strictness.STRICT:
            named = (c for c in reversed(plan.activate) if c.name not in plan.restarted)
            self.force_deactivate([c for c in named if c.is_active], time)
        self._release_commands(failed)
        self._restore_chains(time)
        self._clean_up(failed)
        raise ControllerError(
            'Failed switching controllers.... '
            f'Unable to activate controllers: [ {names_of(failed)} ]'
        )

    def _clean_up(self, controllers: Iterable[LoadedController]) -> None:
        """Unconfigure the controllers whose ``activate`` raised, as ros2_control does."""
        for controller in controllers:
            if not controller.has_failed:
                continue
            try:
                controller.cleanup()
            except Exception as error:  # it is unconfigured nevertheless
                self._log(
                    Severity.ERROR,
                    f"Failed to clean '{controller.name}' up: {describe(error)}",
                )
                log_traceback(self._log, error)
        self._controllers.link()

    def force_deactivate(self, controllers: Sequence[LoadedController], time: int) -> None:
        """Deactivate controllers without any checks; ``time`` in ns."""
        if controllers:
            self._deactivate(controllers, time)
            self._release_commands(controllers)

    def _restore_chains(self, time: int) -> None:
        """
        After a failure, deactivate the controllers that lack one that they need, and restart those
        in chained mode that nobody commands any more.
        """
        for c in self._controllers.activation_order(self._controllers.active):
            if not all(needed.is_active for needed in self._controllers.needed(c)):
                self.force_deactivate([c], time)
        for c in self._controllers.active:
            is_commanded = any(each.is_active for each in self._controllers.commanding(c))
            if c.controller.is_chained and not is_commanded:
                self._deactivate([c], time)
                if not self._activate(c, time, chained=False):
                    self._release_commands([c])
                    self._restore_chains(time)
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
        """Switch the command modes of the hardware after an unplanned deactivation."""
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
            except Exception as error:  # it is inactive nevertheless, and its claims released
                self._log(
                    Severity.ERROR,
                    f"Failed to deactivate '{controller.name}' cleanly: {describe(error)}",
                )
                log_traceback(self._log, error)


def names_of(controllers: Iterable[LoadedController]) -> str:
    """Return the names, listed as in messages of ros2_control."""
    return ' '.join(controller.name for controller in controllers)
