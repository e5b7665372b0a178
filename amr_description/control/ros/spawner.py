# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``spawner`` does: take controllers through their states, with their parameter files.

Two spawners of this host never work on one controller at the same time: one would configure it
anew while the other activates it (:func:`exclusive_lock`). Spawners of other controllers, and of
other robots, do not wait for each other; ros2_control has a single lock for the whole machine.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, ExitStack
import fcntl
from itertools import pairwise
import os
from pathlib import Path
import sys
from typing import Any

from controller_manager_msgs import srv
from controller_manager_msgs.msg import ControllerState
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node

from amr_description.colors import BLUE, colored, CYAN, GREEN, YELLOW
from amr_description.control.ros.client import ManagerClient
from amr_description.control.ros.spawner_arguments import ControllerPlan, SpawnOptions
from amr_description.errors import ControllerError, ParameterError
from amr_description.parameter_files import EVERY_NODE, read_parameter_file, sections
from amr_description.ros.service_calls import NoAnswerError, wait_until
from amr_description.ros_arguments import ros_arguments

SERVICES = (SetParameters, srv.LoadController, srv.ConfigureController, srv.SwitchController)
"""The types of the services that it calls to activate a controller."""
_LOG_PERIOD = 10.0
"""s: how often it is logged that another one has the lock."""


class Spawner:
    """Takes controllers through their states; ``files``: parameter files for all of them."""

    def __init__(
        self, node: Node, manager: ManagerClient, options: SpawnOptions, files: Sequence[str] = ()
    ) -> None:
        self._log = node.get_logger()
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
                self._log.warning(line)
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
        self._log.info(f'{self._manager.name} is gone, and its controllers with it')

    def _unload(self) -> None:
        states = self._manager.states()
        loaded = [plan.name for plan in self._options.plans if plan.name in states]
        active = [name for name in loaded if states[name] == 'active']
        if not loaded:
            self._log.info('No active controllers to unload.')
            return
        if active:
            self._log.info('Deactivating and unloading controllers...')
            message = self._switch(deactivate=active)
            if message is not None:
                raise ControllerError(f'Failed to deactivate controller : {active}: {message}')
            self._log.info(f'Successfully deactivated controllers : {active}')
        failed = [name for name in loaded if not self._manager.unload(name)]
        if failed:
            reason = self._manager.logged(*failed) or 'see the log of the manager'
            raise ControllerError(f'Failed to unload controller : {", ".join(failed)}: {reason}')
        self._log.info(f'Successfully unloaded controllers : {loaded}')

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
            self._log.warning(yellow('Controller already loaded, skipping load_controller'))
        if state == 'active':
            self._log.info(f'Controller {name} is active already; nothing to do')
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
        if plan.files and not entries:
            if not self._manager.has_type(name):
                raise ParameterError(not_found(name, files))
            self._log.info(f'{not_found(name, files)}; the manager knows its type')
        parameters |= manager_parameters(name, entries)
        self._manager.set_parameters(name, parameters)
        for key, value in parameters.items():
            self._log_colored(CYAN, f'Setting controller param "{key}" to "{value}" for {name}')

    def _failure(self, what: str, name: str) -> str:
        reasons = self._manager.reasons(name)
        return f'{what}: {reasons}' if reasons else f'{what}: see the log of the manager'

    def _log_colored(self, color: str, text: str) -> None:
        self._log.info(colored(text, color, sys.stderr))


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


@contextmanager
def exclusive_lock(node: Node, manager: str, controllers: Sequence[str]) -> Iterator[None]:
    """
    Be the only spawner of these controllers of ``manager`` (an absolute name) while inside.

    The locks are files in ``$ROS_HOME/locks`` (``~/.ros/locks``), and end with the process, in any
    case. Where that folder cannot be written there is no lock.
    """
    prefix = f'{node.context.get_domain_id()}{manager.replace("/", ".")}'
    with ExitStack() as stack:
        for name in sorted(set(controllers)):  # in one order, so that no two wait in a circle
            try:
                path = _folder() / f'spawner.{prefix}.{name}.lock'
                file = stack.enter_context(path.open('a'))
            except (OSError, RuntimeError) as error:
                node.get_logger().debug(f'without a lock: {error}')
                continue
            _acquire(node, file.fileno(), f'controller {name} of {manager} ({path})')
        yield


