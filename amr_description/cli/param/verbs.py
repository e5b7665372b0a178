# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 param``: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
import re
import sys
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text
from amr_description.cli.param.values import has_type, Value
from amr_description.errors import AmrError, ParameterError
from amr_description.parameter_files import dotted, EVERY_NODE, flatten, KEY, Section, sections

if TYPE_CHECKING:
    from rcl_interfaces.msg import ParameterDescriptor

    from amr_description.cli.param.remote import RemoteParameters
    from amr_description.cli.param.values import Value
    from amr_description.cli.session import Session


class ListVerb:
    """Output a list of available parameters."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser, optional=True)
        parser.add_argument(
            '--param-prefixes',
            nargs='+',
            type=unicode_text,
            default=[],
            help='Only list parameters with the provided prefixes',
        )
        parser.add_argument(
            '--param-type', action='store_true', help='Print parameter types with parameter names'
        )
        parser.add_argument(
            '--filter',
            type=_pattern,
            default=re.compile(''),
            help='Only list parameters whose names begin with a match of the regular expression',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """
        Print the parameters of a node, or of all nodes that have any; 0.

        A node that does not answer is told on stderr; 1 if it is the one that was asked for.
        """
        from amr_description.cli.param.remote import no_answer
        from amr_description.cli.param.requests import describe_all, list_all
        from amr_description.cli.param.values import TYPE_NAMES
        from amr_description.cli.session import open_session

        with open_session(use_sim_time=args.use_sim_time) as session:
            nodes = _nodes(session, args)
            found = {
                node: [name for name in names if args.filter.match(name)]
                for node, names in list_all(session, nodes, args.param_prefixes).items()
            }
            descriptors = describe_all(session, found) if args.param_type else {}
        for node in nodes:
            if node not in found:
                print(no_answer(node), file=sys.stderr)
                continue
            if not args.node_name:
                print(f'{node}:')
            for name in found[node]:
                descriptor = descriptors.get(node, {}).get(name)
                print(
                    f'  {name} (type: {TYPE_NAMES[descriptor.type]})'
                    if descriptor
                    else f'  {name}'
                )
        return 1 if args.node_name and not found else 0


def _nodes(session: 'Session', args: Namespace) -> Sequence[str]:
    """Return the full names of the nodes whose parameters are wanted. Raises AmrError."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery

    if args.node_name:
        timeout = max(args.timeout, args.spin_time or 0.0)
        return [graph.find_node(session, args.node_name, timeout)]
    wait_for_discovery(session, args.spin_time)
    services = dict(session.node.get_service_names_and_types())
    nodes = graph.nodes(session.node, hidden=args.include_hidden_nodes)
    names = sorted({node.full_name for node in nodes})
    return [name for name in names if f'{name}/list_parameters' in services]


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise ArgumentTypeError(f"'{text}' is not a regular expression: {error}") from error


class DescribeVerb:
    """Show descriptive information about declared parameters."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)
        parser.add_argument(
            'parameter_names', nargs='+', type=unicode_text, help='Names of the parameters'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print type, description and constraints of each; 0, or 1 if one is not declared."""
        from amr_description.cli.param.remote import remote_parameters

        names = args.parameter_names
        with remote_parameters(args) as parameters:
            known = parameters.descriptors(names)
            absent = [parameters.absence(name) for name in names if name not in known]
        for name in names:
            for line in lines(known[name]) if name in known else ():
                print(line)
        for line in absent:
            print(line, file=sys.stderr)
        return 1 if absent else 0


def lines(descriptor: 'ParameterDescriptor') -> Iterator[str]:
    """Yield what a descriptor says."""
    from amr_description.cli.param.values import TYPE_NAMES

    yield f'Parameter name: {descriptor.name}'
    yield f'  Type: {TYPE_NAMES[descriptor.type]}'
    if descriptor.description:
        yield f'  Description: {descriptor.description}'
    yield '  Constraints:'
    if descriptor.read_only:
        yield '    Read only: true'
    for bounds in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        yield f'    Min value: {bounds.from_value}'
        yield f'    Max value: {bounds.to_value}'
        if bounds.step:
            yield f'    Step: {bounds.step}'
    if descriptor.additional_constraints:
        yield f'    Additional constraints: {descriptor.additional_constraints}'


class GetVerb:
    """Get parameter."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)
        parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')
        parser.add_argument('--hide-type', action='store_true', help='Hide the type information')

    @staticmethod
    def main(args: Namespace) -> int:
        """Print type and value; 0."""
        from rclpy.parameter import parameter_value_to_python

        from amr_description.cli.param.remote import remote_parameters
        from amr_description.cli.param.values import TYPE_NAMES

        name = args.parameter_name
        with remote_parameters(args) as parameters:
            message = parameters.values([name]).get(name)
            if message is None:
                raise AmrError(f'Parameter not set: {parameters.absence(name)}')
        value = parameter_value_to_python(message)
        if args.hide_type:
            print(value)
        elif value is None:
            print('Parameter not set.')
        else:
            kind, is_array, _ = TYPE_NAMES[message.type].partition(' array')
            print(f'{kind.capitalize()} {"values are" if is_array else "value is"}: {value}')
        return 0


class SetVerb:
    """
    Set parameter.

    The value is YAML: 5 is an integer and 5.0 a double, which are not the same to a node; on, off,
    true and false are booleans; '"5"' is a string, '[1.0, 2.0]' an array. Before a value that
    begins with a dash and is not a plain number stands '--': ros2 param set /node limit -- -.inf
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)
        parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')
        parser.add_argument('value', help='Value of the parameter')

    @staticmethod
    def main(args: Namespace) -> int:
        """Set a parameter; 0 if the node took the value."""
        from amr_description.cli.param.remote import remote_parameters
        from amr_description.cli.param.values import typed

        name, value = args.parameter_name, typed(args.value)
        with remote_parameters(args) as parameters:
            result = parameters.set({name: value})[name]
            reason = f': {result.reason}' if result.reason else ''
            if not result.successful:
                explanation = parameters.explain(name, args.value)
                raise AmrError(f'Setting parameter failed{reason}{explanation}')
        print(f'Set parameter successful{reason}')
        return 0


