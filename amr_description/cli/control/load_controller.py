# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Load a controller in a controller manager.

Its type and parameters are those that the manager has, or stand in the file.

examples:
  ros2 control load_controller joint_state_broadcaster --set-state active
  ros2 control load_controller my_controller my_controllers.yaml
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from amr_description.cli.control.manager import (
    add_controller_argument,
    add_manager_arguments,
    failure,
    open_manager,
)
from amr_description.colors import BLUE, colored, YELLOW
from amr_description.errors import AmrError

if TYPE_CHECKING:
    from amr_description.control.ros.client import ManagerClient


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    add_controller_argument(parser, 'to be loaded')
    parser.add_argument('param_file', nargs='?', help='The controller param file to be loaded')
    parser.add_argument(
        '--set-state',
        choices=['inactive', 'active'],
        help='Set the state of the loaded controller',
    )


def main(args: Namespace) -> int:
    """Load, and bring to the state that is asked for; 0."""
    name = args.controller_name
    if args.param_file and not Path(args.param_file).is_file():
        raise AmrError(f'Controller parameter file : {args.param_file} does not exist, Aborting!')
    with open_manager(args) as manager:
        state = manager.states().get(name)
        if state is None:
            _load(manager, name, args.param_file)
            state = 'unconfigured'
        else:
            said = f'Controller : {name} already loaded, skipping load_controller!'
            print(colored(said, YELLOW))
        if args.set_state:
            _bring_to(manager, name, state, args.set_state)
            said = f'Successfully loaded controller {name} into state {args.set_state}'
            print(colored(said, BLUE))
    return 0


def _load(manager: 'ManagerClient', name: str, file: str | None) -> None:
    from amr_description.controller_manager.spawner_files import (
        controller_entries,
        manager_parameters,
        not_found,
    )

    if file:
        files = [str(Path(file).absolute())]
        entries = controller_entries(name, files, manager.namespace)
        if not entries:
            raise AmrError(not_found(name, files))
        manager.set_parameters(name, manager_parameters(name, entries))
    if not manager.load(name):
        text = f'Failed loading controller {name} check controller_manager logs'
        raise failure(text, manager.reasons(name))
    print(colored(f'Successfully loaded controller {name}', BLUE))


def _bring_to(manager: 'ManagerClient', name: str, state: str, target: str) -> None:
    if state == 'active' and target == 'inactive':
        raise AmrError(
            f'Controller : {name} is active; to deactivate it: '
            f'ros2 control set_controller_state {name} inactive'
        )
    if state not in ('inactive', 'active') and not manager.configure(name):
        raise failure(f'Error configuring controller : {name}', manager.logged(name))
    if target == 'active' and state != 'active':
        message = manager.switch(activate=[name])
        if message is not None:
            raise failure(f'Error activating controller : {name}', message)
