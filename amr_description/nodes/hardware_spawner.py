# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``hardware_spawner``: configure or activate hardware components, and end.

Arguments and messages as the ``hardware_spawner`` of Jazzy's controller_manager. What is better
than there:

- it exits with 1 when a component is not where it was to be brought (there: 0 after a warning), so
  that what is started next does not meet hardware that is down; the other components are still
  brought there;
- a component that is not there is named, and those that are; a refusal has its reason;
- a manager that does not come is explained, as by ``spawner``.
"""

import argparse
from collections.abc import Sequence
import sys

from controller_manager_msgs import srv
from lifecycle_msgs.msg import State
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from amr_description.colors import colored, GREEN, YELLOW
from amr_description.control.ros.client import ManagerClient
from amr_description.controller_manager.spawner_arguments import seconds
from amr_description.errors import HardwareError
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import client_node

_TARGETS = {
    'activated': State(id=State.PRIMARY_STATE_ACTIVE, label='active'),
    'configured': State(id=State.PRIMARY_STATE_INACTIVE, label='inactive'),
}


def parser() -> argparse.ArgumentParser:
    """Make the parser, with the original's options and defaults."""
    options = argparse.ArgumentParser(
        prog='hardware_spawner', description='Configure or activate hardware components.'
    )
    options.add_argument(
        'hardware_component_names', nargs='+', metavar='NAME', help='components, in order'
    )
    action = options.add_mutually_exclusive_group(required=True)
    for flag, done, what in (
        ('--activate', 'activated', 'configure them, if they are not, and activate them'),
        ('--configure', 'configured', 'configure them; active ones are deactivated'),
    ):
        action.add_argument(flag, dest='action', action='store_const', const=done, help=what)
    options.add_argument(
        '-c',
        '--controller-manager',
        default='controller_manager',
        metavar='NODE',
        help='the controller manager (default: %(default)s, in the namespace of this node)',
    )
    options.add_argument(
        '--controller-manager-timeout',
        type=seconds,
        default=0.0,
        metavar='S',
        help='how long to wait for the manager, s; 0: for ever (default: %(default)s)',
    )
    return options


def bring(node: Node, manager: ManagerClient, names: Sequence[str], action: str) -> None:
    """
    Bring components to the state of ``action``, one by one.

    Raises HardwareError, which names those that are not there, after all were tried.
    """
    known = [component.name for component in manager.components()]
    failed = [
        name for name in dict.fromkeys(names) if not _bring_one(node, manager, name, action, known)
    ]
    if failed:
        raise HardwareError(f'not {action}: {", ".join(failed)}')


def _bring_one(
    node: Node, manager: ManagerClient, name: str, action: str, known: Sequence[str]
) -> bool:
    """Log the outcome as ros2_control does; return whether the state was reached."""
    log, target = node.get_logger(), _TARGETS[action]
    if name not in known:
        text = (
            'Hardware Component is not loaded - state can not be changed. There is no '
            f"'{name}'; {manager.name} has: {', '.join(known) or 'none'}"
        )
        log.warning(colored(text, YELLOW, sys.stderr))
        return False
    response = manager.set_component_state(name, target)
    if response.ok and response.state.id == target.id:
        text = f"{action} component '{name}'. Hardware now in state: {response.state}."
        log.info(colored(text, GREEN, sys.stderr))
        return True
    text = f"Could not {action} component '{name}'. Service call "
    if response.ok:
        text += f'returned ok=True, but state: {response.state} is not equal to target state '
        text += f"'{target}'."
    else:
        text += 'failed. Wrong component name? '
        text += manager.logged() or 'See the log of the manager.'
    log.warning(colored(text, YELLOW, sys.stderr))
    return False


def spawn(args: list[str] | None) -> None:
    """Configure or activate as the command line asks."""
    with ros(args):
        words = sys.argv if args is None else ['hardware_spawner', *args]
        options = parser().parse_args(remove_ros_args(words)[1:])
        node = client_node('hardware_spawner')
        try:
            manager = ManagerClient(
                node,
                options.controller_manager,
                timeout=options.controller_manager_timeout,
                first=srv.ListHardwareComponents,
                soon=[srv.SetHardwareComponentState],
            )
            bring(node, manager, options.hardware_component_names, options.action)
        finally:
            node.destroy_node()


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: spawn(args))


if __name__ == '__main__':
    sys.exit(main())
