# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 control`` that change something: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
import sys
from typing import TYPE_CHECKING

from amr_description.cli.arguments import positive_float, unicode_text
from amr_description.cli.control.manager import (
    add_controller_argument,
    add_manager_arguments,
    failure,
    open_manager,
)
from amr_description.colors import BLUE, colored, RED, YELLOW
from amr_description.errors import AmrError

if TYPE_CHECKING:
    from amr_description.control.ros.client import ManagerClient

# What cannot be done, by what was asked for.
_REFUSALS = {
    'unconfigured': 'cannot cleanup {name} from its current state {state}',
    'inactive': "cannot put {name} in 'inactive' state from its current state {state}",
    'active': 'cannot activate {name} from its current state {state}',
}
_BEST_EFFORT, _STRICT = 1, 2  # the constants of controller_manager_msgs/srv/SwitchController
_DEFAULT = 0  # the manager's own
# state -> what failed, if it was not reached
_DOING = {'unconfigured': 'cleaning up', 'inactive': 'stopping', 'active': 'activating'}


class LoadControllerVerb:
    """
    Load a controller in a controller manager.

    Its type and parameters are those that the manager has, or stand in the file.

    examples:
      ros2 control load_controller joint_state_broadcaster --set-state active
      ros2 control load_controller my_controller my_controllers.yaml
    """

    @staticmethod
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

    @staticmethod
    def main(args: Namespace) -> int:
        """Load, and bring to the state that is asked for; 0."""
        name = args.controller_name
        if args.param_file and not Path(args.param_file).is_file():
            raise AmrError(
                f'Controller parameter file : {args.param_file} does not exist, Aborting!'
            )
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


class _RemovalVerb:
    def __init__(self, about: str, doing: str, done: str) -> None:
        """``doing``, ``done``: in the words of the texts, ``cleaning up``, ``cleaned up``."""
        self.__doc__, self._doing, self._done = about, doing, done

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        add_controller_argument(parser, f'to be {self._done}')

    def main(self, args: Namespace) -> int:
        """Do so; 0."""
        name = args.controller_name
        with open_manager(args) as manager:
            remove = manager.unload if self._done == 'unloaded' else manager.cleanup
            if not remove(name):
                text = f'Error {self._doing} controller {name}, check controller_manager logs'
                raise failure(text, manager.logged(name))
        print(colored(f'Successfully {self._done} controller {name}', BLUE))
        return 0


UNLOAD_CONTROLLER = _RemovalVerb(
    'Unload a controller in a controller manager.', 'unloading', 'unloaded'
)
CLEANUP_CONTROLLER = _RemovalVerb(
    'Clean up a controller in a controller manager: inactive to unconfigured.',
    'cleaning up',
    'cleaned up',
)


class SetControllerStateVerb:
    """
    Adjust the state of a controller.

    unconfigured -> inactive configures it, inactive -> active activates it; active -> inactive
    deactivates it, inactive -> unconfigured cleans it up.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        add_controller_argument(parser, 'to be changed')
        parser.add_argument(
            'state',
            choices=list(_REFUSALS),
            help='State in which the controller should be changed to',
        )

    @staticmethod
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


class SwitchControllersVerb:
    """
    Switch controllers in a controller manager.

    All in one go: what is deactivated hands its interfaces over to what is activated.

    examples:
      ros2 control switch_controllers --deactivate diff_drive_controller
      ros2 control switch_controllers --strict --deactivate one --activate other another
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        for verb in ('deactivate', 'activate'):
            parser.add_argument(
                f'--{verb}',
                nargs='*',
                type=unicode_text,
                default=[],
                metavar='CONTROLLER',
                help=f'Names of the controllers to be {verb}d',
            )
        strictness = parser.add_mutually_exclusive_group()
        strictness.set_defaults(strictness=_DEFAULT)
        for flag, value, what in (
            ('--strict', _STRICT, 'Strict switch: all or nothing'),
            (
                '--best-effort',
                _BEST_EFFORT,
                'Best effort switch: leave out what cannot be switched',
            ),
        ):
            strictness.add_argument(
                flag, dest='strictness', action='store_const', const=value, help=what
            )
        parser.add_argument(
            '--activate-asap',
            action='store_true',
            help='Activate asap controllers as soon as their hardware allows it',
        )
        parser.add_argument(
            '--switch-timeout',
            type=positive_float,
            default=5.0,
            help='Timeout for switching controllers in seconds (default: 5.0)',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Switch, and print the manager's message; 0."""
        with open_manager(args) as manager:
            response = manager.request_switch(
                args.activate,
                args.deactivate,
                args.strictness,
                timeout=args.switch_timeout,
                activate_asap=args.activate_asap,
            )
        if not response.ok:
            raise AmrError(colored(response.message, RED, sys.stderr))
        print(colored(response.message, BLUE))
        return 0


class SetHardwareComponentStateVerb:
    """Adjust the state of a hardware component."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        parser.add_argument(
            'hardware_component_name',
            type=unicode_text,
            help='Name of the hardware component to be changed',
        )
        parser.add_argument(
            'state',
            choices=list(_DOING),
            help='State in which the hardware component should be changed to',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Bring it there; 0."""
        from lifecycle_msgs.msg import State

        number = getattr(State, f'PRIMARY_STATE_{args.state.upper()}')
        with open_manager(args) as manager:
            response = manager.set_component_state(
                args.hardware_component_name, State(id=number, label=args.state)
            )
            if not response.ok:
                text = (
                    f'Error {_DOING[args.state]} hardware component, check controller_manager logs'
                )
                raise failure(text, manager.logged())
        said = f'Successfully set {args.hardware_component_name} to state {response.state.label}'
        print(colored(said, BLUE))
        return 0


class ReloadControllerLibrariesVerb:
    """
    Reload controller libraries: unload every controller, and find their classes anew.

    Refused while a controller is active, unless forced.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        parser.add_argument(
            '--force-kill', action='store_true', help='Force stop of loaded controllers'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Do so; 0."""
        with open_manager(args) as manager:
            if not manager.reload_libraries(force_kill=args.force_kill):
                raise failure(
                    'Error reloading libraries, check controller_manager logs', manager.logged()
                )
        print(colored('Reload successful', BLUE))
        return 0
