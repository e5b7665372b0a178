# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Prints what the doctor finds first while a stack that failed to start still runs; or nothing.

The bring-up starts it: it is a process of its own, so that the bring-up
loads no rclpy. Only an error is printed: a warning does not keep a stack from starting. Its lines
begin with :data:`MARK`, what else is written (by libraries) does not.
"""

from collections.abc import Callable
import os
from typing import TYPE_CHECKING

from amr_description.doctor.findings import Severity
from amr_description.doctor.host import read_host, Sections
from amr_description.doctor.observations import Observations
from amr_description.doctor.report import as_lines
from amr_description.doctor.table import examine
from amr_description.ros.wait_clock import WaitClock

if TYPE_CHECKING:
    from rclpy.executors import Executor
    from rclpy.node import Node

MARK = 'doctor: '

_DISCOVERY, _QUIET = 2.0, 0.4
"""s: longest, and without another node, after which the graph counts as complete."""
_WINDOW = 1.5
"""s in which messages and answers are waited for: somebody waits for the failure."""
_POLL = 0.02  # s
_NOT_YET = {
    'no_clock',
    'standing_clock',
    'description_missing',
    'controller_manager_missing',
    'controller_unconfigured',
    'controller_inactive',
    'no_joint_state_broadcaster',
    'joints_without_state',
    'misnamed_topics',
    'tf_islands',
    'sensor_frame_missing',
}
"""Rules about what is missing, as who subscribes: in a start that ends early, much is."""


def main(args: list[str] | None = None) -> int:
    """Print the finding; 0."""
    sections = read_host()
    # Of what shows already, rclpy might end this process as soon as it is imported.
    if print_first_error(Observations(**sections)):
        return 0
    return _look_at_graph(args, sections)


def _look_at_graph(args: list[str] | None, sections: Sections) -> int:
    """Print the first error that the graph shows, too; return the exit code."""
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node

    from amr_description.doctor.ros.collector import collect
    from amr_description.ros.runtime import program, ros

    def body() -> None:
        with ros(args):
            name = f'_start_failure_{os.getpid()}'
            node = Node(name, enable_rosout=False, start_parameter_services=False)
            executor = SingleThreadedExecutor()
            executor.add_node(node)
            try:
                _discover(node, executor)
                print_first_error(collect(node, _spin(executor), window=_WINDOW, **sections))
            finally:
                executor.shutdown()
                node.destroy_node()

    return program(body, stopped=0)


def print_first_error(seen: Observations) -> bool:
    """Print the first error that rules find; return whether there is one."""
    errors = (each for each in examine(seen) if each.severity is Severity.ERROR)
    finding = next((each for each in errors if each.rule not in _NOT_YET), None)
    for line in as_lines(finding) if finding else ():
        print(MARK + line.removeprefix('ERROR: '))
    return finding is not None


def _discover(node: 'Node', executor: 'Executor') -> None:
    """Wait until no other node is discovered for a while."""
    clock, known = WaitClock(), 0
    changed = clock.now()

    def is_quiet() -> bool:
        nonlocal known, changed
        number = len(node.get_topic_names_and_types()) + len(node.get_node_names())
        if number != known:
            known, changed = number, clock.now()
        return clock.now() - changed >= _QUIET

    _spin(executor)(is_quiet, _DISCOVERY)


def _spin(executor: 'Executor') -> Callable[[Callable[[], bool], float], bool]:
    """Return what runs callbacks until a function returns True, at most for some s."""
    clock = WaitClock()

    def spin(until: Callable[[], bool], timeout: float) -> bool:
        deadline = clock.now() + timeout
        while not until():
            if clock.now() >= deadline:
                return False
            clock.wait(_POLL, executor.spin_once)
        return True

    return spin


if __name__ == '__main__':
    raise SystemExit(main())
