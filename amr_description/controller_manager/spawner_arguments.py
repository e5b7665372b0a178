# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The command line of ``spawner``, in either of its forms.

::

    spawner a b --inactive -p both.yaml
    spawner --controller a -p a.yaml --controller b --inactive

In the second form the options of a controller (``-p``, ``--load-only``, ``--inactive``,
``--controller-ros-args``) stand behind it; the others anywhere, once for all.
"""

from argparse import ArgumentParser, ArgumentTypeError, BooleanOptionalAction, Namespace
from collections.abc import Sequence
from dataclasses import dataclass
import math
import os

from amr_description.errors import ParameterError

_DELIMITER = '--controller'
_ROS_ARGS = '--controller-ros-args'
_SUMMARY = 'Load, configure and activate controllers, one by one.'
_EPILOG = (
    'With options for each: spawner [options] --controller NAME [-p FILE] [--load-only] '
    '[--inactive] [--controller-ros-args ARGS] --controller NAME …'
)


@dataclass(frozen=True)
class ControllerPlan:
    """What is to be done with one controller."""

    name: str
    files: tuple[str, ...] = ()
    load_only: bool = False
    inactive: bool = False
    ros_args: tuple[str, ...] = ()


@dataclass(frozen=True)
class SpawnOptions:
    """What is to be done with all controllers; times in s."""

    plans: tuple[ControllerPlan, ...]
    manager: str
    namespace: str
    manager_timeout: float
    switch_timeout: float
    call_timeout: float
    as_group: bool
    activate_asap: bool
    unload_on_kill: bool
    continue_on_error: bool


def parse(words: Sequence[str]) -> SpawnOptions:
    """
    Read the words of a command line, without ROS arguments.

    Ends the process as argparse does: 2 for a wrong command line, 0 for ``--help``. Raises
    ParameterError: there is no such parameter file.
    """
    words = ['--help'] if {'-h', '--help'} & set(words) else _with_ros_args_bound(words)
    if any(word.partition('=')[0] == _DELIMITER for word in words):
        options, named = _parse_advanced(words)
    else:
        options = _parser().parse_args(words)
        named = {name: options for name in options.controller_names}
    return SpawnOptions(
        plans=tuple(_plan(name, own) for name, own in named.items()),
        manager=options.controller_manager,
        namespace=options.namespace,
        manager_timeout=options.controller_manager_timeout,
        switch_timeout=options.switch_timeout,
        call_timeout=options.service_call_timeout,
        as_group=options.activate_as_group,
        activate_asap=options.switch_asap,
        unload_on_kill=options.unload_on_kill,
        continue_on_error=options.continue_on_error,
    )


def seconds(text: str) -> float:
    """Read a time from 0 on, s; for argparse."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 <= value < math.inf:
        raise ArgumentTypeError(f"'{text}' is no time in seconds")
    return value


def positive_seconds(text: str) -> float:
    """Read a time above 0, s; for argparse."""
    value = seconds(text)
    if not value:
        raise ArgumentTypeError('it must be above 0 s')
    return value


def _parser() -> ArgumentParser:
    options = ArgumentParser(
        prog='spawner',
        description=_SUMMARY,
        epilog=_EPILOG,
        parents=[_common(switch_asap=True), _of_a_controller()],
    )
    options.add_argument('controller_names', nargs='+', help='controllers to spawn, in order')
    return options


def _parse_advanced(words: Sequence[str]) -> tuple[Namespace, dict[str, Namespace]]:
    """Return the options for all, and those of each controller by its name."""
    common = ArgumentParser(
        prog='spawner',
        usage=_EPILOG.partition(': ')[2],
        parents=[_common(switch_asap=False)],
        allow_abbrev=False,
    )
    single = ArgumentParser(
        prog='spawner',
        usage=common.usage,
        parents=[_of_a_controller()],
        allow_abbrev=False,
        add_help=False,
    )
    single.add_argument('name', metavar=f'{_DELIMITER} NAME')
    for_all, *groups = _split(words)
    named: dict[str, Namespace] = {}
    for group in groups:
        own, others = single.parse_known_args(group)
        if own.name in named:
            common.error(f'controller {own.name} is given twice')
        named[own.name] = own
        for_all += others
    return common.parse_args(for_all), named


def _with_ros_args_bound(words: Sequence[str]) -> list[str]:
    """Bind "-p x:=1" to the option that it belongs to: argparse takes it for one of its own."""
    bound: list[str] = []
    for word in words:
        if bound and bound[-1] == _ROS_ARGS and word != _DELIMITER:
            bound[-1] += f'={word}'
        else:
            bound.append(word)
    return bound


def _split(words: Sequence[str]) -> list[list[str]]:
    """Return the words before the first ``--controller``, then those behind each."""
    groups: list[list[str]] = [[]]
    for word in words:
        option, _, name = word.partition('=')
        if option == _DELIMITER:
            groups.append([name] if name else [])
        else:
            groups[-1].append(word)
    return groups


def _plan(name: str, options: Namespace) -> ControllerPlan:
    for path in options.param_file:
        if not os.path.isfile(path):
            raise ParameterError(f'-p {path}: there is no such parameter file')
    return ControllerPlan(
        name,
        files=tuple(os.path.abspath(path) for path in options.param_file),
        load_only=options.load_only,
        inactive=options.inactive,
        ros_args=tuple(word for text in options.controller_ros_args for word in text.split()),
    )


def _of_a_controller() -> ArgumentParser:
    """Make the parser of what may differ from controller to controller."""
    options = ArgumentParser(add_help=False)
    options.add_argument(
        '-p',
        '--param-file',
        action='append',
        default=[],
        metavar='FILE',
        help='parameter file of the controllers; may be given several times',
    )
    options.add_argument('--load-only', action='store_true', help='load, and stop there')
    options.add_argument('--inactive', action='store_true', help='load and configure only')
    options.add_argument(
        _ROS_ARGS,
        action='append',
        default=[],
        metavar='ARGS',
        help='ROS arguments of the controller nodes, such as "-r /tf:=tf"; may be given several '
        'times',
    )
    return options


def _common(*, switch_asap: bool) -> ArgumentParser:
    """Make the parser of what is the same for all controllers."""
    options = ArgumentParser(add_help=False)
    options.add_argument(
        '-c',
        '--controller-manager',
        default='controller_manager',
        metavar='NODE',
        help='the controller manager (default: %(default)s, in the namespace of the spawner)',
    )
    options.add_argument(
        '-n', '--namespace', default='', help='DEPRECATED: use --ros-args -r __ns:=NAMESPACE'
    )
    options.add_argument(
        '-u',
        '--unload-on-kill',
        action='store_true',
        help='stay, and unload the controllers when interrupted',
    )
    for flag, read, default, what in (
        ('controller-manager', seconds, 0.0, 'wait for the manager; 0: for ever'),
        ('switch', seconds, 5.0, 'let a switch take; a paused simulation may need more'),
        ('service-call', positive_seconds, 10.0, 'wait for an answer, three times'),
    ):
        options.add_argument(
            f'--{flag}-timeout',
            type=read,
            default=default,
            metavar='S',
            help=f'how long to {what}, s (default: %(default)s)',
        )
    options.add_argument(
        '--activate-as-group', action='store_true', help='activate all with one request'
    )
    options.add_argument(
        '--continue-on-error',
        action='store_true',
        help='name what fails, leave a controller inactive whose command interfaces another one '
        'has claimed, and spawn the others, each after those that it is chained to',
    )
    options.add_argument(
        '--switch-asap',
        action=BooleanOptionalAction,
        default=switch_asap,
        help='activate in the control loop',
    )
    return options
