# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The commands ``bringup status`` and ``bringup stop``: show the runs of this host, end one."""

from argparse import ArgumentParser
from collections.abc import Sequence
import contextlib
import json
import os
import select
import signal
import sys
import time

from amr_description.bringup.guardian import processes
from amr_description.bringup.process_usage import Usage, usages
from amr_description.bringup.run_log import with_tilde
from amr_description.bringup.run_registry import clock, registry_folder, runs, State
from amr_description.errors import BringupError, UsageError

_INTERVAL = 0.5  # s over which the CPU usage is measured
_COLUMNS = '{:26} {:34} {:>8} {:>9} {:>6} {:>9}'
_CPU, _MEMORY = '{:.0f} %', '{:.0f} MB'


def status(args: Sequence[str]) -> int:
    """Print the runs: since when, ready or waiting for what; return 1 if there is none."""
    parser = ArgumentParser(
        prog='bringup status',
        description='Show the stacks that run on this host: who runs, since when, what of the '
        'processor and the memory each uses, who waits for what. Exit code 1: there is none.',
    )
    parser.add_argument('run', nargs='?', help='name of a run, of a stack, or pid; none: all')
    parser.add_argument('--json', action='store_true', help='print it for programs')
    options = parser.parse_args(args)
    chosen = _chosen(options.run)
    if not chosen:
        print('[]' if options.json else _nothing(), file=None if options.json else sys.stderr)
        return 1
    used = usages([pid for run in chosen for pid in _roots(run)], _INTERVAL)
    if options.json:
        print(json.dumps([_with_usage(run, used) for run in chosen], indent=2))
    else:
        print('\n\n'.join('\n'.join(table(run, used)) for run in chosen))
    return 0


def stop(args: Sequence[str]) -> int:
    """End a run as Ctrl-C in its terminal does, and wait until all its processes are gone."""
    parser = ArgumentParser(
        prog='bringup stop',
        description='End a stack that runs on this host, as Ctrl-C in its terminal does, and '
        'wait until all of it is gone. Exit code 1: there is none, or something is left.',
    )
    parser.add_argument('run', nargs='?', help='name of the run or stack, or pid; none: the one')
    parser.add_argument('-a', '--all', action='store_true', help='end all that there are')
    options = parser.parse_args(args)
    chosen = _chosen(options.run)
    if not chosen:
        print(_nothing(), file=sys.stderr)
        return 1
    if len(chosen) > 1 and not options.all:
        which = ', '.join(f"{run['pid']} ('{run['stack']}')" for run in chosen)
        raise UsageError(f'several stacks run; name one by its pid, or --all: {which}')
    return max([_stop(run) for run in chosen])


def _nothing() -> str:
    return 'no stack of this user runs on this host'


def _chosen(name: str | None) -> list[State]:
    """Return the runs with that name, stack or pid; all if it is None. Raises BringupError."""
    found = runs(registry_folder(os.environ))
    if name is None:
        return found
    chosen = [run for run in found if name in (run['run'], run['stack'], str(run['pid']))]
    if not chosen:
        known = ', '.join(f"{run['pid']} ('{run['stack']}')" for run in found) or 'none'
        raise BringupError(f"no run, stack or pid '{name}'; there are: {known}")
    return chosen


def _roots(run: State) -> list[int]:
    return [run['pid'], *(node['pid'] for node in run['nodes'].values() if node['pid'])]


def _with_usage(run: State, used: dict[int, Usage]) -> State:
    nodes = {name: node | _numbers(used.get(node['pid'])) for name, node in run['nodes'].items()}
    return run | {'nodes': nodes} | _numbers(used[run['pid']])


def _numbers(usage: Usage | None) -> State:
    return {'cpu': round(usage.cpu, 3), 'memory': usage.memory} if usage else {}


def table(run: State, used: dict[int, Usage]) -> list[str]:
    """
    Return the lines that ``status`` prints for a run.

    Args:
        run: its state.
        used: usage by pid: of each node, and of the whole run by the pid of the bring-up.
    """
    rows = [
        f'{run["stack"]}: {_phase(run)}, pid {run["pid"]}, ROS domain {run["domain"]}, '
        f'since {clock(run["since"])} ({_duration(time.time() - run["since"])})',
        f'logs: {with_tilde(run["log_folder"])}',
        _COLUMNS.format('', 'STATE', 'PID', 'SINCE', 'CPU', 'MEMORY'),
    ]
    for name, node in run['nodes'].items():
        rows.append(_row(name, _state_of(node), node['pid'], node.get('since'), used))
    rows.append(_row('all, and the bring-up', '', run['pid'], run['since'], used))
    return [row.rstrip() for row in rows]


def _phase(run: State) -> str:
    match run:
        case {'phase': 'stopping'}:
            return 'stopping'
        case {'ready_after': seconds}:
            return f'ready after {seconds:.1f} s'
        case {'needs': condition}:
            return f'never gets ready (needs that {condition})'
    return 'starting'


def _row(
    name: str, state: str, pid: int | None, since: float | None, used: dict[int, Usage]
) -> str:
    if pid not in used or since is None:
        return _COLUMNS.format(name, state, '', '', '', '')
    usage = used[pid]
    cpu, memory = _CPU.format(100 * usage.cpu), _MEMORY.format(usage.memory / 1e6)
    return _COLUMNS.format(name, state, pid, clock(since), cpu, memory)


def _state_of(node: State) -> str:
    match node:
        case {'state': 'respawning', 'restart_at': when}:
            return f'{_state_of(node | {"state": "ended"})}, starts again at {clock(when)}'
        case {'state': 'waiting', 'condition': str() as condition}:
            return f'waits until {condition}'
        case {'state': 'never', 'condition': str() as condition}:
            return f'never starts: needs that {condition}'
        case {'state': 'ended', 'signal': str() as name}:
            return f'died of {name}'
        case {'state': 'ended', 'exit_code': int() as code}:
            return f'ended with exit code {code}' if code else 'done'
        case {'state': 'ended', 'reason': str() as reason}:
            return reason
    return node['state']


def _duration(seconds: float) -> str:
    for unit, size in (('d', 86400), ('h', 3600), ('min', 60)):
        if seconds >= size:
            return f'{seconds / size:.0f} {unit}'
    return f'{seconds:.0f} s'


def _stop(run: State) -> int:
    """End one run; return 1 if a process of it is left."""
    title = f"'{run['stack']}' (pid {run['pid']})"
    try:
        descriptor = os.pidfd_open(run['pid'])
    except ProcessLookupError:
        print(f'{title} has just ended')
        return 0
    try:
        print(f'stopping {title} …', flush=True)
        begin = time.monotonic()
        with contextlib.suppress(ProcessLookupError):
            signal.pidfd_send_signal(descriptor, signal.SIGINT)
            signal.pidfd_send_signal(descriptor, signal.SIGCONT)  # it may be stopped by Ctrl-Z
        select.select([descriptor], [], [])
    finally:
        os.close(descriptor)
    if left := [process.pid for process in processes(run['run']) if process.marked]:
        print(f'{title} is gone, but not its processes {left}', file=sys.stderr)
        return 1
    print(f'{title} is gone, and all that it started, after {time.monotonic() - begin:.1f} s')
    return 0


COMMANDS = {'status': status, 'stop': stop}
"""The words that may be given in place of a stack's name."""
