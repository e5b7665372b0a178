# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A command line read by tables.

A table maps the name of a command or verb to its module. Such a module has a docstring, whose
first line is the help and whose rest stands below the arguments, and either

- ``main(args) -> int``, and ``add_arguments(parser)``: a verb; or
- ``VERBS``, a table of its own, and perhaps ``add_arguments(parser)``: a group of verbs.

It is imported when a command line reaches it, or when its line of help is printed.
"""

import argparse
from argparse import _SubParsersAction
from collections.abc import Mapping, Sequence
import importlib
from itertools import dropwhile, takewhile
from types import ModuleType
from typing import Any


class LazyParser(argparse.ArgumentParser):
    """
    A parser that learns from its module what it reads, once it has to read.

    Options may stand between words that may be left out, wherever ``argparse`` can read that.
    """

    def __init__(self, *args: Any, module: str = '', **kwargs: Any) -> None:
        """Take the dotted name of the module, besides the arguments of ``ArgumentParser``."""
        kwargs.setdefault('formatter_class', argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **kwargs)
        self._module = module
        self._table: Mapping[str, str] = {}
        self._mixes = True

    def parse_known_args(
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Import the module first."""
        if self._module:
            self._learn(importlib.import_module(self._module))
        if self._table:
            self._add_table(args or ())
        if not (self._mixes and self._can_mix(args or ())):
            return super().parse_known_args(args, namespace)
        self._mixes = False  # it calls this method, for options and for positional words
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self._mixes = True

    def expand(self, words: Sequence[str]) -> 'list[LazyParser]':
        """
        Learn what these words of a command line need, for one who looks at parsers from outside.

        Returns the parsers that the words lead to, this one first. They read words in order.
        """
        self._mixes = False
        if self._module:
            self._learn(importlib.import_module(self._module))
        if not self._table:
            return [self]
        table = self._table
        subparsers = self._add_table(words, with_help=True)
        rest = list(dropwhile(lambda word: word not in table, words))
        return [self, *(subparsers.choices[rest[0]].expand(rest[1:]) if rest else [])]

    def _can_mix(self, args: Sequence[str]) -> bool:
        """Tell whether ``argparse`` can do it: no ``--``, open end, or alternative to a word."""
        words = self._get_positional_actions()
        open_ended = [a for a in words if a.nargs in (argparse.PARSER, argparse.REMAINDER)]
        groups = [group._group_actions for group in self._mutually_exclusive_groups]
        alternatives = {a for group in groups for a in group}
        return '--' not in args and not open_ended and alternatives.isdisjoint(words)

    def read_table(self, table: Mapping[str, str]) -> None:
        """Read one name of a table, and hand what follows it to the parser of its module."""
        self._table = table

    def _learn(self, module: ModuleType) -> None:
        self._module = ''
        self.description, self.epilog = _description(module), _epilog(module)
        if hasattr(module, 'add_arguments'):
            module.add_arguments(self)
        if hasattr(module, 'VERBS'):
            self.read_table(module.VERBS)
        else:
            self.set_defaults(main=module.main)

    def _add_table(
        self, args: Sequence[str], *, with_help: bool = False
    ) -> '_SubParsersAction[LazyParser]':
        """Add the names of the table; with their lines of help only if those are to be seen."""
        table, self._table = self._table, {}
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
            about = {'help': _description(importlib.import_module(module))} if with_help else {}
            subparsers.add_parser(name, module=module, **about)
        return subparsers


def run(parser: LazyParser, argv: Sequence[str]) -> int:
    """Read a command line and run the verb that it names; print the help if it names none."""
    args = parser.parse_args(argv)
    return args.main(args)


def _asks_for_help(args: Sequence[str], table: Mapping[str, str]) -> bool:
    """Tell whether the lines of help will be printed: on demand, or where no name is given."""
    before_name = list(takewhile(lambda word: word not in table, args))
    return len(before_name) == len(args) or not {'-h', '--help'}.isdisjoint(before_name)


def _listing(table: Mapping[str, str]) -> str:
    width = max(map(len, table))
    modules = {name: importlib.import_module(module) for name, module in sorted(table.items())}
    return '\n'.join(f'{name:{width}}  {_description(m)}' for name, m in modules.items())


def _description(module: ModuleType) -> str:
    return (module.__doc__ or '').strip().partition('\n')[0].removesuffix('.')


def _epilog(module: ModuleType) -> str:
    return (module.__doc__ or '').strip().partition('\n')[2].strip()
