# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``spawner`` does: take controllers through their states, with their parameter files.

It asks a manager by what a client of its services has, or a manager of the same process.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
import sys
from typing import Protocol

from amr_description.colors import BLUE, colored, CYAN, GREEN, YELLOW
from amr_description.controller_manager.spawner_arguments import ControllerPlan, SpawnOptions
from amr_description.controller_manager.spawner_files import (
    controller_entries,
    manager_parameters,
    not_found,
    type_for_the_manager,
)
from amr_description.errors import ControllerError, NoAnswerError, ParameterError
from amr_description.log import Log, Severity
from amr_description.text import did_you_mean

_NO_TYPE = 'no type is set for'


class ControllerState(Protocol):
    """A controller, with the names of ``controller_manager_msgs/msg/ControllerState``."""

    name: str
    type: str
    state: str
    claimed_interfaces: Sequence[str]
    required_command_interfaces: Sequence[str]
    required_state_interfaces: Sequence[str]


class Manager(Protocol):
    """What a spawner asks of a controller manager."""

    name: str
    """Full, of its node."""
    namespace: str

    def is_there(self) -> bool:
        """Return whether it is still there."""

    def states(self) -> dict[str, str]:
        """Return the states of all loaded controllers, by their names."""

    def controllers(self) -> Mapping[str, ControllerState]:
        """Return all loaded controllers, by their names."""

    def has_type(self, controller: str) -> bool:
        """Return whether the manager's parameters hold a type for a controller."""

    def set_parameters(self, controller: str, parameters: Mapping[str, str | list[str]]) -> None:
        """Set ``<controller>.<key>`` at the manager. Raises ControllerError."""

    def load(self, name: str) -> bool:
        """Load a controller."""

    def configure(self, name: str) -> bool:
        """Configure a controller."""

    def unload(self, name: str) -> bool:
        """Unload a controller."""

    def switch(
        self,
        *,
        activate: Sequence[str] = (),
        deactivate: Sequence[str] = (),
        timeout: float = 5.0,
        activate_asap: bool = True,
    ) -> str | None:
        """Switch with strictness STRICT; return ``None``, or why it failed."""

    def reasons(self, controller: str) -> str:
        """Return why the last load failed; empty: it is not known."""

    def logged(self, *nodes: str) -> str:
        """Return what the manager, and nodes beside it, have logged as errors; empty: nothing."""


