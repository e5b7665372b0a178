# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""LaunchService: processes of a description, beside others of the program that runs them."""

from pathlib import Path
import signal
import subprocess
import sys
import threading

import pytest

from amr_description.errors import BringupError
from amr_description.launch_api.actions import LogInfo, TimerAction
from amr_description.launch_api.descriptions import LaunchDescription
from amr_description.launch_api.events import Event, ProcessExited, ProcessIO, ProcessStarted
from amr_description.launch_api.processes import ExecuteProcess, Node
from amr_description.launch_api.service import LaunchService
from amr_description.launch_testing.actions import ReadyToTest

TIMEOUT = 60.0


@pytest.fixture
def service(monkeypatch, tmp_path):
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path))
    made = LaunchService()
    yield made
    made.shutdown(force_sync=True)


def shell(script, **options):
    return ExecuteProcess(cmd=['/bin/sh', '-c', script], **options)


def test_what_a_process_does_is_told_in_order(service):
    action = shell('echo out; echo err >&2; exit 3', name='mine')
    events = []
    service.listeners.append(events.append)
    service.include_launch_description(LaunchDescription([action]))
    assert service.run() == 0
    first, *lines, last = events
    assert (type(first), first.process_name) == (ProcessStarted, 'mine-1')
    assert {(each.text, each.from_stderr) for each in lines} == {
        (b'out\n', False),
        (b'err\n', True),
    }
    assert all(isinstance(each, ProcessIO) for each in lines)
    assert (type(last), last.returncode, last.pid) == (ProcessExited, 3, first.pid)
    assert (action.get_stdout(), action.get_stderr(), action.return_code) == ('out\n', 'err\n', 3)


def test_what_is_not_of_it_is_left_alone(service):
    """Its guardian ends what is left of the stack, and this process reaps its own children."""
    before = signal.getsignal(signal.SIGCHLD), signal.getsignal(signal.SIGINT)
    leaves = shell('sleep 600 & echo $!')
    service.include_launch_description(LaunchDescription([leaves]))
    with subprocess.Popen(['sleep', '600']) as other:
        ended = subprocess.Popen(['/bin/sh', '-c', 'exit 7'])
        service.run()
        assert (signal.getsignal(signal.SIGCHLD), signal.getsignal(signal.SIGINT)) == before
        assert ended.wait(TIMEOUT) == 7
        assert other.poll() is None
        other.kill()
    left = Path('/proc', leaves.get_stdout().strip(), 'stat')  # a zombie, where nobody reaps it
    assert not left.exists() or left.read_text().split()[2] == 'Z'


def test_ready_comes_when_what_stands_before_it_has_started(service):
    action, ready, seen = shell('sleep 600'), ReadyToTest(), threading.Event()
    details = []
    ready.callbacks += [lambda: details.append(action.process_details), seen.set]
    service.include_launch_description(LaunchDescription([action, ready]))
    service.start()
    assert seen.wait(TIMEOUT)
    assert details[0]['cmd'][-1] == 'sleep 600'
    service.shutdown(force_sync=True)
    assert action.return_code == -signal.SIGINT
    assert service.event_loop is None


def test_a_description_may_be_included_while_it_runs(service):
    service.start(shutdown_when_idle=False)
    first, second = shell('echo 1'), shell('echo 2')
    for action in (first, second):
        service.include_launch_description(LaunchDescription([action]))
        assert action.record.wait_for(lambda record: record.return_code == 0, TIMEOUT)
    assert [each.process_details['name'] for each in (first, second)] == ['sh-1', 'sh-2']


def test_what_is_not_understood_is_said_where_it_is_included(service):
    with pytest.raises(BringupError, match="package 'no_such_package' not found"):
        service.include_launch_description(
            LaunchDescription([Node(package='no_such_package', executable='a')])
        )
    with pytest.raises(BringupError, match='the event Event is not understood here'):
        service.emit_event(Event())


def test_a_program_that_is_not_there_is_the_exit_code(service, capsys):
    service.include_launch_description(
        LaunchDescription([ExecuteProcess(cmd=['no_such_program'])])
    )
    assert service.run() == 1
    assert "there is no command 'no_such_program'" in capsys.readouterr().out


def test_a_node_may_be_a_program_without_a_package(service):
    code = 'import sys; print(sys.argv[1:])'
    node = Node(
        executable=sys.executable,
        arguments=['-c', code, 'word'],
        name='n',
        remappings=[('a', 'b')],
    )
    service.include_launch_description(LaunchDescription([node]))
    assert service.run() == 0
    words = ['word', '--ros-args', '-r', '__node:=n', '-r', 'a:=b']
    assert node.get_stdout() == f'{words}\n'


def test_a_description_without_processes_comes_to_its_end(service, capsys):
    line = TimerAction(period=0.01, actions=[LogInfo(msg='later')])
    service.include_launch_description(LaunchDescription([line]))
    assert service.run() == 0
    assert 'later' in capsys.readouterr().out
