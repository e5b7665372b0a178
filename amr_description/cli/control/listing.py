# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 control`` that only look: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from operator import attrgetter
from typing import Any

from amr_description.cli.control.manager import add_manager_arguments, ask
from amr_description.colors import BLUE, colored, CYAN, GREEN, MAGENTA, RED, YELLOW

HARDWARE = 'hardware'


def owner_of(interface: str, controllers: Sequence[Any]) -> str:
    """Return the controller that a command interface leads to, or :data:`HARDWARE`."""
    for controller in controllers:
        references = (f'{controller.name}/{name}' for name in controller.reference_interfaces)
        if interface in references:
            return controller.name
    return HARDWARE


def commands(controller: Any, controllers: Sequence[Any]) -> dict[str, list[str]]:
    """Return target -> the interfaces by which a controller commands it."""
    targets: dict[str, list[str]] = {}
    for interface in controller.required_command_interfaces:
        targets.setdefault(owner_of(interface, controllers), []).append(interface)
    return targets


def tree(controllers: Sequence[Any]) -> Iterator[str]:
    """Yield a tree for each controller that no other commands."""
    by_name = {controller.name: controller for controller in controllers}
    commanded = {name for c in controllers for name in commands(c, controllers) if name != c.name}
    for controller in controllers:
        if controller.name not in commanded:
            yield f'{controller.name} [{controller.state}]'
            yield from _branches(controller, by_name, (controller.name,))


def _branches(controller: Any, by_name: dict[str, Any], above: tuple[str, ...]) -> Iterator[str]:
    indent = '    ' * len(above)
    for target, interfaces in commands(controller, list(by_name.values())).items():
        state = f' [{by_name[target].state}]' if target in by_name else ''
        yield f'{indent}-> {target}{state}: {", ".join(interfaces)}'
        if target in by_name and target not in above:
            yield from _branches(by_name[target], by_name, (*above, target))


def dot(controllers: Sequence[Any]) -> Iterator[str]:
    """Yield the lines of a directed graph of controllers, hardware and command interfaces."""
    yield 'digraph controllers {'
    yield '    rankdir=LR;'
    yield '    node [shape=box];'
    yield f'    {_quoted(HARDWARE)} [shape=cylinder];'
    for controller in controllers:
        style = 'solid' if controller.state == 'active' else 'dashed'
        label = f'{controller.name}\n{controller.type}\n{controller.state}'
        yield f'    {_quoted(controller.name)} [label={_quoted(label)}, style={style}];'
    for controller in controllers:
        for target, interfaces in commands(controller, controllers).items():
            yield _edge(controller.name, target, interfaces)
        if controller.required_state_interfaces:
            yield _edge(HARDWARE, controller.name, controller.required_state_interfaces)
    yield '}'


def _edge(source: str, target: str, interfaces: Sequence[str]) -> str:
    label = _quoted('\n'.join(interfaces))
    return f'    {_quoted(source)} -> {_quoted(target)} [label={label}];'


