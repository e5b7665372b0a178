# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``unspawner``: deactivate controllers, unload them, and end.

Arguments, messages and exit codes as the ``unspawner`` of Jazzy's controller_manager: 0 when all
are gone, 1 when one is not, 2 for a wrong command line. Two things are better than there:

- the active ones among them are deactivated even if others never were active;
- one that cannot be unloaded is named, with the reason, and does not keep the others loaded.
"""

import argparse
from collections.abc import Sequence
import sys

from controller_manager_msgs import srv
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from amr_description.control.ros.client import ManagerClient
from amr_description.controller_manager.spawner_arguments import seconds
from amr_description.errors import ControllerError
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import client_node


def parser() -> argparse.ArgumentParser:
    """Make the parser, with the original's options and defaults."""
    options = argparse.ArgumentParser(prog='unspawner', description=__doc__.split('\n\n')[0])
    options.add_argument('controller_names', nargs='+', help='controllers to unload')
    options.add_argument(
        '-c', '--controller-manager', default='/controller_manager', help='its node'
    )
    options.add_argument(
        '--switch-timeout',
        type=seconds,
        default=5.0,
        metavar='S',
        help='how long to let the switch take, s (default: %(default)s)',
    )
    return options


def unload(
    node: Node, manager: ManagerClient, names: Sequence[str], switch_timeout: float
) -> None:
    """Deactivate with one request and unload one by one. Raises ControllerError."""
    log = node.get_logger()
    states = manager.states()
    active = [name for name in dict.fromkeys(names) if states.get(name) == 'active']
    if active:
        message = manager.switch(deactivate=active, timeout=switch_timeout)
        if message is not None:
            raise ControllerError(f'Failed to deactivate controllers : {active}: {message}')
    log.info('Deactivated controller')
    failures = []
    for name in dict.fromkeys(names):
        if name not in states:
            failures.append(f'{name}: no controller of this name is loaded')
        elif manager.unload(name):
            log.info('Unloaded controller')
        else:
            failures.append(f'{name}: {manager.logged(name) or "see the log of the manager"}')
    if failures:
        raise ControllerError(f'Failed to unload controller {"; ".join(failures)}')


def unspawn(args: list[str] | None) -> None:
    """Unload as the command line asks."""
    with ros(args):
        words = sys.argv if args is None else ['unspawner', *args]
        options = parser().parse_args(remove_ros_args(words)[1:])
        node = client_node(f'unspawner_{options.controller_names[0]}')
        try:
            soon = (srv.SwitchController, srv.UnloadController)
            manager = ManagerClient(node, options.controller_manager, soon=soon)
            unload(node, manager, options.controller_names, options.switch_timeout)
        finally:
            node.destroy_node()


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: unspawn(args))


if __name__ == '__main__':
    sys.exit(main())
