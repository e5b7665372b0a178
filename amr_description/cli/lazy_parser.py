# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A parser for commands and verbs that imports only the modules that a command line needs.

A table maps the name of a command or verb to its module, or to ``module:name`` of a class or
object in one that has several verbs. Each of these has a docstring, whose first line is the help
and whose rest is printed below the arguments, and either

- ``main(args) -> int``, and ``add_arguments(parser)``: a verb; or
- ``VERBS``, a table of its own, and optionally ``add_arguments(parser)``: a group of verbs. With
  ``main`` as well, that is called where no verb is given.

It is imported when a command line reaches it, or when its line of help is printed.
"""

import argparse
from argparse import _SubParsersAction
from collections.abc import Callable, Mapping, Sequence
import importlib
from itertools import dropwhile, takewhile
from textwrap import dedent
from typing import Any

from amr_description.text import closest_match

INSTEAD_OF_COMMANDS = {
    'ros2 component': 'components are C++ nodes, of which there are none here; start nodes with '
    '`ros2 run` and `ros2 launch`',
    'ros2 multicast': 'see with `ros2 doctor hello` on both machines whether they hear each other '
    '(docs/two_machines.md)',
    'ros2 plugin': 'plugins of C++ are not read here; those of the controller manager are listed '
    'by `ros2 control list_controller_types`',
    'ros2 security': 'there are no enclaves; keep a robot to this host, or to one network, with '
    'ROS_AUTOMATIC_DISCOVERY_RANGE (docs/two_machines.md)',
    'ros2 test': 'write tests for pytest (docs/test_your_robot.md), run by `colcon test`',
    'ros2 trace': 'see the times of the control loop with `ros2 topic echo /diagnostics`',
}
"""By command, or command and verb, of ROS, that is not here: what would do."""


class LazyParser(argparse.ArgumentParser):
    """
    A parser that imports its module, for the arguments, when it parses.

    Options may stand between optional positional arguments, wherever ``argparse`` supports that.
    """

    def __init__(self, *args: Any, module: str = '', **kwargs: Any) -> None:
        """``module``: its dotted name; the rest as for ``ArgumentParser``."""
        kwargs.setdefault('formatter_class', argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **kwargs)
        self._module = module
        self._table: Mapping[str, str] = {}
        self._main: Callable[[argparse.Namespace], int] | None = None
        self._intermixed = True

    def parse_known_args(
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Import the module first."""
        if self._module:
            self._load(imported(self._module))
        if self._table:
            self._add_table(args or ())
        if not (self._intermixed and self._can_intermix(args or ())):
            return super().parse_known_args(args, namespace)
        self._intermixed = False  # it calls this method, for options and for positional arguments
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self._intermixed = True

    def expand(self, words: Sequence[str]) -> 'list[LazyParser]':
        """
        Load all parsers for these words of a command line, for argcomplete.

        Returns:
            This parser, and those of the command and verb. They do not intermix arguments.
        """
        self._intermixed = False
        if self._module:
            self._load(imported(self._module))
        if not self._table:
            return [self]
        table = self._table
        subparsers = self._add_table(words, with_help=True)
        rest = list(dropwhile(lambda word: word not in table, words))
        return [self, *(subparsers.choices[rest[0]].expand(rest[1:]) if rest else [])]

    def _can_intermix(self, args: Sequence[str]) -> bool:
        """Return whether argparse supports that: no ``--``, open end, or alternative to a word."""
        words = self._get_positional_actions()
        open_ended = [a for a in words if a.nargs in (argparse.PARSER, argparse.REMAINDER)]
        groups = [group._group_actions for group in self._mutually_exclusive_groups]
        alternatives = {a for group in groups for a in group}
        return '--' not in args and not open_ended and alternatives.isdisjoint(words)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Say what to do instead of a verb that the original has, or which one could be meant."""
        instead = None
        if isinstance(action, _SubParsersAction) and value not in action.choices:
            instead = INSTEAD_OF_COMMANDS.get(f'{self.prog} {value}')
        if instead:
            self.exit(2, f'{self.prog} {value} is not offered here: {instead}\n')
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            close = closest_match(str(value), [str(each) for each in action.choices or ()])
            error.message += f"\ndid you mean '{close}'?" if close else ''
            raise

    def read_table(self, table: Mapping[str, str]) -> None:
        """Parse a name of the table, and the following words with the parser of its module."""
        self._table = table

    def _load(self, module: Any) -> None:
        self._module = ''
        self.description, self.epilog = _description(module), _epilog(module)
        if hasattr(module, 'add_arguments'):
            module.add_arguments(self)
        if hasattr(module, 'VERBS'):
            self.read_table(module.VERBS)
        if hasattr(module, 'main'):
            self._main = module.main
            self.set_defaults(main=module.main)

    def _add_table(
        self, args: Sequence[str], *, with_help: bool = False
    ) -> '_SubParsersAction[LazyParser]':
        """Add the names of the table; with lines of help only if they will be printed."""
        table, self._table = self._table, {}
        if self._main is None:
            self.set_defaults(main=lambda _args: self.print_help() or 0)
        call = f'Call `{self.prog} <command> -h` for more detailed usage.'
        subparsers = self.add_subparsers(
            title='Commands',
            description=_listing(table) if _asks_for_help(args, table) else None,
            metavar=call,
            prog=self.prog,
            parser_class=LazyParser,
        )
        for name, module in table.items():
            about = {'help': _description(imported(module))} if with_help else {}
            subparsers.add_parser(name, module=module, **about)
        return subparsers


def run(parser: LazyParser, argv: Sequence[str]) -> int:
    """Parse a command line and run its verb; without a verb, print the help."""
    args = parser.parse_args(argv)
    return args.main(args)


def _asks_for_help(args: Sequence[str], table: Mapping[str, str]) -> bool:
    """Return whether lines of help will be printed: on request, or without a name."""
    before_name = list(takewhile(lambda word: word not in table, args))
    return len(before_name) == len(args) or not {'-h', '--help'}.isdisjoint(before_name)


def _listing(table: Mapping[str, str]) -> str:
    width = max(map(len, table))
    modules = {name: imported(module) for name, module in sorted(table.items())}
    return '\n'.join(f'{name:{width}}  {_description(m)}' for name, m in modules.items())


def imported(name: str) -> Any:
    """Return a command or verb of a table."""
    module, _, attribute = name.partition(':')
    found = importlib.import_module(module)
    return getattr(found, attribute) if attribute else found


def _description(module: Any) -> str:
    return (module.__doc__ or '').strip().partition('\n')[0].removesuffix('.')


def _epilog(module: Any) -> str:
    return dedent((module.__doc__ or '').strip().partition('\n')[2]).strip()
