# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tab completion of ``ros2``.

On Tab the shell runs ``ros2`` with the command line in its environment (scripts/activate registers
that). argcomplete completes verbs, flags and choices from our parsers. Other arguments are
completed by a function of :mod:`~amr_description.cli.completers`, found by the name of the
argument and imported only then, so only arguments from the graph take the time of a discovery.
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
        """Return the possible words; argcomplete removes those without the prefix."""
        try:
            function = resolve(f'amr_description.cli.completers.{self._name}')
            found = list(function(parsed_args, prefix))
        except AmrError:  # an error cannot be shown within a command line
            return []
        if prefix and not prefix.startswith('/'):  # names are valid without their slash, too
            found += [word.removeprefix('/') for word in found if word.startswith('/')]
        return found


def complete(parser: LazyParser) -> NoReturn:
    """Print the completions for the shell, and end the process."""
    import argcomplete
    from argcomplete.completers import SuppressCompleter

    line = os.environ['COMP_LINE'][: int(os.environ['COMP_POINT'])]
    parsers = parser.expand(_words(line))
    for action in parsers[-1]._actions:
        name = _completer_of(parsers[-1], action)
        if name:
            action.completer = Completer(name)  # type: ignore[attr-defined]  # for argcomplete
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
    except ValueError:  # an open quote, in the last word
        words = line.split()
    return words[1:] if line.endswith(' ') else words[1:-1]


def _completer_of(parser: LazyParser, action: Action) -> str | None:
    verb = parser.prog.partition(' ')[2]
    return COMPLETERS.get(f'{verb} {action.dest}') or COMPLETERS.get(action.dest)