class Spawner:
    """Takes controllers through their states; ``files``: parameter files for all of them."""

    def __init__(
        self, log: Log, manager: Manager, options: SpawnOptions, files: Sequence[str] = ()
    ) -> None:
        self._log = log
        self._manager = manager
        self._options = options
        self._files = tuple(files)

    def spawn(self, stopped: Callable[[], bool] = lambda: False) -> None:
        """
        Spawn all controllers, or those before ``stopped()``, which is asked before each.

        Raises:
            ControllerError: One has failed; the reason is in it. The others are not spawned,
                unless the options say so: then it is logged.
            ParameterError: A parameter file is no good.
        """
        if self._options.continue_on_error:
            for line in self.spawn_what_can_be(stopped):
                self._log(Severity.WARN, line)
            return
        group = []
        for plan in self._options.plans:
            if stopped():
                return
            if not self._prepare(plan):
                continue
            if self._options.as_group:
                group.append(plan.name)
            else:
                self._activate_one(plan.name)
        if group and not stopped():
            self._activate(
                group,
                done=f'Configured and activated all the parsed controllers list : {group}!',
                failed=f'Failed to activate the parsed controllers list : {group}',
            )

    def spawn_what_can_be(self, stopped: Callable[[], bool] = lambda: False) -> Iterator[str]:
        """
        Spawn all controllers that can be; yield a line for each that is left out or inactive.

        Broadcasters and drives come in the order of the plans, a controller that commands or
        reads another one after that one. Of those that claim the same command interfaces the
        first one is activated.
        """
        ready = []
        for plan in self._options.plans:
            if stopped():
                return
            try:
                ready += [plan.name] if self._prepare(plan) else []
            except (ControllerError, ParameterError) as error:
                yield f'{error}; it is left out'
        for name in in_order_of_chains(ready, self._manager.controllers()):
            if stopped():
                return
            controllers = self._manager.controllers()
            holder, interfaces = claimed_by_others(name, controllers)
            if holder:
                yield (
                    f'{name} stays inactive: {holder} has claimed {", ".join(interfaces)}; for '
                    f'the other one:  ros2 control switch_controllers --deactivate {holder} '
                    f'--activate {name}'
                )
                continue
            try:
                self._activate_one(name)
            except ControllerError as error:
                yield f'{error}; it stays inactive'

    def unload(self) -> None:
        """Deactivate and unload those that are loaded. Raises ControllerError: one failed."""
        try:
            if self._manager.is_there():
                self._unload()
                return
        except NoAnswerError:
            if self._manager.is_there():
                raise
        # As when a Ctrl-C ends a whole stack.
        self._log(Severity.INFO, f'{self._manager.name} is gone, and its controllers with it')

    def _unload(self) -> None:
        states = self._manager.states()
        loaded = [plan.name for plan in self._options.plans if plan.name in states]
        active = [name for name in loaded if states[name] == 'active']
        if not loaded:
            self._log(Severity.INFO, 'No active controllers to unload.')
            return
        if active:
            self._log(Severity.INFO, 'Deactivating and unloading controllers...')
            message = self._switch(deactivate=active)
            if message is not None:
                raise ControllerError(f'Failed to deactivate controller : {active}: {message}')
            self._log(Severity.INFO, f'Successfully deactivated controllers : {active}')
        failed = [name for name in loaded if not self._manager.unload(name)]
        if failed:
            reason = self._manager.logged(*failed) or 'see the log of the manager'
            raise ControllerError(f'Failed to unload controller : {", ".join(failed)}: {reason}')
        self._log(Severity.INFO, f'Successfully unloaded controllers : {loaded}')

    def _prepare(self, plan: ControllerPlan) -> bool:
        """Load and configure a controller; return whether it is now to be activated."""
        name = plan.name
        state = self._manager.states().get(name)
        if state is None:
            self._set_parameters(plan)
            if not self._manager.load(name):
                raise ControllerError(self._failure(f'Failed loading controller {name}', name))
            self._log_colored(BLUE, f'Loaded {name}')
        else:
            self._log(Severity.WARN, yellow('Controller already loaded, skipping load_controller'))
        if state == 'active':
            self._log(Severity.INFO, f'Controller {name} is active already; nothing to do')
            return False
        if plan.load_only:
            return False
        if not self._manager.configure(name):
            raise ControllerError(self._failure(f'Failed to configure controller {name}', name))
        return not plan.inactive

    def _activate_one(self, name: str) -> None:
        self._activate(
            [name],
            done=f'Configured and activated {name}',
            failed=f'Failed to activate controller : {name}',
        )

    def _activate(self, names: Sequence[str], *, done: str, failed: str) -> None:
        """Activate with one request. Raises ControllerError."""
        message = self._switch(activate=names)
        if message is not None:
            raise ControllerError(f'{failed}: {message}' if message else failed)
        self._log_colored(GREEN, done)

    def _switch(self, **names: Sequence[str]) -> str | None:
        return self._manager.switch(
            **names,
            timeout=self._options.switch_timeout,
            activate_asap=self._options.activate_asap,
        )

    def _set_parameters(self, plan: ControllerPlan) -> None:
        name, files = plan.name, (*self._files, *plan.files)
        parameters: dict[str, str | list[str]] = {}
        if plan.ros_args:
            parameters['node_options_args'] = list(plan.ros_args)
        entries = controller_entries(name, files, self._manager.namespace)
        elsewhere = type_for_the_manager(name, files, self._manager.namespace)
        if plan.files and not entries:
            if not self._manager.has_type(name):
                raise ParameterError('; '.join(filter(None, (not_found(name, files), elsewhere))))
            self._log(Severity.INFO, f'{not_found(name, files)}; the manager knows its type')
        parameters |= manager_parameters(name, entries)
        if elsewhere and 'type' not in parameters and not self._manager.has_type(name):
            raise ParameterError(f'Controller : {name} has no type: {elsewhere}')
        self._manager.set_parameters(name, parameters)
        for key, value in parameters.items():
            self._log_colored(CYAN, f'Setting controller param "{key}" to "{value}" for {name}')

    def _failure(self, what: str, name: str) -> str:
        reasons = self._manager.reasons(name)
        return f'{what}: {reasons}' if reasons else f'{what}: see the log of the manager'

    def _log_colored(self, color: str, text: str) -> None:
        self._log(Severity.INFO, colored(text, color, sys.stderr))


def in_order_of_chains(
    names: Sequence[str], controllers: Mapping[str, ControllerState]
) -> list[str]:
    """Return names so that each comes after those whose interfaces it needs, else as they are."""

    def needs(name: str) -> set[str]:
        state = controllers.get(name)
        if state is None:  # somebody has unloaded it: its activation will say so
            return set()
        interfaces = (*state.required_command_interfaces, *state.required_state_interfaces)
        return {interface.partition('/')[0] for interface in interfaces} & {*names} - {name}

    waiting, ordered = list(names), list[str]()
    while waiting:
        free = [name for name in waiting if not needs(name) & {*waiting}]
        # A circle is for the manager to refuse.
        ordered.append((free or waiting)[0])
        waiting.remove(ordered[-1])
    return ordered


def claimed_by_others(
    name: str, controllers: Mapping[str, ControllerState]
) -> tuple[str, list[str]]:
    """Return who has claimed command interfaces that a controller needs, and which; '': nobody."""
    state = controllers.get(name)  # None: somebody has unloaded it
    wanted = state.required_command_interfaces if state else ()
    for other in controllers.values():
        common = [each for each in wanted if each in other.claimed_interfaces]
        if other.name != name and common:
            return other.name, common
    return '', []


def reason_of(manager: Manager, controller: str, cause: str, typed: Sequence[str]) -> str:
    """
    Return why a controller that the manager has no type for was not loaded.

    Args:
        manager: Has refused it.
        controller: Its name.
        cause: What the manager has logged.
        typed: The controllers that it has types for.
    """
    if cause.startswith(_NO_TYPE):  # the manager has found why in its parameter file
        return cause
    return (
        f'{_NO_TYPE} it: {manager.name} has one for {", ".join(typed) or "no controller"}'
        f'{did_you_mean(controller, typed)}; name the parameter file that sets its type with '
        '-p FILE'
    )


def yellow(text: str) -> str:
    return colored(text, YELLOW, sys.stderr)
