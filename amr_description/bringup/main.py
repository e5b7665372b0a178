# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The command ``bringup``: starts a stack, by name or from a file, and runs it until Ctrl-C.

Also ``--print``, which shows the tree of a stack, what each node waits for and its command line;
``--show-args``; and the commands of ``run_commands.py``.
"""

import argparse
import asyncio
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import datetime
import math
import os
from pathlib import Path
import re
import signal
import sys
import threading
from typing import Any, Protocol

from amr_description import streams
from amr_description.ament_index import overlay, OWN_PACKAGE
from amr_description.bringup import environment, run_registry
from amr_description.bringup.arguments import declared, parse, show
from amr_description.bringup.command_line import LaunchPrefix, process_specs, ProcessSpec
from amr_description.bringup.conditions import Member, NameOf
from amr_description.bringup.console import can_erase, Console, LAUNCH, wants_colour
from amr_description.bringup.description import Group, Node, nodes_of, Stack
from amr_description.bringup.orchestrator import Orchestrator
from amr_description.bringup.placement import Placement
from amr_description.bringup.run_commands import COMMANDS
from amr_description.bringup.run_log import (
    EventLog,
    EVENTS_FILE,
    json_line,
    log_base,
    LogFolder,
    run_name,
    with_tilde,
)
from amr_description.bringup.run_registry import COMMAND, registry_folder, RunRecord
from amr_description.bringup.stack_files import find_stack, make_stack
from amr_description.bringup.stacks import STACKS
from amr_description.bringup.terminal import require_terminal
from amr_description.errors import AmrError, ParameterError
from amr_description.launch_log import LAUNCH_LOG
from amr_description.ros_arguments import DOMAIN

_INDENT = '    '
_PROLOGUE = re.compile(r'<!--.*?-->|<\?.*?\?>', re.DOTALL)
"""What stands before the name of a robot in its description."""
_LONG, _BEGIN = 300, 60
"""Characters: a text that ``--print`` shortens, and what is left of it."""


class StackSource(Protocol):
    """What a stack is made from in place of a stack's file: a launch file of ROS."""

    def show_arguments(self) -> str:
        """Return what ``--show-args`` prints."""
        ...

    def stack(self, given: Mapping[str, str]) -> Stack:
        """Return the stack with these arguments, as a user typed them."""
        ...


