# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Various daemon related sub-commands.

There is no daemon: every command looks at the graph itself, so that no answer is stale. The verbs
are there for scripts.
"""

from argparse import ArgumentParser, Namespace


class _Verb:
    def __init__(self, about: str, answer: str, flags: tuple[str, ...] = ()) -> None:
        self.__doc__, self._answer, self._flags = about, answer, flags

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        if self._flags:
            accepted = 'Accepted for scripts: there is no daemon'
            parser.add_argument(*self._flags, action='store_true', help=accepted)

    def main(self, _args: Namespace) -> int:
        """Print what scripts expect, and what is true from here on; 0."""
        print(self._answer)
        return 0


START = _Verb(
    "Start the daemon if it isn't running: does nothing, as none is needed.",
    'The daemon is not needed: every answer is fresh',
    ('-d', '--debug'),
)
STATUS = _Verb('Output the status of the daemon.', 'The daemon is not running')
STOP = _Verb(
    'Stop the daemon if it is running: does nothing, as there is none.',
    'The daemon has been stopped',
)
VERBS = {'start': f'{__name__}:START', 'status': f'{__name__}:STATUS', 'stop': f'{__name__}:STOP'}