class DeleteVerb:
    """Delete parameter."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)
        parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')

    @staticmethod
    def main(args: Namespace) -> int:
        """Undeclare a parameter; 0 if the node did so."""
        from amr_description.cli.param.remote import remote_parameters

        name = args.parameter_name
        with remote_parameters(args) as parameters:
            result = parameters.delete(name)
            reason = f': {result.reason}' if result.reason else ''
            if not result.successful:
                known = name in parameters.names()
                explanation = '' if known else f'; {parameters.absence(name)}'
                raise AmrError(f'Deleting parameter failed{reason}{explanation}')
        print(f'Deleted parameter successfully{reason}')
        return 0


class DumpVerb:
    """
    Show all of the parameters of a node in a YAML file format.

    examples:
      ros2 param dump /my_node > my_node.yaml
      ros2 run my_package my_node --ros-args --params-file my_node.yaml
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the file; 0."""
        from rclpy.parameter import parameter_value_to_python

        from amr_description.cli.param.remote import remote_parameters
        from amr_description.parameter_files import parameter_file_text

        with remote_parameters(args) as parameters:
            names = parameters.names()
            messages = parameters.values(names)
            node = parameters.node
        values = {
            name: parameter_value_to_python(messages[name]) if name in messages else None
            for name in names
        }
        print(parameter_file_text(node, values))
        return 0


class LoadVerb:
    """
    Load parameter file for a node.

    Only what the file says to this node is set: below its own name, and below patterns such as
    '/**'.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_remote_node_arguments(parser)
        parser.add_argument('parameter_file', type=Path, help='Parameter file')
        parser.add_argument(
            '--no-use-wildcard',
            action='store_true',
            help="Do not load parameters in the '/**' namespace into the node",
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Set what the file says; 0 if the node has those values now."""
        from amr_description.cli.param.remote import remote_parameters
        from amr_description.cli.param.values import as_text
        from amr_description.parameter_files import read_parameter_file

        content = read_parameter_file(args.parameter_file)
        refused = {}
        with remote_parameters(args) as parameters:
            try:
                values = select(content, parameters.node, wildcards=not args.no_use_wildcard)
            except ParameterError as error:
                raise ParameterError(f'{args.parameter_file}: {error}') from error
            for name, result in parameters.set(values).items():
                reason = f': {result.reason}' if result.reason else ''
                if result.successful:
                    print(f'Set parameter {name} successful{reason}')
                else:
                    refused[name] = values[name]
                    explanation = parameters.explain(name, as_text(values[name]))
                    print(f'Set parameter {name} failed{reason}{explanation}', file=sys.stderr)
            return 0 if _has(parameters, refused) else 1


def _has(parameters: 'RemoteParameters', values: Mapping[str, 'Value']) -> bool:
    """Tell whether a node has the values that it refused: what ``dump`` wrote may be read-only."""
    from rclpy.parameter import parameter_value_to_python

    from amr_description.cli.param.values import as_text

    found = parameters.values(list(values))
    return all(
        name in found and as_text(parameter_value_to_python(found[name])) == as_text(value)
        for name, value in values.items()
    )


def select(content: Mapping[Any, Any], node: str, *, wildcards: bool = True) -> dict[str, Value]:
    """
    Return the parameters of a node in a parameter file, by dotted names.

    The most particular section wins: ``/**`` comes first, then other patterns, then the node's
    full name. Values that have no type in ROS become strings.

    Args:
        content: the file as YAML gives it.
        node: the full name of the node.
        wildcards: whether sections with ``*`` in their names count.

    Raises:
        ParameterError: there is nothing for this node, or it is not a mapping.
    """
    found = list(sections(content))
    chosen = [s for s in found if (wildcards or '*' not in s.pattern) and s.is_of(node)]
    if not chosen:
        names = ', '.join(dict.fromkeys(section.pattern for section in found))
        raise ParameterError(f'no parameters for {node} in it, only for {names}')
    chosen.sort(key=lambda section: (section.pattern != EVERY_NODE, '*' not in section.pattern))
    values = {dotted(keys): v for section in chosen for keys, v in flatten(_table(section))}
    return {k: v if has_type(v) else str(v) for k, v in values.items() if v is not None}


def _table(section: Section) -> Mapping[Any, Any]:
    if not isinstance(section.parameters, dict):
        raise ParameterError(
            f'{KEY} of {section.pattern} is expected to be a mapping, found {section.parameters!r}'
        )
    return section.parameters
