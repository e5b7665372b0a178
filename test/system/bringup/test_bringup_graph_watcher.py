# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A stack waits for lines, for the ROS graph, for time and for files; timeouts."""

import os
from pathlib import Path
import re
import signal

from fixtures.bringup.running import Bringup, STACKS
import pytest

from amr_description.bringup import path_exists, topic
from amr_description.bringup.conditions import PathState, RosGraph
from amr_description.bringup.graph_watcher import ExternalState, GraphWatch, path_state
from amr_description.bringup.guardian import processes
from amr_description.nodes.graph_watch import changes

WAITING = str(STACKS / 'waiting.py')


def waiting(folder, *arguments):
    """The stack, which finds the toys and the nodes of this package."""
    prefixes = f'{folder}/prefix:{os.environ["AMENT_PREFIX_PATH"]}'
    path = f'path:={folder}/port'
    return Bringup(folder, WAITING, path, *arguments, AMENT_PREFIX_PATH=prefixes)


def watch_of(bringup):
    """The process that sees the graph, if there is one."""
    children = [p.pid for p in processes('') if p.parent == bringup.process.pid]
    lines = {pid: Path(f'/proc/{pid}/cmdline').read_bytes() for pid in children}
    return [pid for pid, line in lines.items() if b'graph_watch' in line]


def test_each_node_starts_when_its_condition_holds(tmp_path):
    with waiting(tmp_path) as bringup:
        bringup.expect(r'\[step-4\]: process has finished cleanly')
        started = re.findall(r'\[(\S+)\]: process started', bringup.output)
        assert started == ['worker-1', 'talker-2', 'step-3', 'step-4']
        (watch,) = watch_of(bringup)
        os.kill(watch, signal.SIGKILL)
        bringup.expect(
            r'\[graph_watch\] ended with exit code -9; the ROS graph is not seen; next start in 1'
        )
        (tmp_path / 'port').touch()
        bringup.expect(r'\[step-5\]: process has finished cleanly')
        bringup.expect('ready in')
        assert watch_of(bringup) == []  # nobody asks any more
        assert bringup.end(signal.SIGINT) == 0
        assert bringup.left() == []


def test_a_timeout_stops_the_stack_and_reports_what_there_is_instead(tmp_path):
    with waiting(tmp_path, 'talks:=false', 'timeout:=1') as bringup:
        assert bringup.end() == 124
        last = bringup.output.splitlines()[-1]
        assert last.startswith(
            '[ERROR] [launch]: stopped because step-2 waited 1 s in vain: nobody publishes '
            '/robot1/topic; there '
        )
        assert last.endswith('; worker-1 still runs')
        assert bringup.left() == []


def test_a_timeout_of_an_optional_node_is_reported_and_the_stack_continues(tmp_path):
    with waiting(tmp_path, 'talks:=false', 'timeout:=1', 'optional:=true') as bringup:
        bringup.expect(r'\[step-2\]: never starts: step-2 waited 1 s in vain: nobody publishes')
        bringup.expect('ready in')
        assert bringup.end(signal.SIGINT) == 0


class Process:
    """What stands in for the process of the watch."""

    def __init__(self, on_line):
        self.write, self.sent, self.returncode = on_line, None, None

    def poll(self):
        return self.returncode is not None

    def send(self, number):
        self.sent = number

    def close(self):
        pass


class Watched:
    """A watch whose processes are told by the test what to do."""

    def __init__(self):
        self.processes, self.said, self.woken = [], [], 0
        self.watch = GraphWatch(self.spawn, self.wake, self.said.append)

    def spawn(self, on_line):
        self.processes.append(Process(on_line))
        return self.processes[-1]

    def wake(self):
        self.woken += 1


def test_the_graph_is_what_the_lines_say():
    watched = Watched()
    watched.watch.set_wanted(True, 0.0)
    (process,) = watched.processes
    for line in ('+ topic /a x/msg/Y', '+ topic /a x/msg/Z', '+ service /s', '+ node /n'):
        process.write(line)
    assert watched.watch.graph == RosGraph({'/a': {'x/msg/Y', 'x/msg/Z'}}, {'/s'}, {'/n'})
    process.write('- topic /a x/msg/Y')
    process.write('- node /n')
    process.write('[RTPS_TRANSPORT_SHM Error] + node')
    assert watched.watch.graph == RosGraph({'/a': {'x/msg/Z'}}, {'/s'}, frozenset())
    assert watched.woken == 6
    assert watched.said == ['[RTPS_TRANSPORT_SHM Error] + node']


def test_a_watch_that_dies_is_restarted_with_growing_delay_and_forgets_the_graph():
    watched = Watched()
    now = 100.0
    for delay in (1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 30.0):
        assert watched.watch.set_wanted(True, now) is None
        process = watched.processes[-1]
        process.write('+ node /n')
        process.returncode = 1
        assert watched.watch.set_wanted(True, now) == now + delay
        assert watched.watch.graph == RosGraph()
        assert watched.said[-1] == (
            f'ended with exit code 1; the ROS graph is not seen; next start in {delay:g} s'
        )
        count = len(watched.processes)
        assert watched.watch.set_wanted(True, now + delay - 0.1) == now + delay
        assert len(watched.processes) == count
        now += delay


def test_it_runs_only_while_a_condition_asks():
    watched = Watched()
    external = ExternalState(watched.watch)
    external.update([], 0.0)
    assert watched.processes == []
    external.update([topic('/a')], 1.0)
    external.update([topic('/a')], 2.0)
    (process,) = watched.processes
    external.update([], 3.0)
    assert process.sent == signal.SIGINT
    process.returncode = 0
    external.update([], 4.0)
    assert not watched.watch.poll()
    assert watched.said == []
    external.update([topic('/a')], 5.0)
    assert len(watched.processes) == 2


def test_paths_are_polled_while_a_condition_asks(tmp_path):
    external = ExternalState(Watched().watch)
    port = tmp_path / 'port'
    asked = [path_exists(port)]
    external.update(asked, 1.0)
    assert external.paths == {str(port): PathState(False, frozenset())}
    assert external.next_time == pytest.approx(1.1)
    (tmp_path / 'port1').touch()
    assert path_state(port) == PathState(False, {'port1'})
    port.touch()
    external.update(asked, 1.1)
    assert external.paths == {str(port): PathState(True)}
    external.update([], 1.2)
    assert external.next_time is None
    assert path_state(tmp_path / 'no' / 'folder') == PathState(False)


def test_the_watch_reports_what_came_and_went():
    assert changes({'node /a', 'node /b'}, {'node /b', 'service /c'}) == [
        '- node /a',
        '+ service /c',
    ]
