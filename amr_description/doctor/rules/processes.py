# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about the processes of ROS on this host."""

from collections import Counter
from collections.abc import Iterator

from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.processes import ObservedProcess

_DEFAULT_RMW = 'rmw_fastrtps_cpp'
_RMW = 'RMW_IMPLEMENTATION'
_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
_STOPPED = ('T', 't')
_MOST_FILES = 0.9
_SHOWN = 3
_SMALL = 50_000_000


def stopped_process(seen: Observations) -> Iterator[Finding]:
    """
    A process of ROS runs; one that was stopped by Ctrl-Z is in the graph, and silent.

    ``fg`` in its shell, or ``kill -CONT PID``, lets it go on.
    """
    # Those whose nodes are in the graph are named by the rules about it.
    known = {each.process for each in seen.graph.nodes} if seen.graph else set()
    stopped = [
        each for each in _of_domain(seen) if each.state in _STOPPED and each.pid not in known
    ]
    if stopped:
        pids = ' '.join(str(each.pid) for each in stopped)
        yield error(
            'stopped_process',
            f'{_names(stopped)} {"is" if len(stopped) == 1 else "are"} stopped, as by Ctrl-Z',
            'its nodes neither publish nor answer, and who comes later does not find them',
            f'kill -CONT {pids}; or end it: kill -CONT {pids}; kill {pids}',
        )


def orphaned_process(seen: Observations) -> Iterator[Finding]:
    """
    What a bring-up has started ends with it.

    A bring-up was killed, and something runs on. The next start would have its nodes twice.
    """
    if seen.processes is None:
        return
    runs = seen.processes.runs
    left = [each for each in _of_domain(seen) if each.run and each.run not in runs]
    if left:
        pids = ' '.join(str(each.pid) for each in left)
        yield error(
            'orphaned_process',
            f'{_names(left)} {"is" if len(left) == 1 else "are"} left of the run '
            f'{left[0].run}, which has ended',
            'its nodes publish beside those of the next start, under the same names',
            f'kill {pids}',
        )


def other_domain(seen: Observations) -> Iterator[Finding]:
    """
    Nodes find each other in one domain.

    Nothing is in the domain of this shell, and something is in another domain of this host.
    """
    processes = seen.processes
    if processes is None or processes.is_alone is not True or _of_domain(seen):
        return
    elsewhere = [each for each in processes.processes if each.domain is not None]
    if not elsewhere:
        return
    counts = Counter(each.domain for each in elsewhere)
    busiest, _ = max(counts.items(), key=lambda each: each[1])
    there = [each for each in elsewhere if each.domain == busiest]
    yield warning(
        'other_domain',
        f'nothing is in ROS domain {processes.domain}, and {_names(there)} '
        f'{"is" if len(there) == 1 else "are"} in domain {busiest}',
        'commands of this shell do not find it',
        f'export ROS_DOMAIN_ID={busiest}' if busiest else 'unset ROS_DOMAIN_ID',
    )


def other_middleware(seen: Observations) -> Iterator[Finding]:
    """
    Nodes of one domain use one middleware.

    Topics of Fast DDS and Cyclone DDS may meet. Services and parameters do not.
    """
    if seen.environment is None:
        return
    own = seen.environment.value(_RMW) or _DEFAULT_RMW
    for each in _of_domain(seen):
        other = each.variables.get(_RMW) or _DEFAULT_RMW
        if other != own:
            yield error(
                'other_middleware',
                f'{_names([each])} uses {other}, and this shell {own}',
                'with another middleware topics may arrive, services and parameters do not',
                f'export {_RMW}={other}; or start it anew with {_RMW}={own}',
            )
            return


def undiscoverable_process(seen: Observations) -> Iterator[Finding]:
    """
    A process with the discovery range OFF is found by nobody.

    Start it again with another range.
    """
    off = [
        each
        for each in _of_domain(seen)
        if each.variables.get(_RANGE) == 'OFF' and not each.variables.get('ROS_DISCOVERY_SERVER')
    ]
    if off:
        yield error(
            'undiscoverable_process',
            f'{_names(off)} was started with {_RANGE}=OFF',
            'its nodes are in no graph but their own',
            f'start it anew with {_RANGE}=LOCALHOST',
        )


def open_files(seen: Observations) -> Iterator[Finding]:
    """
    Each node and each camera need descriptors of files.

    A process is near its limit. A page in the browser, bags and cameras take some.
    """
    for each in _of_domain(seen):
        if each.most_open_files and each.open_files >= _MOST_FILES * each.most_open_files:
            yield warning(
                'open_files',
                f'{_names([each])} has {each.open_files} files and sockets open, of '
                f'{each.most_open_files} that it may have',
                'at its limit it cannot make nodes, sockets or log files any more',
                'start it anew after: ulimit -n 65536',
            )


def shared_memory(seen: Observations) -> Iterator[Finding]:
    """
    Programs that end remove their shared memory; those that are killed do not.

    ``bringup`` removes it at its end; other programs do not.
    """
    left = seen.processes.left_memory if seen.processes else None
    if left and left.size >= _SMALL:
        yield warning(
            'shared_memory',
            f'{len(left.files)} segments of Fast DDS in /dev/shm, {left.size / 1e6:.0f} MB, are '
            'of no process',
            'killed programs have left them: they take memory until the machine is started anew',
            'end all that uses ROS, then: rm -f /dev/shm/fastrtps_*',
        )


RULES: tuple[Rule, ...] = (
    stopped_process,
    undiscoverable_process,
    other_middleware,
    orphaned_process,
    other_domain,
    open_files,
    shared_memory,
)


def _of_domain(seen: Observations) -> list[ObservedProcess]:
    if seen.processes is None:
        return []
    own = seen.processes.domain
    return [each for each in seen.processes.processes if each.domain == own]


def _names(processes: list[ObservedProcess]) -> str:
    named = ', '.join(f'{each.command} (pid {each.pid})' for each in processes[:_SHOWN])
    more = len(processes) - _SHOWN
    return f'{named} and {more} more' if more > 0 else named
