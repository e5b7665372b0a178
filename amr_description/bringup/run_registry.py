# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The runs of this user on this host: a file of state for each, which any shell can read.

The files are in ``$ROS_HOME/runs`` (``~/.ros/runs``), for the owner only. A run writes its own at
each of its events, and removes it at its end. One that was killed leaves its file; that is told
by its process being gone, or another one (the number of a process comes again, its time of start
since the boot does not), and the next to look removes it.

Which nodes of a stack there can be only one of in a ROS domain.

Two of one name answer each other's services and publish the same topics. What is known to be so:
a node that the stack names, and those programs of ours that go by a fixed name. Steps and tools
may be there several times: they end soon, or name themselves.
"""

from argparse import ArgumentParser
from collections.abc import Collection, Iterator, Mapping, Sequence
import contextlib
from datetime import datetime
import fcntl
import json
import os
from pathlib import Path
import socket
import time
from typing import Any, TYPE_CHECKING

from amr_description.bringup.process_usage import start_time
from amr_description.bringup.run_log import Event
from amr_description.errors import BringupError

if TYPE_CHECKING:
    from amr_description.bringup.command_line import ProcessSpec


type State = dict[str, Any]

_UNSEEN = ('waiting', 'condition_held')  # another event follows at once


def registry_folder(environment: Mapping[str, str]) -> Path:
    """Return where the files are."""
    return Path(environment.get('ROS_HOME') or '~/.ros').expanduser() / 'runs'


def runs(folder: Path) -> list[State]:
    """Return the states of the runs that are there, oldest first; drop what the dead have left."""
    found = []
    for path in sorted(folder.glob('*.json')):
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):  # it ends, or foreign
            state = json.loads(path.read_text('utf-8'))
            if state['host'] != socket.gethostname():  # a home that hosts share
                continue
            here = (_boot(), start_time(state['pid']))
            if here == (state['boot'], state['start_time']):
                found.append(state)
            else:
                path.unlink(missing_ok=True)
                _draft(path).unlink(missing_ok=True)
    return sorted(found, key=lambda state: state['since'])


def _boot() -> str:
    """Return what each boot of the machine has another of; empty: it cannot be told."""
    try:
        return Path('/proc/sys/kernel/random/boot_id').read_text().strip()
    except OSError:
        return ''


class RunRecord:
    """The file of this run, kept up to date by its events."""

    def __init__(self, folder: Path, run: str) -> None:
        """
        Write nothing yet.

        :param folder: Of the registry.
        :param run: Name of the run.
        """
        self._folder = folder
        self._path = folder / f'{run}.json'
        self._is_entered = False
        pid = os.getpid()
        process = {'pid': pid, 'start_time': start_time(pid), 'boot': _boot()}
        identity = {**process, 'host': socket.gethostname()}
        self._state: State = {'run': run, **identity, 'phase': 'starting', 'nodes': {}}

    def enter(
        self, about: Mapping[str, object], *, names: Collection[str], anyway: bool = False
    ) -> None:
        """
        Enter the run, unless it would be in the way of one that is there.

        :param about: ``stack`` and ``domain``.
        :param names: Full names of nodes of which there can be one in a domain.
        :param anyway: Enter it nevertheless.
        :raises BringupError: Another run in the same domain has a node of the same name.
        """
        self._state |= {**about, 'log_folder': '', 'names': sorted(names), 'since': time.time()}
        with self._alone():
            if not anyway:
                self._refuse_clash(runs(self._folder))
            self._is_entered = True
            self._write()

    def take(self, event: Event) -> None:
        """Take note of an event."""
        name, nodes = event.get('node'), self._state['nodes']
        if name is not None:
            node = nodes.setdefault(name, {'state': 'waiting', 'pid': None})
            if event['event'] == 'started':  # what was before, counts no more
                node = nodes[name] = {key: node[key] for key in ('condition',) if key in node}
            node |= _news_of_node(event)
        match event['event']:
            case 'begun':
                self._state['log_folder'] = event['log_folder']
            case 'ready':
                self._state |= {'phase': 'ready', 'ready_after': event['seconds']}
            case 'never_ready':
                self._state['needs'] = event['condition']
            case 'stop_requested' | 'shutdown' | 'failure' | 'signal_sent':
                self._state['phase'] = 'stopping'
        if self._is_entered and event['event'] not in _UNSEEN:
            self._write()

    def leave(self) -> None:
        """Remove the file."""
        self._is_entered = False
        with contextlib.suppress(OSError):
            self._path.unlink(missing_ok=True)
            _draft(self._path).unlink(missing_ok=True)

    def _refuse_clash(self, others: Sequence[State]) -> None:
        for other in others:
            common = set(self._state['names']) & set(other['names'])
            if other['domain'] != self._state['domain'] or not common:
                continue
            raise BringupError(
                f"{', '.join(sorted(common))} would be there twice: the stack '{other['stack']}' "
                f'(pid {other["pid"]}, since {clock(other["since"])}) runs in ROS domain '
                f"{other['domain']} already; end it with 'bringup stop {other['pid']}', or take "
                'another domain (--domain N), or start it nevertheless (--force)'
            )

    @contextlib.contextmanager
    def _alone(self) -> Iterator[None]:
        """Be the only one who enters a run; where nothing can be written do without."""
        with contextlib.ExitStack() as stack:
            with contextlib.suppress(OSError):
                self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
                lock = stack.enter_context((self._folder / '.lock').open('a'))
                fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def _write(self) -> None:
        """Replace the file in one step; a full disk costs the state, not the run."""
        draft = _draft(self._path)
        with contextlib.suppress(OSError):
            descriptor = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            with open(descriptor, 'w', encoding='utf-8') as file:
                json.dump(self._state, file)
            draft.replace(self._path)


def _draft(path: Path) -> Path:
    """Return where the next state is written, which no reader takes for a run."""
    return path.with_suffix('.draft')


def _news_of_node(event: Event) -> State:
    """Return what an event changes in the state of its node."""
    match event['event']:
        case 'waiting':
            return {'state': 'waiting', 'condition': event['condition']}
        case 'started':
            return {'state': 'running', 'pid': event['pid'], 'since': event['time']}
        case 'exited':
            end = {key: event[key] for key in ('exit_code', 'signal') if key in event}
            return {'state': 'ended', 'pid': None, **end}
        case 'respawn':
            return {'state': 'respawning', 'restart_at': event['time'] + event['seconds']}
        case 'not_started':
            return {'state': 'ended', 'reason': event['reason']}
        case 'never':
            return {'state': 'never'}
    return {}


def clock(seconds: float) -> str:
    """Return a time as a person reads it: of today the time only."""
    then, now = datetime.fromtimestamp(seconds), datetime.now()
    return f'{then:%H:%M:%S}' if then.date() == now.date() else f'{then:%Y-%m-%d %H:%M}'


# executable -> names of its nodes, the first of which `name=` changes
_FIXED = {
    'mujoco_sim': ('mujoco_sim', 'controller_manager'),
    'robot_state_publisher': ('robot_state_publisher',),
    'ros2_control_node': ('controller_manager',),
}


def add_option(parser: ArgumentParser) -> None:
    """Add the option that lets them be there twice."""
    parser.add_argument(
        '-f',
        '--force',
        action='store_true',
        help='start although a running stack has nodes of the same names',
    )


def of(jobs: 'Sequence[ProcessSpec]') -> set[str]:
    """Return their full names: ``/mujoco_sim``, ``/robot1/controller_manager``."""
    pairs = ((job.placed.namespace or '', name) for job in jobs for name in _names(job))
    return {f'{namespace.rstrip("/")}/{name}' for namespace, name in pairs}


def _names(job: 'ProcessSpec') -> Sequence[str]:
    node = job.node
    fixed = _FIXED.get(node.executable, ()) if node.package == 'amr_description' else ()
    return (node.name, *fixed[1:]) if node.name else fixed
