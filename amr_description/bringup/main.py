# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command ``bringup``: start a stack, by name or from a file, and keep it until Ctrl-C."""

import argparse
import asyncio
from datetime import datetime
import os
from pathlib import Path
import sys

from amr_description.bringup import discovery, unique_names
from amr_description.bringup.arguments import declared, parse, show
from amr_description.bringup.console import can_erase, Console, LAUNCH, wants_colour
from amr_description.bringup.description import nodes_of, Stack
from amr_description.bringup.early_signals import ended_by_signals
from amr_description.bringup.event_log import EventLog, FILE, json_line
from amr_description.bringup.job import Job, jobs_of, LaunchPrefix
from amr_description.bringup.listing import listing
from amr_description.bringup.log_folder import log_base, LogFolder, run_name, with_tilde
from amr_description.bringup.orchestrator import Orchestrator
from amr_description.bringup.run_commands import COMMANDS
from amr_description.bringup.run_registry import registry_folder, RunRecord
from amr_description.bringup.stack_files import find_stack, make_stack
from amr_description.bringup.stacks import STACKS
from amr_description.bringup.terminal import require_terminal
from amr_description.errors import AmrError


def main(args: list[str] | None = None, *, prog: str = 'bringup') -> int:
    """
    Run the command; return its exit code (see ``orchestrator.py``; 2: wrong command line).

    ``prog``: what messages call it.
    """
    _open_closed_streams()
    words = sys.argv[1:] if args is None else args
    try:
        if words and words[0] in COMMANDS:
            return COMMANDS[words[0]](words[1:])
        with ended_by_signals():
            return _run(_parser().parse_intermixed_args(words))
    except AmrError as error:
        print(f'{prog}: {error}', file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:  # before or after the orchestrator handles it
        return 130


def _open_closed_streams() -> None:
    """Open what was closed (``>&-``): else a pipe or a file takes its number and gets output."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    sys.stdout = sys.stdout or open(1, 'w', closefd=False)  # noqa: SIM115 - stays open
    sys.stderr = sys.stderr or open(2, 'w', closefd=False)  # noqa: SIM115


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='bringup',
        description='Start a stack of nodes in order, and stop them all on Ctrl-C.',
        epilog=f'Stacks: {", ".join(STACKS)}. Try: bringup simulation --show-args. What runs is '
        'shown by bringup status, and ended by bringup stop.',
    )
    parser.add_argument('stack', help='name of a stack, or a Python file with one')
    parser.add_argument('arguments', nargs='*', metavar='name:=value', help='its arguments')
    parser.add_argument('-s', '--show-args', action='store_true', help='show what it takes')
    parser.add_argument(
        '-p', '--print', action='store_true', help='print what would be started, and when'
    )
    unique_names.add_option(parser)
    parser.add_argument(
        '--launch-prefix', default='', help='what command lines begin with: gdb -ex run --args'
    )
    parser.add_argument(
        '--launch-prefix-filter',
        metavar='REGEX',
        default='',
        help='which executables that is for; all, if not given',
    )
    discovery.add_options(parser)
    return parser


def _run(options: argparse.Namespace) -> int:
    os.environ |= discovery.variables(options, os.environ)
    if options.show_args:
        print(show(declared(find_stack(options.stack))))
        return 0
    stack = make_stack(options.stack, parse(options.arguments))
    prefix = LaunchPrefix(options.launch_prefix, options.launch_prefix_filter)
    if options.print:
        print(listing(stack, jobs_of(stack, Path('LOG_FOLDER'), prefix)))
        return 0
    return start(stack, name=Path(options.stack).stem, force=options.force, prefix=prefix)


def start(
    stack: Stack, *, name: str, force: bool = False, prefix: LaunchPrefix | None = None
) -> int:
    """
    Run a stack until it ends or is stopped; return the exit code.

    :param name: What it is called.
    :param force: Whether it may have nodes of the same names as a stack that runs.
    :param prefix: That of all command lines.
    """
    for node in nodes_of(stack.nodes):
        if node.terminal:
            require_terminal(node.executable, node.package)
    run = run_name(datetime.now())
    about = {'stack': name, 'domain': int(os.environ.get(discovery.DOMAIN) or 0)}
    record = RunRecord(registry_folder(os.environ), run)
    record.enter(about, names=unique_names.of(jobs_of(stack, Path(), prefix)), anyway=force)
    folder = LogFolder(log_base(os.environ), run)
    try:
        jobs = jobs_of(stack, folder.path, prefix)
        events = EventLog(lambda event: folder.append(FILE, json_line(event)), record.take)
        events.note('begun', run=run, pid=os.getpid(), log_folder=str(folder.path), **about)
        code = asyncio.run(_orchestrate(stack, jobs, _console(stack, folder), run, events))
        events.note('stopped', exit_code=code)
        return code
    finally:
        record.leave()
        folder.close()


def _console(stack: Stack, folder: LogFolder) -> Console:
    """Return the console, on which has been said what a person knows before the start."""
    colour, erases = wants_colour(sys.stdout, os.environ), can_erase(sys.stdout, os.environ)
    console = Console(sys.stdout, folder, colour=colour, erases=erases)
    where = with_tilde(folder.path)
    console.say('INFO', LAUNCH, f'All log files can be found below {where}')
    console.say('INFO', LAUNCH, discovery.told(os.environ))
    for level, text in stack.all_notes:
        console.say(level, LAUNCH, text)
    return console


async def _orchestrate(
    stack: Stack, jobs: list[Job], console: Console, run: str, events: EventLog
) -> int:
    # The log files that the nodes write themselves belong to this run, too.
    environment = {**os.environ, 'ROS_LOG_DIR': console.log_folder}
    try:
        return await Orchestrator(stack, jobs, console, run, environment, events).run()
    finally:
        console.status('')


if __name__ == '__main__':
    sys.exit(main())