def main(
    args: list[str] | None = None, *, prog: str = 'bringup', source: StackSource | None = None
) -> int:
    """
    Run the command.

    Args:
        args: its arguments; None: those of the process.
        prog: the name of the command in its messages.
        source: what the stack is made from; None: what the arguments name.

    Returns:
        The exit code: see ``orchestrator.py``; 2: wrong command line.
    """
    streams.open_missing()
    words = sys.argv[1:] if args is None else args
    try:
        if words and words[0] in COMMANDS:
            return COMMANDS[words[0]](words[1:])
        with _exit_on_signals():
            return _run(_parser().parse_intermixed_args(words), source)
    except AmrError as error:
        print(f'{prog}: {error}', file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:  # before or after the orchestrator handles SIGINT
        return 130


def start(
    stack: Stack, *, name: str, force: bool = False, prefix: LaunchPrefix | None = None
) -> int:
    """
    Run a stack until it ends or is stopped; return the exit code.

    Args:
        stack: what to run.
        name: what the run is called.
        force: whether to start although a running stack has nodes of the same names.
        prefix: that of all command lines.
    """
    for node in nodes_of(stack.nodes):
        if node.terminal:
            require_terminal(node.executable, node.package)
    run = run_name(datetime.now())
    about = {'stack': name, 'domain': int(os.environ.get(DOMAIN) or 0)}
    record = RunRecord(registry_folder(os.environ), run)
    names = run_registry.unique_names(process_specs(stack, Path(), prefix))
    record.register(about, names=names, force=force)
    folder = LogFolder(log_base(os.environ), run)
    try:
        os.environ[LAUNCH_LOG] = str(folder.path / 'launch.log')  # of all that it starts
        specs = process_specs(stack, folder.path, prefix)
        events = EventLog(lambda e: folder.append(EVENTS_FILE, json_line(e)), record.update)
        events.note('begun', run=run, pid=os.getpid(), log_folder=str(folder.path), **about)
        code = asyncio.run(_orchestrate(stack, specs, _console(stack, folder), run, events))
        events.note('stopped', exit_code=code)
        return code
    finally:
        record.remove()
        folder.close()


def listing(stack: Stack, specs: Sequence[ProcessSpec]) -> str:
    """Return what ``--print`` prints of a stack and its nodes."""
    by_node = {spec.node: spec for spec in specs}

    def name_of(node: Node) -> str:
        return by_node[node].name

    lines = list(_tree(stack.nodes, by_node, name_of))
    placement = Placement(stack)
    for handler in placement.event_handlers:
        lines.append(f'handler: when {handler.when.describe(name_of)}: {handler.text}')
    if stack.ready_when:
        lines.append(f'ready: when {placement.ready_when.describe(name_of)}')
    return '\n'.join(lines)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='bringup',
        description='Start a stack of nodes in order, and stop them all on Ctrl-C.',
        epilog=f'Stacks: {", ".join(STACKS)}. Try: {COMMAND} simulation --show-args. In place of '
        'a stack, "status" shows what runs, and "stop" ends it.',
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


def _run(options: argparse.Namespace, source: StackSource | None) -> int:
    os.environ |= environment.variables(options, os.environ)
    if options.show_args:
        if source:
            return _print(source.show_arguments())
        return _print(show(declared(find_stack(options.stack))))
    given = parse(options.arguments)
    stack = source.stack(given) if source else make_stack(options.stack, given)
    prefix = LaunchPrefix(options.launch_prefix, options.launch_prefix_filter)
    if options.print:
        notes = [f'[{level}] {text}' for level, text in stack.notes] if source else []
        specs = process_specs(stack, Path('LOG_FOLDER'), prefix)
        return _print('\n'.join([*notes, listing(stack, specs)]))
    return start(stack, name=Path(options.stack).stem, force=options.force, prefix=prefix)


def _print(text: str) -> int:
    """Print a text; return the exit code: that of shells where the reader is gone (``| head``)."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        streams.abandon_stdout()
        return 128 + signal.SIGPIPE
    return 0


def _console(stack: Stack, folder: LogFolder) -> Console:
    """Return the console, after the lines that come before the first start."""
    colour, erases = wants_colour(sys.stdout, os.environ), can_erase(sys.stdout, os.environ)
    console = Console(sys.stdout, folder, colour=colour, erases=erases)
    where = with_tilde(folder.path)
    console.log('INFO', LAUNCH, f'All log files can be found below {where}')
    console.log('INFO', LAUNCH, environment.discovery_text(os.environ))
    if found := overlay():
        text = f"package '{OWN_PACKAGE}' of {found} overlays this one: its files come first"
        console.log('INFO', LAUNCH, text)
    for level, text in stack.all_notes:
        console.log(level, LAUNCH, text)
    return console


async def _orchestrate(
    stack: Stack, specs: list[ProcessSpec], console: Console, run: str, events: EventLog
) -> int:
    # The log files that the nodes write themselves belong to this run, too.
    variables = {**os.environ, 'ROS_LOG_DIR': console.log_folder}
    try:
        return await Orchestrator(stack, specs, console, run, variables, events).run()
    finally:
        console.status('')


@contextmanager
def _exit_on_signals() -> Iterator[None]:
    """
    Have SIGTERM and SIGHUP unwind the context, with the exit code of shells, as Ctrl-C does.

    For the time before the orchestrator installs its own handlers: xacro may be running. An
    ignored signal stays ignored (nohup).
    """
    if threading.current_thread() is not threading.main_thread():  # no handlers can be set there
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    for number, handler in before.items():
        if handler is signal.SIG_DFL:
            signal.signal(number, _exit)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _exit(number: int, _frame: object) -> None:
    sys.exit(128 + number)


def _tree(
    members: Sequence[Member], specs: Mapping[Node, ProcessSpec], name_of: NameOf
) -> Iterator[str]:
    for member in members:
        if isinstance(member, Node):
            yield from _node_lines(specs[member], name_of)
            continue
        inner = member.members if isinstance(member, Group) else member.nodes
        yield f'{_group_title(member) if isinstance(member, Group) else "stack"}:'
        yield from (f'{_INDENT}{line}' for line in _tree(inner, specs, name_of))


def _group_title(group: Group) -> str:
    return f'group {group.namespace}' if group.namespace else 'group'


def _node_lines(spec: ProcessSpec, name_of: NameOf) -> Iterator[str]:
    condition = spec.resolved.start_when
    when = f'when {condition.describe(name_of)}' if condition else 'at once'
    yield f'{spec.name}: {", ".join([when, *_options(spec.node)])}'
    yield f'{_INDENT}{spec.command_text}'
    for variable, value in spec.environment.items():
        yield f'{_INDENT}{variable}={value}' if value is not None else f'{_INDENT}no {variable}'
    if spec.node.folder is not None:
        yield f'{_INDENT}in {spec.node.folder}'
    for path, text in spec.parameter_files:
        if text is not None:
            yield f'{_INDENT}{path}:'
            lines = (
                _shortened(text).splitlines()
                if isinstance(text, str)
                else [f'# known when it starts: {text.text}']
            )
            yield from (f'{2 * _INDENT}{line}' for line in lines)


def _shortened(text: str) -> str:
    """Return a parameter file with the begin of each long text, such as a robot description."""
    from amr_description.parameter_files import content_of, load_yaml, text_of

    if len(text) <= _LONG:
        return text
    try:
        content = load_yaml(text, content_of)
    except ParameterError:  # of a user's file, which its node refuses
        return text
    shorter = _with_short_texts(content)
    return text if shorter == content else text_of(shorter, width=math.inf)


def _with_short_texts(value: Any) -> Any:
    match value:
        case dict():
            return {key: _with_short_texts(each) for key, each in value.items()}
        case list():
            return [_with_short_texts(each) for each in value]
        case str() if len(value) > _LONG:
            begin = ' '.join(_PROLOGUE.sub('', value).split())[:_BEGIN]
            return f'{begin} ... {len(value):,} characters'
    return value


def _options(node: Node) -> Iterator[str]:
    """Yield what differs from the defaults of a node."""
    if node.required is not True:
        yield 'optional' if not node.required else 'required at start'
    if node.respawn:
        limit = '' if node.respawn.limit is None else f' up to {node.respawn.limit} times'
        yield f'started again{limit}'
    if node.on_exit == 'shutdown':
        yield 'its end is the end of all'
    if node.terminal:
        yield 'has the terminal'


if __name__ == '__main__':
    sys.exit(main())
