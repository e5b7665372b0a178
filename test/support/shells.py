# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A person at a terminal with a book, who types its lines letter for letter."""

from contextlib import contextmanager
import os
import re

from support.paths import ROOT
from support.running_programs import PATIENCE, Program

PROMPT = 'amr-test> '
_COLOUR = re.compile(r'\x1b\[\d*m')
CTRL_C = '\x03'
_BUILD_TIMEOUT = 5 * PATIENCE
"""s: a compiler takes ten seconds of a processor, which others want too."""


def line_of(book, beginning):
    """The line of a book that begins so, letter for letter; it may go on below."""
    found = re.search(rf'^{re.escape(beginning)}(.*\\\n)*.*$', book, re.MULTILINE)
    assert found, f'not in the book: {beginning}'
    return found[0]


class Shell:
    """A shell in a terminal; the person types a line and looks at what it prints."""

    def __init__(self, program, book):
        self.book = book
        self._program = program
        self._seen = 0

    def type(self, line):
        """Type a line, and Enter."""
        self._seen = len(self._program.output)
        self._program.type(line + '\n')

    def press(self, key):
        """Press a key that needs no Enter."""
        self._program.type(key)

    def see(self, pattern):
        """Wait for what the line prints; return the match."""
        found = self._program.expect(pattern, self._seen)
        self._seen = found.end()
        return found

    def run(self, beginning, code=0):
        """Type the line of the book that begins so; return what it printed, once it has ended."""
        line = line_of(self.book, beginning)
        self.type(f'{line}\necho "exit=$?"')
        begin = self._program.expect(re.escape('echo "exit=$?"') + r'\r?\n', self._seen).end()
        within = _BUILD_TIMEOUT if 'colcon ' in line else PATIENCE
        end = self._program.expect(r'exit=(\d+)\r?\n' + re.escape(PROMPT), begin, within=within)
        printed = _COLOUR.sub('', self._program.output[begin : end.start()].replace('\r\n', '\n'))
        assert int(end[1]) == code, printed
        return printed.replace(PROMPT, '')

    def start(self, beginning):
        """Type the line of the book that begins so; it goes on until Ctrl-C."""
        self.type(line_of(self.book, beginning))

    def interrupt(self):
        """Press Ctrl-C and wait for the prompt."""
        self.press(CTRL_C)
        assert 'Traceback' not in self.see(re.escape(PROMPT)).string


@contextmanager
def terminal(book, *, activate='source scripts/activate', folder=ROOT, machine=()):
    """
    A new terminal for one who reads the book.

    :param activate: The line of the book that is typed first; empty: none.
    :param folder: Where the person goes then.
    :param machine: Words before a command that is to run on another machine.
    """
    environment = {'PS1': PROMPT, 'TERM': 'dumb', 'COLUMNS': '200', 'HISTFILE': ''}
    bash = ['bash', '--norc', '--noprofile', '--noediting', '-i']
    with Program(*machine, *bash, terminal=True, env=environment, cwd=ROOT) as program:
        program.expect(re.escape(PROMPT))
        shell = Shell(program, book)
        if activate:
            shell.run(activate)
        shell.type(f'cd {folder}')
        shell.see(re.escape(PROMPT))
        yield shell


def newcomer(book, home, *, activate='source scripts/activate', folder=ROOT):
    """
    A terminal of one who has just come: an empty home, and no variable of ours.

    But the domain of this test, in which nobody else's robot is.

    :param home: The folder that is her home.
    """
    variables = {'PS1': PROMPT, 'TERM': 'dumb', 'COLUMNS': '200', 'HISTFILE': ''}
    fresh = ['env', '-i', *(f'{name}={value}' for name, value in fresh_variables(home).items())]
    fresh += [f'{name}={value}' for name, value in variables.items()]
    return terminal(book, activate=activate, folder=folder, machine=fresh)


def fresh_variables(home):
    """The environment of a shell that has sourced nothing; of this checkout it has the domain."""
    path = os.pathsep.join(
        folder for folder in os.environ['PATH'].split(os.pathsep) if str(ROOT) not in folder
    )
    return {'PATH': path, 'HOME': str(home), 'ROS_DOMAIN_ID': os.environ['ROS_DOMAIN_ID']}