def _folder() -> Path:
    """Return the folder of the locks. Raises OSError; RuntimeError where nobody has a home."""
    folder = Path(os.environ.get('ROS_HOME') or Path.home() / '.ros') / 'locks'
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _acquire(node: Node, descriptor: int, what: str) -> None:
    def taken() -> bool | None:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return None
        return True

    def log_wait() -> None:
        node.get_logger().warning(f'Waiting for the spawner that works on {what}')

    wait_until(node, taken, log_wait, every=_LOG_PERIOD)


def files_in_arguments(words: Sequence[str]) -> list[str]:
    """Return the files behind ``--params-file`` among the ROS arguments of a command line."""
    pairs = pairwise(ros_arguments(words))
    return [str(Path(file).absolute()) for flag, file in pairs if flag == '--params-file']


def controller_entries(
    name: str, files: Sequence[str], namespace: str
) -> dict[str, dict[str, Any]]:
    """
    Return a controller's parameters in each of the files that have any.

    Raises ParameterError: a file is no good, or all that speak of the controller lack the
    ``namespace`` that it has.
    """
    entries, lacking = {}, False
    for path in dict.fromkeys(files):
        content = _read(name, path, namespace)
        parameters = parameters_of(name, content, namespace)
        if parameters is not None:
            entries[path] = parameters
        lacking |= parameters is None and name in content
    if lacking and not entries:
        raise ParameterError(
            f'Missing namespace : {namespace} or wildcard in parameter file for controller : '
            f'{name}'
        )
    return entries


def not_found(name: str, files: Sequence[str]) -> str:
    """Return the message that no file has parameters for a controller."""
    return f'Controller : {name} parameters not found in parameter files : {list(files)}'


def manager_parameters(
    name: str, entries: Mapping[str, Mapping[str, Any]]
) -> dict[str, str | list[str]]:
    """
    Return what to set at the manager before it loads a controller, below the controller's name.

    ``entries``: of :func:`controller_entries`. The first file that names a type or fallback
    controllers counts. Raises ParameterError: one of these is no text.
    """
    if not entries:
        return {}
    parameters: dict[str, str | list[str]] = {'params_file': list(entries)}
    for path, entry in entries.items():
        if entry.get('type') and 'type' not in parameters:
            parameters['type'] = _text(entry['type'], name, 'type', path)
        if entry.get('fallback_controllers') and 'fallback_controllers' not in parameters:
            found = entry['fallback_controllers']
            names = found if isinstance(found, list) else [found]
            parameters['fallback_controllers'] = [
                _text(each, name, 'fallback_controllers', path) for each in names
            ]
    return parameters


def parameters_of(name: str, content: Mapping[str, Any], namespace: str) -> dict[str, Any] | None:
    """Return the parameters of a controller in the content of one file, or ``None``."""
    node = f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    found = [section for section in sections(content) if section.is_of(node)]
    if not found:
        return None
    # Its own name comes before patterns, and these before the one that is for all nodes.
    own = min(found, key=lambda each: (each.pattern == EVERY_NODE, '*' in each.pattern))
    return dict(own.parameters or {})


def _read(name: str, path: str, namespace: str) -> dict[str, Any]:
    try:
        return read_parameter_file(Path(path))
    except ParameterError as error:
        node = f'{namespace.rstrip("/")}/{name}'
        raise ParameterError(
            f'YAML file : {path} is not a valid ROS parameter file for controller node : {node}: '
            f'{error}'
        ) from error


def _text(value: Any, name: str, key: str, path: str) -> str:
    if not isinstance(value, str):
        raise ParameterError(f"'{key}' of controller {name} in {path} is {value!r}, not a name")
    return value


def yellow(text: str) -> str:
    return colored(text, YELLOW, sys.stderr)
