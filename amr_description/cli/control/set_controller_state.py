# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Adjust the state of a controller.

unconfigured -> inactive configures it, inactive -> active activates it; active -> inactive
deactivates it, inactive -> unconfigured cleans it up.
"""

from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING

from amr_description.cli.control.manager import (
    add_controller_argument,
    add_manager_arguments,
    failure,
    open_manager,
)
from amr_description.colors import BLUE, colored
from amr_description.errors import AmrError

if TYPE_CHECKING:
    from amr_description.control.ros.client import ManagerClient

# What cannot be done, by what was asked for.
_REFUSALS = {
    'unconfigured': 'cannot cleanup {name} from its current state {state}',
    'inactive': "cannot put {name} in 'inactive' state from its current state {state}",
    'active': 'cannot activate {name} from its current state {state}',
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    add_controller_argument(parser, 'to be changed')
    parser.add_argument(
        'state', choices=list(_REFUSALS), help='State in which the controller should be changed to'
    )


def main(args: Namespace) -> int:
    """Take the one step that leads there; 0."""
    name = args.controller_name
    with open_manager(args) as manager:
        state = manager.states().get(name)
        if state is None:
            raise AmrError(f'controller {name} does not seem to be loaded')
        step = _STEPS.get((state, args.state))
        if step is None:
            raise AmrError(_REFUSALS[args.state].format(name=name, state=state))
        said = step(manager, name)
    print(colored(said, BLUE))
    return 0


def _configure(manager: 'ManagerClient', name: str) -> str:
    if not manager.configure(name):
        text = 'Error configuring controller, check controller_manager logs'
        raise failure(text, manager.logged(name))
    return f'Successfully configured {name}'


def _clean_up(manager: 'ManagerClient', name: str) -> str:
    if not manager.cleanup(name):
        text = 'Error cleaning up controller, check controller_manager logs'
        raise failure(text, manager.logged(name))
    return f'successfully cleaned up {name}'


def _activate(manager: 'ManagerClient', name: str) -> str:
    message = manager.switch(activate=[name])
    if message is not None:
        raise failure('Error activating controller, check controller_manager logs', message)
    return f'Successfully activated {name}'


def _deactivate(manager: 'ManagerClient', name: str) -> str:
    message = manager.switch(deactivate=[name])
    if message is not None:
        raise failure('Error stopping controller, check controller_manager logs', message)
    return f'Successfully deactivated {name}'


_STEPS = {
    ('unconfigured', 'inactive'): _configure,
    ('inactive', 'unconfigured'): _clean_up,
    ('inactive', 'active'): _activate,
    ('active', 'inactive'): _deactivate,
}
