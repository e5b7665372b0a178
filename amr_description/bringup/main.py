# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command ``bringup``: start a stack, by name or from a file, and keep it until Ctrl-C."""

import argparse
import asyncio
from datetime import datetime
import os
from pathlib import Path
import sys

from amr_description.bringup import discovery
from amr_description.bringup.arguments import declared, parse, show
from amr_description.bringup.console import can_erase, Console, LAUNCH, wants_colour
from amr_description.bringup.description import nodes_of, Stack
from amr_description.bringup.job import Job, jobs_of
from amr_description.bringup.listing import listing
from amr_description.bringup.log_folder import log_base, LogFolder, run_name, with_tilde
from amr_description.bringup.orchestrator import Orchestrator
from amr_description.bringup.stack_files import find_stack, make_stack
from amr_description.bringup.stacks import STACKS
from amr_description.bringup.terminal import require_terminal
from amr_description.errors import AmrError


def main(args: list[str] | None = None, *, prog: str = 'bringup') -> int:
    """
    Run the command; return its exit code (see ``orchestrator.py``; 2: wrong command line).

    ``prog``: what messages call it.
    """
    try:
        return _run(_parser().parse_intermixed_args(args))
    except AmrError as error:
        print(f'{prog}: {error}', file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:  # before or after the orchestrator handles it
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='bringup',
        description='Start a stack of nodes in order, and stop them all on Ctrl-C.',
        epilog=f'Stacks: {", ".join(STACKS)}. Try: bringup simulation --show-args',
    )
    parser.add_argument('stack', help='name of a stack, or a Python file with one')
    parser.add_argument('arguments', nargs='*', metavar='name:=value', help='its arguments')
    parser.add_argument('-s', '--show-args', action='store_true', help='show what it takes')
    parser.add_argument(
        '-p', '--print', action='store_true', help='print what would be started, and when'
    )
    discovery.add_options(parser)
    return parser


def _run(options: argparse.Namespace) -> int:
    os.environ |= discovery.variables(options, os.environ)
    if options.show_args:
        print(show(declared(find_stack(options.stack))))
        return 0
    stack = make_stack(options.stack, parse(options.arguments))
    if options.print:
        print(listing(stack, jobs_of(stack, Path('LOG_FOLDER'))))
        return 0
    return start(stack)


def start(stack: Stack) -> int:
    """Run a stack until it ends or is stopped; return the exit code."""
    for node in nodes_of(stack.nodes):
        if node.terminal:
            require_terminal(node.executable, node.package)
    run = run_name(datetime.now())
    folder = LogFolder(log_base(os.environ), run)
    try:
        jobs = jobs_of(stack, folder.path)
        console = Console(
            sys.stdout,
            folder,
            colour=wants_colour(sys.stdout, os.environ),
            erases=can_erase(sys.stdout, os.environ),
        )
        where = with_tilde(folder.path)
        console.say('INFO', LAUNCH, f'All log files can be found below {where}')
        console.say('INFO', LAUNCH, discovery.told(os.environ))
        for level, text in stack.all_notes:
            console.say(level, LAUNCH, text)
        # The log files that the nodes write themselves belong to this run, too.
        environment = {**os.environ, 'ROS_LOG_DIR': str(folder.path)}
        return asyncio.run(_orchestrate(stack, jobs, console, run, environment))
    finally:
        folder.close()


async def _orchestrate(
    stack: Stack, jobs: list[Job], console: Console, run: str, environment: dict[str, str]
) -> int:
    return await Orchestrator(stack, jobs, console, run, environment).run()


if __name__ == '__main__':
    sys.exit(main())
