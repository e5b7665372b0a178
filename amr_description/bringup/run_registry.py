# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The runs of this user on this host: a file of state for each, which any shell can read.

The files are in ``$ROS_HOME/runs`` (``~/.ros/runs``), readable by their owner only. A run writes
its file at each of its events, and removes it at its end. The file of a killed run is recognised
by its process, which is gone or another one (a pid is reused, a pid with its start time is not),
and removed by the next reader.

The registry also keeps two stacks from starting nodes of the same name in one ROS domain: they
would answer each other's requests and publish the same topics. Considered are nodes that a stack
names, and executables of this package with a fixed node name. Spawners and tools may run several
times: they end soon, or choose unique names.
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
from typing import Any, TYPE_CHECKING, TypeAlias

from amr_description.bringup.process_usage import start_time
from amr_description.bringup.run_log import Event
from amr_description.errors import BringupError

if TYPE_CHECKING:
    from amr_description.bringup.command_line import ProcessSpec


COMMAND = 'ros2 run amr_description bringup'
"""How messages name the command: so it works in every shell that has ROS."""

State: TypeAlias = dict[str, Any]
"""The content of a run's file."""

_NOT_WRITTEN = ('waiting', 'condition_held')  # events that another one follows at once

# executable -> names of its nodes, the first of which `name=` changes
_FIXED_NAMES = {
    'mujoco_sim': ('mujoco_sim', 'controller_manager'),
    'robot_state_publisher': ('robot_state_publisher',),
    'ros2_control_node': ('controller_manager',),
}


def registry_folder(environment: Mapping[str, str]) -> Path:
    """Return the folder of the files."""
    return Path(environment.get('ROS_HOME') or '~/.ros').expanduser() / 'runs'


def runs(folder: Path) -> list[State]:
    """Return the states of the running runs, oldest first; remove the files of killed ones."""
    found = []
    for path in sorted(folder.glob('*.json')):
        # It may have ended just now, or not be ours.
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
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
    """Return the id of the boot of this machine; '' if it cannot be read."""
    try:
        return Path('/proc/sys/kernel/random/boot_id').read_text().strip()
    except OSError:
        return ''


class RunRecord:
    """The file of this run."""

    def __init__(self, folder: Path, run: str) -> None:
        """
        Write nothing yet.

        Args:
            folder: that of the registry.
            run: the name of the run.
        """
        self._folder = folder
        self._path = folder / f'{run}.json'
        self._is_registered = False
        pid = os.getpid()
        process = {'pid': pid, 'start_time': start_time(pid), 'boot': _boot()}
        identity = {**process, 'host': socket.gethostname()}
        self._state: State = {'run': run, **identity, 'phase': 'starting', 'nodes': {}}

    def register(
        self, about: Mapping[str, object], *, names: Collection[str], force: bool = False
    ) -> None:
        """
        Write the file, unless another run has nodes of the same names.

        Args:
            about: ``stack`` and ``domain``.
            names: full names of the nodes that must be unique in the domain.
            force: whether to write it in any case.

        Raises:
            BringupError: another run in the same domain has a node of the same name.
        """
        self._state |= {**about, 'log_folder': '', 'names': sorted(names), 'since': time.time()}
        with self._lock():
            if not force:
                self._require_unique(runs(self._folder))
            self._is_registered = True
            self._write()

    def update(self, event: Event) -> None:
        """Update the file after an event of the run."""
        name, nodes = event.get('node'), self._state['nodes']
        if name is not None:
            node = nodes.setdefault(name, {'state': 'waiting', 'pid': None})
            if event['event'] == 'started':  # forget its former process
                node = nodes[name] = {key: node[key] for key in ('condition',) if key in node}
            node |= _node_changes(event)
        match event['event']:
            case 'begun':
                self._state['log_folder'] = event['log_folder']
            case 'ready':
                self._state |= {'phase': 'ready', 'ready_after': event['seconds']}
            case 'never_ready':
                self._state['needs'] = event['condition']
            case 'stop_requested' | 'shutdown' | 'failure' | 'signal_sent':
                self._state['phase'] = 'stopping'
        if self._is_registered and event['event'] not in _NOT_WRITTEN:
            self._write()

    def remove(self) -> None:
        """Remove the file."""
        self._is_registered = False
        with contextlib.suppress(OSError):
            self._path.unlink(missing_ok=True)
            _draft(self._path).unlink(missing_ok=True)

    def _require_unique(self, others: Sequence[State]) -> None:
        for other in others:
            common = set(self._state['names']) & set(other['names'])
            if other['domain'] != self._state['domain'] or not common:
                continue
            raise BringupError(
                f"{', '.join(sorted(common))} would be there twice: the stack '{other['stack']}' "
                f'(pid {other["pid"]}, since {clock(other["since"])}) runs in ROS domain '
                f"{other['domain']} already; end it with '{COMMAND} stop {other['pid']}', or take "
                'another domain (--domain N), or start it nevertheless (--force)'
            )

    @contextlib.contextmanager
    def _lock(self) -> Iterator[None]:
        """Keep others from registering; without a lock where nothing can be written."""
        with contextlib.ExitStack() as stack:
            with contextlib.suppress(OSError):
                self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
                lock = stack.enter_context((self._folder / '.lock').open('a'))
                fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def _write(self) -> None:
        """Replace the file atomically; a full disk costs the file, not the run."""
        draft = _draft(self._path)
        with contextlib.suppress(OSError):
            descriptor = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            with open(descriptor, 'w', encoding='utf-8') as file:
                json.dump(self._state, file)
            draft.replace(self._path)


def _draft(path: Path) -> Path:
    """Return the temporary file beside a run's file, which readers ignore."""
    return path.with_suffix('.draft')


def _node_changes(event: Mapping[str, Any]) -> State:
    """Return the changes of a node's state by an event."""
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
    """Return a time (s since 1970) for a person: without the date if it is today's."""
    then, now = datetime.fromtimestamp(seconds), datetime.now()
    return f'{then:%H:%M:%S}' if then.date() == now.date() else f'{then:%Y-%m-%d %H:%M}'


def add_option(parser: ArgumentParser) -> None:
    """Add the option ``--force`` to a command."""
    parser.add_argument(
        '-f',
        '--force',
        action='store_true',
        help='start although a running stack has nodes of the same names',
    )


def unique_names(specs: 'Sequence[ProcessSpec]') -> set[str]:
    """Return the full names that must be unique in a domain: ``/robot1/controller_manager``."""
    pairs = ((spec.resolved.namespace or '', name) for spec in specs for name in _names(spec))
    return {f'{namespace.rstrip("/")}/{name}' for namespace, name in pairs}


def _names(spec: 'ProcessSpec') -> Sequence[str]:
    node = spec.node
    fixed = _FIXED_NAMES.get(node.executable, ()) if node.package == 'amr_description' else ()
    return (node.name, *fixed[1:]) if node.name else fixed
