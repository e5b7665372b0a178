# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``spawner``: load, configure and activate controllers, one by one, and end.

Arguments, messages and exit codes as the ``spawner`` of Jazzy's controller_manager: 0 when all is
done, 1 when a step failed, 2 for a wrong command line. Three things are better than there:

- the reason of a failed step is told here, not only in the manager's log;
- a controller that is active already is left alone (0), so that a bring-up can be run again;
- there is no machine-wide lock: spawners of different robots do not wait for each other, as the
  manager here does not mind two at once.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
import os
import sys
import threading

from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from amr_description.errors import ControllerError, ParameterError
from amr_description.nodes.manager_client import ManagerClient
from amr_description.nodes.runtime import argument_errors, program, ros
from amr_description.nodes.spawner_files import manager_parameters

_MANAGER = 'controller_manager'


@dataclass(frozen=True)
class SpawnOptions:
    """What is to be done with each controller."""

    files: tuple[str, ...]
    load_only: bool
    inactive: bool
    as_group: bool
    switch_timeout: float
    activate_asap: bool
    ros_args: tuple[str, ...]


def parser() -> argparse.ArgumentParser:
    """Make the parser, with the original's options and defaults."""
    options = argparse.ArgumentParser(prog='spawner', description=__doc__.split('\n\n')[0])
    options.add_argument('controller_names', nargs='+', help='controllers to spawn, in order')
    options.add_argument('-c', '--controller-manager', default=_MANAGER, help='its node')
    options.add_argument(
        '-p',
        '--param-file',
        action='append',
        default=[],
        help='parameter file of the controllers; may be given several times',
    )
    options.add_argument('--load-only', action='store_true', help='load, and stop there')
    options.add_argument('--inactive', action='store_true', help='load and configure only')
    options.add_argument(
        '-u',
        '--unload-on-kill',
        action='store_true',
        help='stay, and unload the controllers when interrupted',
    )
    options.add_argument(
        '--controller-manager-timeout',
        type=float,
        default=0.0,
        help='how long to wait for the manager, s; 0: for ever',
    )
    options.add_argument('--switch-timeout', type=float, default=5.0, help='s')
    options.add_argument('--service-call-timeout', type=float, default=10.0, help='s')
    options.add_argument(
        '--activate-as-group', action='store_true', help='activate all with one request'
    )
    options.add_argument('--switch-asap', action=argparse.BooleanOptionalAction, default=True)
    options.add_argument(
        '--controller-ros-args',
        action='append',
        default=[],
        help='ROS arguments of the controller nodes, such as "-r /tf:=tf"',
    )
    return options