def _quoted(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"').replace('\n', '\\n')
    return f'"{escaped}"'


_STATE_COLORS = {'active': GREEN, 'inactive': CYAN, 'unconfigured': YELLOW}
_COMPONENT_COLORS = {
    'active': GREEN,
    'inactive': MAGENTA,
    'unconfigured': YELLOW,
    'finalized': RED,
}


class ListControllersVerb:
    """Output the list of loaded controllers, their type and status."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        for flag, what in (
            ('--claimed-interfaces', "List controller's claimed interfaces"),
            ('--required-state-interfaces', "List controller's required state interfaces"),
            ('--required-command-interfaces', "List controller's required command interfaces"),
            ('--chained-interfaces', 'List interfaces that the controllers are chained to'),
            ('--reference-interfaces', "DEPRECATED: List controller's exported references"),
            ('--exported-interfaces', "List controller's exported state and reference interfaces"),
        ):
            parser.add_argument(flag, action='store_true', help=what)
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help="List controller's claimed interfaces, required state interfaces and required "
            'command interfaces',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a line per controller; 0."""
        from controller_manager_msgs.srv import ListControllers

        response = ask(args, ListControllers)
        if not response.controller:
            print('No controllers are currently loaded!')
        for line in controller_lines(response.controller, args):
            print(line)
        return 0


def controller_lines(controllers: Sequence[Any], args: Namespace) -> Iterator[str]:
    """Yield the table: name, type and state, each column as wide as its longest entry."""
    name_width, type_width, state_width = (
        max((len(getattr(c, column)) for c in controllers), default=0)
        for column in ('name', 'type', 'state')
    )
    for controller in controllers:
        color = _STATE_COLORS.get(controller.state, '')
        name = colored(f'{controller.name:{name_width}}', color)
        state = colored(f'{controller.state:{state_width}}', color)
        yield f'{name} {controller.type:{type_width}}  {state}'
        yield from _details(controller, args)


def _details(controller: Any, args: Namespace) -> Iterator[str]:
    """Yield what the flags ask for, indented by tabs."""
    if args.verbose:
        yield f'\tupdate_rate: {controller.update_rate} Hz'
        yield f'\tis_async: {controller.is_async}'
    chained = [name for link in controller.chain_connections for name in link.reference_interfaces]
    references = args.reference_interfaces or args.exported_interfaces
    for wanted, title, names in (
        (args.claimed_interfaces, 'claimed', controller.claimed_interfaces),
        (
            args.required_command_interfaces,
            'required command',
            controller.required_command_interfaces,
        ),
        (args.required_state_interfaces, 'required state', controller.required_state_interfaces),
    ):
        if wanted or args.verbose:
            yield from _block(f'{title} interfaces:', names)
    if args.chained_interfaces or args.verbose:
        yield from _block('chained to interfaces:', chained)
    if references or args.verbose:
        yield from _block('exported reference interfaces:', controller.reference_interfaces)
    if args.exported_interfaces or args.verbose:
        yield from _block('exported state interfaces:', controller.exported_state_interfaces)


def _block(title: str, names: Sequence[str]) -> Iterator[str]:
    yield f'\t{title}'
    for name in names:
        yield f'\t\t{name}'


class ListControllerTypesVerb:
    """Output the available controller types and their base classes."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a line per type; 0."""
        from controller_manager_msgs.srv import ListControllerTypes

        response = ask(args, ListControllerTypes)
        for name, base_class in zip(response.types, response.base_classes, strict=True):
            print(f'{name:70} {base_class}')
        return 0


class ListHardwareComponentsVerb:
    """Output the list of available hardware components."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='List the state interfaces, too, and the data type of each interface',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a block per component; 0."""
        from controller_manager_msgs.srv import ListHardwareComponents

        response = ask(args, ListHardwareComponents)
        for number, component in enumerate(response.component, start=1):
            for line in component_lines(number, component, args.verbose):
                print(line)
        return 0


def component_lines(number: int, component: Any, verbose: bool) -> Iterator[str]:
    """Yield the block of one component."""
    color = _COMPONENT_COLORS.get(component.state.label, '')
    plugin = component.plugin_name or component.class_type
    yield f'Hardware Component {number}'
    yield f'\tname: {colored(component.name, color)}'
    yield f'\ttype: {component.type}'
    yield f'\tplugin name: {plugin or colored("plugin name missing!", YELLOW)}'
    yield f'\tstate: id={component.state.id} label={colored(component.state.label, color)}'
    yield f'\tread/write rate: {component.rw_rate} Hz'
    yield f'\tis_async: {component.is_async}'
    yield '\tcommand interfaces'
    for interface in component.command_interfaces:
        claimed = colored('[claimed]', BLUE) if interface.is_claimed else '[unclaimed]'
        yield f'\t\t{_available(interface, verbose)} {claimed}'
    if verbose:
        yield '\tstate interfaces'
        for interface in component.state_interfaces:
            yield f'\t\t{_available(interface, verbose)}'


def _available(interface: Any, verbose: bool) -> str:
    data_type = f' [{interface.data_type}]' if verbose else ''
    if interface.is_available:
        return f'{interface.name}{data_type} {colored("[available]", BLUE)}'
    return f'{interface.name}{data_type} {colored("[unavailable]", YELLOW)}'


class ListHardwareInterfacesVerb:
    """Output the list of available command and state interfaces."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        parser.add_argument(
            '-v', '--verbose', action='store_true', help='Show the data type of each interface'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a line per interface, by name; 0."""
        from controller_manager_msgs.srv import ListHardwareInterfaces

        response = ask(args, ListHardwareInterfaces)
        for line in interface_lines(response, args.verbose):
            print(line)
        return 0


def interface_lines(response: Any, verbose: bool) -> Iterator[str]:
    """Yield the text of a response: command interfaces, then state interfaces."""
    yield 'command interfaces'
    for interface in sorted(response.command_interfaces, key=attrgetter('name')):
        available = '[available]' if interface.is_available else '[unavailable]'
        claimed = '[claimed]' if interface.is_claimed else '[unclaimed]'
        color = BLUE if interface.is_claimed else CYAN
        text = f'{_name(interface, verbose)} {available} {claimed}'
        yield f'\t{colored(text, color if interface.is_available else YELLOW)}'
    yield 'state interfaces'
    for interface in sorted(response.state_interfaces, key=attrgetter('name')):
        yield f'\t{_name(interface, verbose)}'


def _name(interface: Any, verbose: bool) -> str:
    return f'{interface.name} [{interface.data_type}]' if verbose else interface.name


class ViewControllerChainsVerb:
    """
    Show which controller commands which, down to the hardware.

    --dot prints the graph for Graphviz, as the original's /tmp/controller_diagram.gv.pdf shows it:

      ros2 control view_controller_chains --dot | dot -Tpdf > controller_diagram.pdf
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_manager_arguments(parser)
        parser.add_argument(
            '--dot', action='store_true', help='Print the graph in the DOT language'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the chains; 0."""
        from controller_manager_msgs.srv import ListControllers

        response = ask(args, ListControllers)
        if not response.controller and not args.dot:
            print('No controllers are currently loaded!')
        for line in dot(response.controller) if args.dot else tree(response.controller):
            print(line)
        return 0
