# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 interface``: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
import sys
from typing import Any

from amr_description.cli.interface.definition import kind_of, KINDS
from amr_description.errors import UsageError

_TITLES = {'msg': 'Messages:', 'srv': 'Services:', 'action': 'Actions:'}
_STDIN = '-'


def add_kind_arguments(parser: ArgumentParser) -> None:
    """Add a flag for each kind."""
    for kind, word in KINDS.items():
        parser.add_argument(
            f'-{kind[0]}',
            f'--only-{kind}s',
            action='store_true',
            help=f'Print out only the {word} types',
        )


def wanted_kinds(args: Namespace) -> list[str]:
    """Return the kinds that the flags select; without flags all of them."""
    chosen = [kind for kind in KINDS if getattr(args, f'only_{kind}s')]
    return chosen or list(KINDS)


class ListVerb:
    """List all interface types available."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_kind_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the types, sorted, below a heading for each kind; 0."""
        from amr_description.cli.interface.index import all_interfaces

        known = all_interfaces()
        for kind in wanted_kinds(args):
            print(_TITLES[kind])
            for package, names in known.items():
                for name in names:
                    if kind_of(name) == kind:
                        print(f'    {package}/{name}')
        return 0


class PackageVerb:
    """Output a list of available interface types within one package."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_kind_arguments(parser)
        parser.add_argument(
            'package_name', help="Name of the ROS package (e.g. 'example_interfaces')"
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print one type per line; 0."""
        from amr_description.cli.interface.index import interfaces_of

        kinds = wanted_kinds(args)
        for name in interfaces_of(args.package_name):
            if kind_of(name) in kinds:
                print(f'{args.package_name}/{name}')
        return 0


class PackagesVerb:
    """Output a list of packages that provide interfaces."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_kind_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print one package per line; 0."""
        from amr_description.cli.interface.index import all_interfaces

        kinds = wanted_kinds(args)
        for package, names in all_interfaces().items():
            if any(kind_of(name) in kinds for name in names):
                print(package)
        return 0


class ProtoVerb:
    """
    Output an interface prototype.

    Of a service the request is printed, of an action the goal: what 'ros2 service call' and 'ros2
    action send_goal' want to be given.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument(
            'type', help="Show an interface definition (e.g. 'std_msgs/msg/String')"
        )
        parser.add_argument(
            '--no-quotes', action='store_true', help='if true output has no outer quotes.'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a message with its defaults, as YAML; 0."""
        from amr_description.ros.message_text import Style, to_yaml

        text = to_yaml(_message_class(args.type)(), Style(truncate_length=None))
        print(text if args.no_quotes else f'"{text}"')
        return 0


def _message_class(name: str) -> Any:
    from amr_description.cli.interface.index import split_name
    from amr_description.ros.message_types import action_type, message_type, service_type

    _, kind, _ = split_name(name)
    if kind == 'srv':
        return service_type(name).Request
    return action_type(name).Goal if kind == 'action' else message_type(name)


class ShowVerb:
    """
    Output the interface definition.

    examples:
      ros2 interface show geometry_msgs/msg/TwistStamped
      ros2 topic type /chatter | ros2 interface show -
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        comments = parser.add_mutually_exclusive_group()
        comments.add_argument(
            '--all-comments',
            action='store_true',
            help='Show all comments, including for nested interface definitions',
        )
        comments.add_argument(
            '--no-comments', action='store_true', help='Show no comments or whitespace'
        )
        parser.add_argument(
            'type',
            help="Show an interface definition (e.g. 'example_interfaces/msg/String'). Passing "
            "'-' reads the argument from stdin (e.g. 'ros2 topic type /chatter | ros2 interface "
            "show -').",
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the definition, and below each field that of its type; 0."""
        from amr_description.cli.interface.definition import Comments, expand
        from amr_description.cli.interface.index import read_definition

        name = _from_stdin() if args.type == _STDIN else args.type
        comments = Comments(at_top=not args.no_comments, below=args.all_comments)
        for line in expand(name, read_definition, comments):
            print(line)
        return 0


def _from_stdin() -> str:
    """Return the first line of stdin. Raises UsageError."""
    if sys.stdin is None or sys.stdin.isatty():
        raise UsageError("expected stdin pipe: '-' stands for what another command writes")
    name = sys.stdin.buffer.readline().decode(errors='replace').strip()
    if not name:
        raise UsageError('the passed value is empty: nothing came from stdin')
    return name
