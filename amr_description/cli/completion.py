# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tab completion: what may come next on a command line of ``ros2``.

On Tab the shell runs ``ros2`` itself, with the line in its environment (scripts/activate registers
that). Our parsers tell where on it the cursor is, argcomplete reads them; names of verbs, flags
and choices are theirs. What else there is to choose from is told by a function of
:mod:`~amr_description.cli.completers`, found by the name of the argument. It is imported only
then, so that nothing but what is fed from the graph takes the time of a discovery.
"""

from argparse import Action, Namespace
from collections.abc import Iterable
import os
import shlex
from typing import Any, NoReturn

from amr_description.cli.completers import COMPLETERS
from amr_description.cli.lazy_parser import LazyParser
from amr_description.errors import AmrError
from amr_description.registry import resolve


class Completer:
    """One of the functions of :mod:`~amr_description.cli.completers`, for argcomplete."""

    def __init__(self, name: str) -> None:
        """``name``: ``module:function``; it is imported when it is called."""
        self._name = name

    def __call__(self, *, prefix: str, parsed_args: Namespace, **_more: Any) -> Iterable[str]:
        """Return the words to choose from; argcomplete leaves out what does not fit."""
        try:
            function = resolve(f'amr_description.cli.completers.{self._name}')
            found = list(function(parsed_args, prefix))
        except AmrError:  # nobody can be told amid a line
            return []
        if prefix and not prefix.startswith('/'):  # names are understood without their slash, too
            found += [word.removeprefix('/') for word in found if word.startswith('/')]
        return found


def complete(parser: LazyParser) -> NoReturn:
    """Tell the shell, and end the process."""
    import argcomplete
    from argcomplete.completers import SuppressCompleter

    line = os.environ['COMP_LINE'][: int(os.environ['COMP_POINT'])]
    parsers = parser.expand(_words(line))
    for action in parsers[-1]._actions:
        name = _completer_of(parsers[-1], action)
        if name:
            action.completer = Completer(name)
    argcomplete.autocomplete(
        parser,
        always_complete_options=False,
        exclude=['-h', '--help'],
        default_completer=SuppressCompleter(),
    )
    raise SystemExit(1)  # it has ended the process


def _words(line: str) -> list[str]:
    """Return the finished words after the name of the program."""
    try:
        words = shlex.split(line)
    except ValueError:  # an open quotation, which is of the last word
        words = line.split()
    return words[1:] if line.endswith(' ') else words[1:-1]


def _completer_of(parser: LazyParser, action: Action) -> str | None:
    verb = parser.prog.partition(' ')[2]
    return COMPLETERS.get(f'{verb} {action.dest}') or COMPLETERS.get(action.dest)
