# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The checks of ``switch_controller``, word for word as scripts grep for them."""

from collections.abc import Iterable

from amr_description.control.interfaces import LifecycleState
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switch_request import SwitchRequest
from amr_description.errors import ControllerError


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
