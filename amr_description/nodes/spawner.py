# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``spawner``: load, configure and activate controllers, one by one, and end.

Arguments, messages and exit codes as the ``spawner`` of Jazzy's controller_manager: 0 when all is
done, 1 when a step failed, 2 for a wrong command line. What is better than there:

- a manager that does not come is explained: nobody there, in another namespace, waiting for a
  robot description, no clock; a failed step tells its reason here, not only in the manager's log;
- a controller that is active already is left alone (0), so that a bring-up can be run again;
- there is no machine-wide lock: only spawners of the same controller wait for each other;
- a request that changes something is sent once: a manager that is only slow is not asked again;
- interrupted before all is done it exits with 128 + the signal, so that nobody takes it for done;
- ``--unload-on-kill`` unloads all that were spawned, those that are inactive too, and does so
  whenever it is interrupted once it has begun.
"""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from functools import partial
import sys
import threading

from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from amr_description.errors import ControllerError, ParameterError
from amr_description.nodes.clients import client_node, NoAnswerError
from amr_description.nodes.colors import BLUE, colored, CYAN, GREEN, YELLOW
from amr_description.nodes.manager_client import ManagerClient
from amr_description.nodes.runtime import program, ros
from amr_description.nodes.spawner_arguments import ControllerPlan, parse, SpawnOptions
from amr_description.nodes.spawner_files import (
    controller_entries,
    files_in_arguments,
    manager_parameters,
    not_found,
)
from amr_description.nodes.spawner_lock import alone_with
from amr_description.nodes.stop_requests import StopRequests


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
        Spawn all, or go on until ``stopped()``, which is asked before each.

        Raises ControllerError, with the reason, at the first that fails; ParameterError.
        """
        group = []
        for plan in self._options.plans:
            if stopped():
                return
            if not self._prepare(plan):
                continue
            if self._options.as_group:
                group.append(plan.name)
            else:
                self._activate(
                    [plan.name],
                    done=f'Configured and activated {plan.name}',
                    failed=f'Failed to activate controller : {plan.name}',
                )
        if group and not stopped():
            self._activate(
                group,
                done=f'Configured and activated all the parsed controllers list : {group}!',
                failed=f'Failed to activate the parsed controllers list : {group}',
            )

    def unload(self) -> None:
        """Deactivate and unload what is there of them. Raises ControllerError: not all went."""
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
        """Load and configure; tell whether it is now to be activated."""
        name = plan.name
        state = self._manager.states().get(name)
        if state is None:
            self._set_parameters(plan)
            if not self._manager.load(name):
                raise ControllerError(self._failure(f'Failed loading controller {name}', name))
            self._say(BLUE, f'Loaded {name}')
        else:
            self._log.warning(_yellow('Controller already loaded, skipping load_controller'))
        if state == 'active':
            self._log.info(f'Controller {name} is active already; nothing to do')
            return False
        if plan.load_only:
            return False
        if not self._manager.configure(name):
            raise ControllerError(self._failure(f'Failed to configure controller {name}', name))
        return not plan.inactive

    def _activate(self, names: Sequence[str], *, done: str, failed: str) -> None:
        """Activate with one request. Raises ControllerError."""
        message = self._switch(activate=names)
        if message is not None:
            raise ControllerError(f'{failed}: {message}' if message else failed)
        self._say(GREEN, done)

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
            self._say(CYAN, f'Setting controller param "{key}" to "{value}" for {name}')

    def _failure(self, what: str, name: str) -> str:
        reasons = self._manager.reasons(name)
        return f'{what}: {reasons}' if reasons else f'{what}: see the log of the manager'

    def _say(self, color: str, text: str) -> None:
        self._log.info(colored(text, color, sys.stderr))


def spawn(args: list[str] | None) -> None:
    """Do what the command line says."""
    with ros(args) as stop:
        words = ['spawner', *args] if args is not None else sys.argv
        options = parse(remove_ros_args(words)[1:])
        node = client_node(f'spawner_{options.plans[0].name}')
        try:
            manager = ManagerClient(
                node,
                _manager_name(node, options),
                timeout=options.manager_timeout,
                call_timeout=options.call_timeout,
            )
            spawner = Spawner(node, manager, options, files_in_arguments(words))
            alone = partial(alone_with, node, manager.name, [plan.name for plan in options.plans])
            if options.unload_on_kill:
                _spawn_and_stay(node, spawner, stop, alone)
            else:
                with alone():
                    spawner.spawn()
        except KeyboardInterrupt:
            node.get_logger().info('KeyboardInterrupt received! Exiting....')
            raise
        finally:
            node.destroy_node()


def _spawn_and_stay(
    node: Node,
    spawner: Spawner,
    stop: StopRequests,
    alone: Callable[[], AbstractContextManager[None]],
) -> None:
    """Spawn, wait until asked to stop, and unload; a stop before that ends the wait at once."""
    log, interrupted = node.get_logger(), threading.Event()
    with stop.on_stop(interrupted.set):
        with alone():
            spawner.spawn(interrupted.is_set)
        log.info('Waiting until interrupt to unload controllers')
        interrupted.wait()
    log.info('KeyboardInterrupt successfully captured!')
    with alone():
        spawner.unload()


def _manager_name(node: Node, options: SpawnOptions) -> str:
    """Return the manager's name with ``--namespace``. Raises ParameterError: there are two."""
    if not options.namespace:
        return options.manager
    if node.get_namespace() != '/':
        raise ParameterError(
            f"Setting namespace through both '--namespace {options.namespace}' arg and the ROS 2 "
            f"standard way '--ros-args -r __ns:={node.get_namespace()}' is not allowed!"
        )
    node.get_logger().warning(
        _yellow(
            "The '--namespace' argument is deprecated and will be removed in future releases. Use "
            'the ROS 2 standard way of setting the node namespacing using --ros-args -r '
            '__ns:=<namespace>'
        )
    )
    inside = f'/{options.namespace.strip("/")}/'
    return options.manager if options.manager.startswith('/') else inside + options.manager


def _yellow(text: str) -> str:
    return colored(text, YELLOW, sys.stderr)


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: spawn(args))


if __name__ == '__main__':
    sys.exit(main())