class Spawner:
    """Takes controllers through their states."""

    def __init__(self, node: Node, manager: ManagerClient, options: SpawnOptions) -> None:
        self._log = node.get_logger()
        self._manager = manager
        self._options = options

    def spawn(self, names: Sequence[str]) -> None:
        """Spawn all. Raises ControllerError, with the reason, at the first that fails."""
        to_activate = []
        for name in names:
            if self._prepare(name):
                to_activate.append(name)
                if not self._options.as_group:
                    self._activate([name])
                    self._log.info(_green(f'Configured and activated {name}'))
        if self._options.as_group and to_activate:
            self._activate(to_activate)
            names = str(to_activate)
            self._log.info(
                _green(f'Configured and activated all the parsed controllers list : {names}!')
            )

    def unload(self, names: Sequence[str]) -> None:
        """Deactivate and unload what is there of them."""
        states = self._manager.states()
        active = [name for name in names if states.get(name) == 'active']
        if active:
            self._manager.switch(deactivate=active, timeout=self._options.switch_timeout)
            self._log.info(f'Successfully deactivated controllers : {active}')
        else:
            self._log.info('No active controllers to unload.')
        loaded = [name for name in names if name in states]
        for name in loaded:
            self._manager.unload(name)
        self._log.info(f'Successfully unloaded controllers : {loaded}')

    def _prepare(self, name: str) -> bool:
        """Load and configure; tell whether it is now to be activated."""
        state = self._manager.states().get(name)
        if state is None:
            self._set_parameters(name)
            if not self._manager.load(name):
                raise ControllerError(self._failure(f'Failed loading controller {name}', name))
            self._log.info(_green(f'Loaded {name}'))
        else:
            self._log.warning('Controller already loaded, skipping load_controller')
        if state == 'active':
            self._log.info(f'Controller {name} is active already; nothing to do')
            return False
        if self._options.load_only:
            return False
        if not self._manager.configure(name):
            raise ControllerError(self._failure(f'Failed to configure controller {name}', name))
        return not self._options.inactive

    def _activate(self, names: Sequence[str]) -> None:
        message = self._manager.switch(
            activate=names,
            timeout=self._options.switch_timeout,
            activate_asap=self._options.activate_asap,
        )
        if message is not None:
            what = (
                f'Failed to activate the parsed controllers list : {list(names)}'
                if self._options.as_group
                else f'Failed to activate controller : {names[0]}'
            )
            raise ControllerError(f'{what}: {message}' if message else what)

    def _set_parameters(self, name: str) -> None:
        options = self._options
        parameters: dict[str, str | list[str]] = {}
        if options.ros_args:
            parameters['node_options_args'] = list(options.ros_args)
        parameters |= manager_parameters(name, options.files, self._manager.namespace)
        for key, value in parameters.items():
            self._log.info(f'Setting controller param "{key}" to "{value}" for {name}')
        self._manager.set_parameters(name, parameters)

    def _failure(self, what: str, name: str) -> str:
        reasons = self._manager.reasons(name)
        return f'{what}: {reasons}' if reasons else f'{what}: see the log of the manager'


def spawn(args: list[str] | None) -> int:
    """Do what the command line says; return the exit code."""
    with ros(args) as stop:
        words = sys.argv if args is None else ['spawner', *args]
        options = parser().parse_args(remove_ros_args(words)[1:])
        for path in options.param_file:
            if not os.path.isfile(path):
                raise ParameterError(f'-p {path}: there is no such parameter file')
        with argument_errors():
            node = Node(f'spawner_{options.controller_names[0]}')
        try:
            manager = ManagerClient(
                node,
                options.controller_manager,
                timeout=options.controller_manager_timeout,
                call_timeout=options.service_call_timeout,
            )
            spawner = Spawner(node, manager, _options(options))
            spawner.spawn(options.controller_names)
            if options.unload_on_kill:
                node.get_logger().info('Waiting until interrupt to unload controllers')
                interrupted = threading.Event()
                with stop.on_stop(interrupted.set):
                    interrupted.wait()
                node.get_logger().info('KeyboardInterrupt successfully captured!')
                node.get_logger().info('Deactivating and unloading controllers...')
                spawner.unload(options.controller_names)
        finally:
            node.destroy_node()
    return 0


def _options(options: argparse.Namespace) -> SpawnOptions:
    return SpawnOptions(
        files=tuple(os.path.abspath(path) for path in options.param_file),
        load_only=options.load_only,
        inactive=options.inactive,
        as_group=options.activate_as_group,
        switch_timeout=options.switch_timeout,
        activate_asap=options.switch_asap,
        ros_args=tuple(word for text in options.controller_ros_args for word in text.split()),
    )


def _green(text: str) -> str:
    """Colour as the original: on a terminal, unless RCUTILS_COLORIZED_OUTPUT says otherwise."""
    wanted = os.environ.get('RCUTILS_COLORIZED_OUTPUT')
    coloured = sys.stderr.isatty() if wanted not in ('0', '1') else wanted == '1'
    return f'\033[92m{text}\033[0m' if coloured else text


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: spawn(args))


if __name__ == '__main__':
    sys.exit(main())
