# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The command ``bringup``: start a stack, by name or from a file, and keep it until Ctrl-C.

What ``--print`` prints: the tree of a stack, what each part waits for, and command lines.

Signals that ask for the end before the orchestrator listens to them: xacro may be running.
"""

import argparse
import asyncio
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import datetime
import os
from pathlib import Path
import signal
import sys
import threading

from amr_description import streams
from amr_description.bringup import environment, run_registry
from amr_description.bringup.arguments import declared, parse, show
from amr_description.bringup.command_line import jobs_of, LaunchPrefix, ProcessSpec
from amr_description.bringup.conditions import NameOf
from amr_description.bringup.console import can_erase, Console, LAUNCH, wants_colour
from amr_description.bringup.description import Group, Member, Node, nodes_of, Stack
from amr_description.bringup.orchestrator import Orchestrator
from amr_description.bringup.placement import Placement
from amr_description.bringup.run_commands import COMMANDS
from amr_description.bringup.run_log import (
    EventLog,
    FILE,
    json_line,
    log_base,
    LogFolder,
    run_name,
    with_tilde,
)
from amr_description.bringup.run_registry import registry_folder, RunRecord
from amr_description.bringup.stack_files import find_stack, make_stack
from amr_description.bringup.stacks import STACKS
from amr_description.bringup.terminal import require_terminal
from amr_description.errors import AmrError

_INDENT = '    '


def listing(stack: Stack, jobs: Sequence[ProcessSpec]) -> str:
    """Return the text."""
    by_node = {job.node: job for job in jobs}

    def name_of(node: Node) -> str:
        return by_node[node].name

    lines = list(_tree(stack.nodes, by_node, name_of))
    if stack.ready_when:
        lines.append(f'ready: when {Placement(stack).ready_when.describe(name_of)}')
    return '\n'.join(lines)


def _tree(
    members: Sequence[Member], jobs: Mapping[Node, ProcessSpec], name_of: NameOf
) -> Iterator[str]:
    for member in members:
        if isinstance(member, Node):
            yield from _of_job(jobs[member], name_of)
            continue
        inside = member.members if isinstance(member, Group) else member.nodes
        yield f'{_group(member) if isinstance(member, Group) else "stack"}:'
        yield from (f'{_INDENT}{line}' for line in _tree(inside, jobs, name_of))


def _group(group: Group) -> str:
    return f'group {group.namespace}' if group.namespace else 'group'


def _of_job(job: ProcessSpec, name_of: NameOf) -> Iterator[str]:
    condition = job.placed.start_when
    when = f'when {condition.describe(name_of)}' if condition else 'at once'
    yield f'{job.name}: {", ".join([when, *_manners(job.node)])}'
    yield f'{_INDENT}{job.command_text}'
    for variable, value in job.environment.items():
        yield f'{_INDENT}{variable}={value}'
    for path, text in job.parameter_files:
        if text is not None:
            yield f'{_INDENT}{path}:'
            yield from (f'{2 * _INDENT}{line}' for line in text.splitlines())


def _manners(node: Node) -> Iterator[str]:
    """Yield how it differs from a node of which nothing is said."""
    if not node.required:
        yield 'optional'
    if node.respawn:
        limit = '' if node.respawn.limit is None else f' up to {node.respawn.limit} times'
        yield f'started again{limit}'
    if node.on_exit == 'shutdown':
        yield 'its end is the end of all'
    if node.terminal:
        yield 'has the terminal'


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """
    Have SIGTERM and SIGHUP unwind this block, as Ctrl-C does, with the exit code that shells give.

    An ignored one stays so (nohup). The orchestrator's own handlers replace these.
    """
    if threading.current_thread() is not threading.main_thread():  # Python handles none there
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    for number, handler in before.items():
        if handler is signal.SIG_DFL:
            signal.signal(number, _leave)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _leave(number: int, _frame: object) -> None:
    sys.exit(128 + number)


def main(args: list[str] | None = None, *, prog: str = 'bringup') -> int:
    """
    Run the command; return its exit code (see ``orchestrator.py``; 2: wrong command line).

    ``prog``: what messages call it.
    """
    streams.open_missing()
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
    run_registry.add_option(parser)
    parser.add_argument(
        '--launch-prefix', default='', help='what command lines begin with: gdb -ex run --args'
    )
    parser.add_argument(
        '--launch-prefix-filter',
        metavar='REGEX',
        default='',
        help='which executables that is for; all, if not given',
    )
    environment.add_options(parser)
    return parser


def _run(options: argparse.Namespace) -> int:
    os.environ |= environment.variables(options, os.environ)
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
    about = {'stack': name, 'domain': int(os.environ.get(environment.DOMAIN) or 0)}
    record = RunRecord(registry_folder(os.environ), run)
    record.enter(about, names=run_registry.of(jobs_of(stack, Path(), prefix)), anyway=force)
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
    console.say('INFO', LAUNCH, environment.told(os.environ))
    for level, text in stack.all_notes:
        console.say(level, LAUNCH, text)
    return console


async def _orchestrate(
    stack: Stack, jobs: list[ProcessSpec], console: Console, run: str, events: EventLog
) -> int:
    # The log files that the nodes write themselves belong to this run, too.
    environment = {**os.environ, 'ROS_LOG_DIR': console.log_folder}
    try:
        return await Orchestrator(stack, jobs, console, run, environment, events).run()
    finally:
        console.status('')


if __name__ == '__main__':
    sys.exit(main())
